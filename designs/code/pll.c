/* A phase-locked loop of a motor controller, as such loops are written for microcontrollers. */
#include "pll.h"

#include <math.h>

static float wrapped(float angle) {
  while (angle > (float)M_PI) {
    angle -= 2.0f * (float)M_PI;
  }
  while (angle < -(float)M_PI) {
    angle += 2.0f * (float)M_PI;
  }
  return angle;
}

void pll_init(pll_t* pll, float kp, float ki, float dt) {
  pll->kp = kp;
  pll->ki = ki;
  pll->dt = dt;
  pll->ready = false;
  pll->samples = 0;
}

void pll_run(pll_t* pll, float alpha, float beta) {
  if (!pll->ready) {
    pll->phase = 0.0f;
    pll->speed = 0.0f;
    pll->ready = true;
  }
  ++pll->samples;
  const float delta = wrapped(atan2f(beta, alpha) - pll->phase);
  if (isnan(delta)) {
    return;
  }
  pll->phase = wrapped(pll->phase + (pll->speed + pll->kp * delta) * pll->dt);
  pll->speed += pll->ki * delta * pll->dt;
}

/* A phase-locked loop with the gains of a motor controller, and an arc tangent that is a polynomial. */
#include <math.h>
#include <stdbool.h>

#define HALF_TURN 3.14159265f

static struct {
  float angle, speed;  /* rad, rad/s */
  float kp, ki, period;
} pll;

/* Within 0.0102 rad. */
static float fast_atan2(float y, float x) {
  const float size = fabsf(y) + 1e-20f; /* so that nothing is divided by zero */
  float share, angle;
  if (x >= 0.0f) {
    share = (x - size) / (x + size);
    angle = HALF_TURN / 4.0f;
  } else {
    share = (x + size) / (size - x);
    angle = 3.0f * HALF_TURN / 4.0f;
  }
  angle += (0.1963f * share * share - 0.9817f) * share;
  return y < 0.0f ? -angle : angle;
}

static void wrap(float* angle) {
  while (*angle < -HALF_TURN) {
    *angle += 2.0f * HALF_TURN;
  }
  while (*angle > HALF_TURN) {
    *angle -= 2.0f * HALF_TURN;
  }
}

void setup(void) {
  pll.kp = 2000.0f;
  pll.ki = 30000.0f;
  pll.period = 1.0f / 20000.0f;
}

void step(float alpha, float beta) {
  float error = fast_atan2(beta, alpha) - pll.angle;
  wrap(&error);
  pll.angle += (pll.speed + pll.kp * error) * pll.period;
  wrap(&pll.angle);
  pll.speed += pll.ki * error * pll.period;
}

float frequency(void) {
  return pll.speed * pll.period;
}

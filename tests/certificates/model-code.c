/* A phase-locked loop of two channels as firmware has it: single precision, angles that are wrapped, a guard
   against values that are no numbers. */
#include <math.h>

struct loop {
  float phase, speed, dt;
  int count;
};
static struct loop loop;

static float wrapped(float angle) {
  const float pi = 3.14159265f;
  while (angle > pi) {
    angle -= 2.0f * pi;
  }
  while (angle < -pi) {
    angle += 2.0f * pi;
  }
  return angle;
}

void setup(void) { loop.dt = 1.0f / 12500.0f; }

void step(float alpha, float beta) {
  const float error = wrapped(atan2f(beta, alpha) - loop.phase);
  loop.count++;
  if (isnan(error)) {
    return;
  }
  loop.phase = wrapped(loop.phase + (loop.speed + 2000.0f * error) * loop.dt);
  loop.speed += 30000.0f * error * loop.dt;
}

float frequency(void) { return loop.speed * loop.dt; }

// A generalised integrator of second order with a frequency-locked loop, for the grid.
#include <math.h>

static struct sogi {
  float in_phase, quadrature;
  float w;  // rad/s
  float gain;
} grid;

static float period;

static float normalised(float error, float power) {
  if (power < 0.01f) {
    power = 0.01f;
  }
  return error / power;
}

void setup(void) {
  grid.in_phase = 1.0f;
  grid.w = 314.15927f;
  grid.gain = 1.4142f;
  period = 1e-4f;
}

void step(float y) {
  struct sogi* s = &grid;
  const float e = y - s->in_phase;
  const float x = s->in_phase + s->w * period * (s->gain * e - s->quadrature);
  const float q = s->quadrature + s->w * period * x;
  s->w -= 50.0f * s->gain * period * s->w * normalised(e * q, x * x + q * q);
  s->w = fminf(fmaxf(s->w, 251.3f), 377.0f);
  s->in_phase = x;
  s->quadrature = q;
}

float frequency(void) {
  return grid.w * period;
}

// The sine comes from a table that setup computes, between whose entries is interpolated.
#include <math.h>

#define SIZE 64

static float sine[SIZE + 1];
static struct {
  float phase;  // of SIZE a turn
  float w;
} pll;

static float sine_of(float phase) {
  const int i = (int)phase;
  const float part = phase - (float)i;
  return sine[i] + part * (sine[i + 1] - sine[i]);
}

void setup(void) {
  for (int i = 0; i <= SIZE; ++i) {
    sine[i] = sinf(6.28318531f / SIZE * (float)i);
  }
  pll.w = 3.0f;
}

void step(float y) {
  const float e = y * sine_of(pll.phase);
  pll.w += 0.02f * e;
  pll.phase += pll.w + 0.5f * e;
  if (pll.phase >= SIZE) {
    pll.phase -= SIZE;
  } else if (pll.phase < 0.0f) {
    pll.phase += SIZE;
  }
}

float frequency(void) {
  return pll.w * (6.28318531f / SIZE);
}

// An arc tangent by a polynomial, octant by octant, in a loop for two channels.
#include <math.h>

static float theta, w;

static float fast_atan2(float y, float x) {
  const float ay = fabsf(y) + 1e-20f;
  float angle, r;
  if (x < 0.0f) {
    r = (x + ay) / (ay - x);
    angle = 2.35619449f;
  } else {
    r = (x - ay) / (x + ay);
    angle = 0.785398163f;
  }
  angle += (0.1963f * r * r - 0.9817f) * r;
  return y < 0.0f ? -angle : angle;
}

static float wrapped(float angle) {
  angle = fmodf(angle + 3.14159265f, 6.28318531f);
  if (angle < 0.0f) {
    angle += 6.28318531f;
  }
  return angle - 3.14159265f;
}

void setup(void) {
  w = 0.2f;
}

void step(float i, float q) {
  const float e = wrapped(fast_atan2(q, i) - theta);
  theta = wrapped(theta + w + 0.05f * e);
  w += 1e-3f * e;
}

float frequency(void) {
  return w;
}

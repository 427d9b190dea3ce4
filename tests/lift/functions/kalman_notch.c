// An adaptive notch whose coefficient a Kalman filter of one state estimates.
#include <float.h>
#include <math.h>
#include <stdbool.h>

struct notch {
  float s[2];  // the last two samples behind the resonator
  float a, p;
  bool is_limited;
};

static struct notch notch;
static const float kRho = 0.95f;

static bool limit(float* a) {
  if (*a > 2.0f) {
    *a = 1.99999f;
    return true;
  }
  if (*a < -2.0f) {
    *a = -1.99999f;
    return true;
  }
  return false;
}

void setup(void) {
  notch.a = 2.0f * cosf(0.6f);
  notch.p = 1e-3f;
}

void step(float sample) {
  const float s = sample + kRho * notch.s[0] * notch.a - kRho * kRho * notch.s[1];
  const float e = s - notch.a * notch.s[0] + notch.s[1];
  notch.p += 1e-6f;
  const float gain = notch.s[0] / (notch.s[0] * notch.s[0] + 1.0f / (notch.p + FLT_EPSILON));
  notch.a += gain * e;
  notch.is_limited = limit(&notch.a);
  notch.p = (1.0f - gain * notch.s[0]) * notch.p;
  if (notch.is_limited || notch.p < 1e-12f) {
    notch.p = 1e-3f;
  }
  notch.s[1] = notch.s[0];
  notch.s[0] = s;
}

float frequency(void) {
  return acosf(0.5f * notch.a);
}

// Literals without an f: the operations are in double precision, what is kept in single.
#include <math.h>

static struct {
  float theta, omega, x1, x2;
} f;

void setup(void) {
  f.omega = 0.1;
  f.x1 = 0.7;
}

void step(float u) {
  const float predicted = 1.98 * f.x1 * cos(f.omega) - 0.9801 * f.x2;
  const float e = u - predicted;
  f.omega = f.omega + 0.001 * e * f.x1;
  if (f.omega > 3.1) f.omega = 3.1;
  if (f.omega < 1e-3) f.omega = 1e-3;
  f.theta = fmod(f.theta + f.omega, 2.0 * M_PI);
  f.x2 = f.x1;
  f.x1 = predicted + 0.4 * e * (1.0 + 0.1 * sinf(f.theta));
}

float frequency(void) {
  return f.omega;
}

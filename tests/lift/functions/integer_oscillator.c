// An oscillator with a phase of 32 bits, which goes round by itself.
#include <math.h>
#include <stdint.h>

#define COUNTS 683565275.6f /* of a radian */

typedef struct {
  uint32_t phase;
  uint32_t increment;
  float w;
  uint32_t samples;
} oscillator_t;

static oscillator_t nco;

static float phase_of(const oscillator_t* o) {
  return (float)(int32_t)o->phase * (1.0f / COUNTS);
}

static void set_frequency(oscillator_t* o, float w) {
  o->w = w;
  o->increment = (uint32_t)(w * COUNTS);
}

void setup(void) {
  nco.phase = 0x40000000u;
  set_frequency(&nco, 0.4f);
}

void step(float y) {
  const float e = y * cosf(phase_of(&nco));
  float w = nco.w + 1e-3f * e;
  if (w < 0.01f) {
    w = 0.01f;
  }
  if (w > 3.0f) {
    w = 3.0f;
  }
  set_frequency(&nco, w);
  nco.phase += nco.increment;
  nco.phase += (uint32_t)(int32_t)(0.05f * e * COUNTS);
  ++nco.samples;
}

float frequency(void) {
  return nco.w;
}

// A quarter of a sine as a table of constants, read by the upper bits of an integer phase.
#include <stdint.h>

static const int16_t kQuarter[17] = {0,     3212,  6393,  9512,  12539, 15446, 18204, 20787, 23170,
                                     25329, 27245, 28898, 30273, 31356, 32137, 32609, 32767};

static uint16_t phase;
static int32_t rate;  // 1/65536 of a turn a sample, times 256
static float level;

static int32_t sine(uint16_t angle) {
  const uint16_t place = (angle >> 10) & 15u;
  switch (angle >> 14) {
    case 0:
      return kQuarter[place];
    case 1:
      return kQuarter[16 - place];
    case 2:
      return -kQuarter[place];
    default:
      return -kQuarter[16 - place];
  }
}

void setup(void) {
  rate = 3000 * 256;
}

void step(float y) {
  const int32_t product = (int32_t)(y * 100.0f) * sine(phase);
  rate += product >> 8;
  if (rate > 30000 * 256) {
    rate = 30000 * 256;
  }
  level += 0.01f * ((float)product - level);
  phase = (uint16_t)(phase + (rate >> 8) + (product >> 12));
}

float frequency(void) {
  return (float)rate * (6.28318531f / 65536.0f / 256.0f);
}

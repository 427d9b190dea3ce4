// A tracker that starts with a wide loop, narrows it after some samples, and counts how long it is in lock.
#include <math.h>
#include <stdbool.h>

enum mode { kStart, kAcquire, kTrack };

static enum mode mode;
static int samples;
static int locked;
static bool is_locked;
static float theta, w, gain, level;
static unsigned ticks;

static void change_mode(void) {
  switch (mode) {
    case kStart:
      gain = 0.2f;
      mode = kAcquire;
      break;
    case kAcquire:
      if (++samples >= 20) {
        mode = kTrack;
        gain = 0.05f;
      }
      break;
    case kTrack:
      break;
  }
}

void setup(void) {
  w = 0.3f;
  level = 0.5f;
}

void step(float y) {
  ++ticks;
  change_mode();
  const float e = -2.0f * y * sinf(theta);
  level += 0.02f * (y * cosf(theta) - level);
  if (level > 0.25f) {
    if (locked < 100) ++locked;
  } else if (locked > 0) {
    --locked;
  }
  is_locked = locked > 50;
  w += gain * gain * e;
  theta += w + 1.4f * gain * e;
  if (theta > 3.14159265f) theta -= 6.28318531f;
  if (theta < -3.14159265f) theta += 6.28318531f;
}

float frequency(void) {
  return w;
}

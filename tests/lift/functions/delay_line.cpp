// A ring of past samples: the sample of a quarter of a period before makes the quadrature of a single
// channel.
#include <array>
#include <cmath>
#include <cstddef>

template <std::size_t kLength>
class DelayLine {
 public:
  float push(float sample) {
    const float oldest = past_[at_];
    past_[at_] = sample;
    at_ = (at_ + 1) % kLength;
    return oldest;
  }
  float newest() const { return past_[(at_ + kLength - 1) % kLength]; }

 private:
  std::array<float, kLength> past_{};
  std::size_t at_ = 0;
};

static DelayLine<5> line;
static float phase, w, mean;

void setup() {
  w = 0.314f;
}

void step(float y) {
  const float before = line.newest();
  const float quadrature = line.push(y);
  mean += 0.05f * (y - before - mean);
  const float e = y * std::cos(phase) + quadrature * std::sin(phase) - mean;
  w += 4e-4f * e;
  phase += w + 0.03f * e;
  if (phase > 3.14159265f) {
    phase -= 6.28318531f;
  }
}

float frequency() {
  return w;
}

// A detector that gives a result only where the signal is strong, in an optional.
#include <cmath>
#include <optional>

namespace {

struct Measured {
  float phase = 0.0f;
  float weight = 0.0f;
};

class Detector {
 public:
  std::optional<Measured> measure(float in_phase, float quadrature) const {
    const float power = in_phase * in_phase + quadrature * quadrature;
    if (power < floor_) {
      return std::nullopt;
    }
    return Measured{std::atan2(quadrature, in_phase), std::sqrt(power)};
  }
  void set_floor(float floor) { floor_ = floor; }

 private:
  float floor_ = 0.0f;
};

Detector detector;
float angle = 0.0f;
float w = 0.25f;

}  // namespace

void setup() {
  detector.set_floor(0.04f);
}

void step(float i, float q) {
  angle += w;
  if (const std::optional<Measured> result = detector.measure(i, q)) {
    float error = result->phase - angle;
    while (error > 3.14159265f) {
      error -= 6.28318531f;
    }
    while (error < -3.14159265f) {
      error += 6.28318531f;
    }
    angle += 0.1f * error;
    w += 0.005f * error / (1.0f + 0.1f * result->weight);
  }
  if (angle >= 3.14159265f) {
    angle -= 6.28318531f;
  }
}

float frequency() {
  return w;
}

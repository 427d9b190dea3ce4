// The detector is chosen in setup: a virtual function, and a function through a pointer for the limit.
#include <cmath>
#include <memory>

class Detector {
 public:
  virtual ~Detector() = default;
  virtual float error(float y, float theta) = 0;
};

class Product : public Detector {
 public:
  float error(float y, float theta) override { return -y * std::sin(theta); }
};

class Limited : public Product {
 public:
  explicit Limited(float most) : most_(most) {}
  float error(float y, float theta) override {
    const float e = Product::error(y, theta);
    mean_ += 0.1f * (e - mean_);
    return e > most_ ? most_ : e < -most_ ? -most_ : e + 0.01f * mean_;
  }

 private:
  float most_;
  float mean_ = 0.0f;
};

static std::unique_ptr<Detector> detector;
static float (*limit)(float);
static float theta, w;

static float to_band(float x) {
  return std::fmin(std::fmax(x, 0.05f), 1.0f);
}

void setup() {
  const bool has_spikes = true;
  if (has_spikes) {
    detector = std::make_unique<Limited>(0.8f);
  } else {
    detector = std::make_unique<Product>();
  }
  limit = to_band;
  w = 0.3f;
}

void step(float y) {
  const float e = detector->error(y, theta);
  w = limit(w + 4e-4f * e);
  theta += w + 0.028f * e;
  theta -= 6.28318531f * std::rint(theta / 6.28318531f);
}

float frequency() {
  return w;
}

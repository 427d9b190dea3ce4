// A class with templates: a loop filter that has any number of integrators, in any format.
#include <algorithm>
#include <cmath>

template <typename Real, int kIntegrators>
class LoopFilter {
 public:
  void set(const Real (&gains)[kIntegrators + 1]) { std::copy(gains, gains + kIntegrators + 1, gains_); }
  Real operator()(Real error) {
    Real sum = gains_[0] * error;
    for (int i = 0; i < kIntegrators; ++i) {
      integrals_[i] += gains_[i + 1] * error;
      sum += integrals_[i];
    }
    return sum;
  }
  Real integral(int i) const { return integrals_[i]; }
  void preset(Real value) { integrals_[0] = value; }

 private:
  Real gains_[kIntegrators + 1] = {};
  Real integrals_[kIntegrators] = {};
};

template <typename Real>
class Loop {
 public:
  explicit Loop(Real start) : limit_(Real(0.5)) { filter_.preset(start); }
  void tune(Real bandwidth) {
    const Real gains[] = {Real(1.4) * bandwidth, bandwidth * bandwidth, Real(0.01) * bandwidth * bandwidth};
    filter_.set(gains);
  }
  void feed(Real sample) {
    const Real error = std::clamp(sample * std::cos(phase_), -limit_, limit_);
    phase_ += filter_(error);
    if (phase_ > Real(M_PI)) {
      phase_ -= Real(2 * M_PI);
    }
  }
  Real rate() const { return std::max(filter_.integral(0), Real(0)); }

 private:
  LoopFilter<Real, 2> filter_;
  Real phase_ = 0;
  Real limit_;
};

static Loop<float> loop(0.2f);

void setup() {
  loop.tune(0.03f);
}
void step(float y) {
  loop.feed(y);
}
float frequency() {
  return loop.rate();
}

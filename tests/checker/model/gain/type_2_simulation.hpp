// The loop of type 2 of one channel in doubles, with a frequency of the signal and noise to be chosen.
#pragma once

#include <cmath>
#include <vector>

namespace veritrack::test {

class Type2Simulation {
 public:
  Type2Simulation(double wn, double frequency, double phase, double amplitude = 1.0)
      : ki_(wn * wn),
        kp_(2 * 0.7071 * wn),
        omega_(frequency),
        amplitude_(amplitude),
        phi_(phase),
        theta_(phase),
        w_(frequency) {}

  /// As far from the steady state.
  void start(double of_theta, double of_w) {
    theta_ += of_theta;
    w_ += of_w;
  }
  void step(double noise) {
    phi_ = std::remainder(phi_ + omega_, 2.0 * 3.14159265358979323846);
    const double e = -2.0 * (amplitude_ * std::cos(phi_) + noise) * std::sin(theta_ + w_);
    const double next = theta_ + w_ + kp_ * e;
    w_ += ki_ * e;
    theta_ = std::remainder(next, 2.0 * 3.14159265358979323846);
  }

  [[nodiscard]] double frequency_error() const { return w_ - omega_; }
  [[nodiscard]] double phase_error() const {
    return std::remainder(theta_ - phi_, 2.0 * 3.14159265358979323846);
  }
  [[nodiscard]] double phase() const { return phi_; }
  /// The factor of the noise of the next sample.
  [[nodiscard]] double factor() const { return -2.0 * std::sin(theta_ + w_); }

  /// Of the frequency error after k more samples, to first order and without ripples, to a unit of e.
  [[nodiscard]] std::vector<double> response(std::size_t length) const {
    std::vector<double> result;
    double phase = kp_;
    double frequency = ki_;
    for (std::size_t k = 0; k < length; ++k) {
      result.push_back(frequency);
      const double e = -amplitude_ * (phase + frequency);
      phase += frequency + kp_ * e;
      frequency += ki_ * e;
    }
    return result;
  }

 private:
  double ki_, kp_, omega_, amplitude_;
  double phi_, theta_, w_;
};

/// The largest frequency error of noise that pushes in the worst direction to first order, at the end.
inline double attacked_error(Type2Simulation loop, double noise, std::size_t length) {
  const std::vector<double> response = loop.response(length);
  double largest = 0.0;
  for (std::size_t k = 0; k < length; ++k) {
    loop.step(std::copysign(noise, response[length - 1 - k] * loop.factor()));
    largest = std::fmax(largest, std::abs(loop.frequency_error()));
  }
  return largest;
}

}  // namespace veritrack::test

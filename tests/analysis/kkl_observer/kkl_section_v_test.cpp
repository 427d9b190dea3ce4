#include "analysis/kkl_observer/kkl_section_v.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

const Eigen::Vector4d kLambda(1.0, 2.0, 3.0, 4.0);
constexpr double kEll = 3e-4;

double sampled(const theorems::Derivation& derivation, const std::string& name) {
  return rigor::midpoint(theorems::find_quantity(derivation, name).value);
}

/// As the captions print a number: rounded to a unit.
double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

TEST_CASE("one window of 20 s reproduces the twelve captions of Figures 1 to 6; a whole period does not") {
  const auto derivation = derive_kkl_section_v(kLambda, kEll);
  CHECK(sampled(derivation, "captions_reproduced_in_window") == 12.0);
  CHECK(sampled(derivation, "captions_reproduced") == 8.0);
  // The captions once more, from the paper.
  CHECK(rounded(sampled(derivation, "amplitude_in_window_at_10_mean"), 1e-4) == doctest::Approx(1.9999));
  CHECK(rounded(sampled(derivation, "amplitude_in_window_at_10_deviation"), 1e-4) == doctest::Approx(0.0947));
  CHECK(rounded(sampled(derivation, "frequency_in_window_at_10_mean"), 1e-4) == doctest::Approx(2.9956));
  CHECK(rounded(sampled(derivation, "frequency_in_window_at_10_deviation"), 1e-4) == doctest::Approx(0.1164));
  // With an ell for which mu does not vanish there is no estimate, and no caption is reproduced.
  CHECK(sampled(derive_kkl_section_v(kLambda, 5.0), "captions_reproduced_in_window") == 0.0);
}

/// The oracle: the observer itself, started at rest long before the window.
TEST_CASE("the closed form of the window is what the observer settles to") {
  constexpr double kInterval = 1e-3;
  constexpr double kSettling = 40.0;  // s
  const auto signal = [](double t) { return 2.0 * std::sin(3.0 * t) + 0.2 * std::sin(10.0 * t + 6.109); };
  trackers::KklObserver<double> observer({kLambda, kEll}, kInterval);
  double mean = 0.0;
  double squares = 0.0;
  int count = 0;
  const auto first = static_cast<int>(std::lround((5.687 - kSettling) / kInterval));
  const auto last = static_cast<int>(std::lround(25.674 / kInterval));
  for (int k = first; k < last; ++k) {
    observer.step_interpolated(signal(k * kInterval), signal((k + 1) * kInterval));
    if ((k + 1) * kInterval >= 5.687) {
      const double amplitude = observer.estimate().amplitude;
      mean += amplitude;
      squares += amplitude * amplitude;
      ++count;
    }
  }
  mean /= count;
  const SectionVRun window = run_caption_window(kLambda, kEll, 10.0);
  CHECK(window.amplitude.mean == doctest::Approx(mean).epsilon(1e-5));
  CHECK(window.amplitude.deviation ==
        doctest::Approx(std::sqrt(squares / count - mean * mean)).epsilon(1e-4));
}

}  // namespace
}  // namespace veritrack::kkl_observer

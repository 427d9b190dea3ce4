// What rounding adds to the bounds on the errors, and where there are none.
#include "analysis/kkl_observer/rounding/estimate_rounding.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;

KklRobustnessQuestion question_of(double low, double high) {
  KklRobustnessQuestion question;
  question.range = {rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)), Interval::from_bounds(2.0, 4.0)};
  question.amplitude = Interval::from_bounds(low, high);
  question.ell = Interval(3e-4);
  question.disturbance = BoundedDisturbance{Interval(1e-3 * low)};
  return question;
}

KklRobustness exact_bounds(double amplitude) {
  KklRobustness exact;
  exact.frequency_error_bound = Interval(0.1);
  exact.amplitude_error_bound = Interval(0.1 * amplitude);
  exact.largest_ell = Interval(1e-3);
  exact.smallest_relative_square = Interval(0.9);
  return exact;
}

KklRobustness with_rounding(const KklRobustnessQuestion& question, KklRobustness bounds) {
  const rigor::UpwardRounding upward;
  KklFilters<4> transient;
  transient.fill(rigor::symmetric(1e-6));
  add_rounding(question, transient, bounds);
  return bounds;
}

TEST_CASE("rounding adds little, the same to frequencies at every scale, in proportion to amplitudes") {
  const KklRobustness one = with_rounding(question_of(1.0, 1.0), exact_bounds(1.0));
  const double frequency = one.rounding.upper();
  const double amplitude = one.amplitude_error_bound.upper() - 0.1;
  CHECK(frequency > 1e-9);
  CHECK(frequency < 1e-6);
  CHECK(one.frequency_error_bound.upper() >= 0.1 + frequency);
  CHECK(one.frequency_error_bound.upper() <= 0.1 + 1.001 * frequency);
  CHECK(amplitude > 1e-9);
  CHECK(amplitude < 1e-4);
  const double scale = 0x1p150;
  const KklRobustness large = with_rounding(question_of(scale, scale), exact_bounds(scale));
  CHECK(large.rounding.upper() == doctest::Approx(frequency));
  CHECK(large.amplitude_error_bound.upper() / scale - 0.1 == doctest::Approx(amplitude));
}

TEST_CASE("less excitation, larger errors of the estimate: each makes rounding count for more") {
  const double usual = with_rounding(question_of(1.0, 1.0), exact_bounds(1.0)).rounding.upper();
  KklRobustness less = exact_bounds(1.0);
  less.largest_ell = Interval(5e-4);
  CHECK(with_rounding(question_of(1.0, 1.0), less).rounding.upper() > 1.5 * usual);
  less = exact_bounds(1.0);
  less.smallest_relative_square = Interval(0.2);
  CHECK(with_rounding(question_of(1.0, 1.0), less).rounding.upper() > 1.5 * usual);
  less = exact_bounds(1.0);
  less.frequency_error_bound = Interval(10.0);
  CHECK(with_rounding(question_of(1.0, 1.0), less).rounding.upper() > 1.5 * usual);
}

TEST_CASE("no bounds where there are none in exact arithmetic, out of range, or with an ell without room") {
  const auto has_bounds = [](const KklRobustnessQuestion& question, const KklRobustness& exact) {
    const KklRobustness found = with_rounding(question, exact);
    CHECK(rigor::is_finite(found.frequency_error_bound) == rigor::is_finite(found.rounding));
    return std::pair(rigor::is_finite(found.frequency_error_bound),
                     rigor::is_finite(found.amplitude_error_bound));
  };
  CHECK(has_bounds(question_of(1.0, 2.0), exact_bounds(1.0)) == std::pair(true, true));
  KklRobustness exact = exact_bounds(1.0);
  exact.frequency_error_bound = Interval();
  CHECK(has_bounds(question_of(1.0, 2.0), exact) == std::pair(false, false));
  exact = exact_bounds(1.0);
  exact.amplitude_error_bound = Interval();
  CHECK(has_bounds(question_of(1.0, 2.0), exact) == std::pair(true, false));
  exact.amplitude_error_bound = Interval(1.1);  // the amplitude may come out as zero
  CHECK(has_bounds(question_of(1.0, 2.0), exact) == std::pair(true, false));
  exact = exact_bounds(1.0);
  exact.largest_ell = Interval();
  CHECK(has_bounds(question_of(1.0, 2.0), exact) == std::pair(false, false));
  exact.largest_ell = Interval(3e-4);
  CHECK(has_bounds(question_of(1.0, 2.0), exact) == std::pair(false, false));
  exact = exact_bounds(0x1p-220);
  CHECK(has_bounds(question_of(0x1p-220, 0x1p-220), exact) == std::pair(false, false));
  exact = exact_bounds(1.0);
  CHECK(has_bounds(question_of(1.0, 0x1p242), exact) == std::pair(false, false));
}

}  // namespace
}  // namespace veritrack::kkl_observer

// [assume] of the extended Kalman filters.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/matrix.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/set_keys.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

/// Sampled, omega and 2 pi - omega give conjugate signals: a frequency beyond pi is another one in disguise.
bool frequency_of_a_sampled_signal(const Interval& x) {
  constexpr double kLargestDoubleBelowPi = 0x1.921fb54442d18p+1;
  return not_negative(x) && rigor::certainly_less_equal(x, Interval(kLargestDoubleBelowPi));
}

void frequency(const TomlValue& value, Assumptions& assume) {
  const std::vector<TomlValue> bounds = value.elements(2);
  const Number lowest = bounds[0].real(frequency_of_a_sampled_signal);
  const Number highest = bounds[1].real(frequency_of_a_sampled_signal);
  // Two decimals within one ulp of each other pass in any order: what is certified is the hull of the two
  // intervals.
  const bool hull_is_ordered = lowest.value.lower() <= highest.value.upper();
  if (!hull_is_ordered) {
    value.refuse(fmt::format("[{}, {}]", printable(lowest.text, 40), printable(highest.text, 40)));
  }
  assume.frequency = {lowest, highest};
}

/// One frequency, or a band.
void one_frequency_or_band(const TomlValue& value, Assumptions& assume) {
  if (!value.is_number()) {
    frequency(value, assume);
    return;
  }
  const Number number = value.real(frequency_of_a_sampled_signal);
  assume.frequency = {number, number};
}

/// Symmetry is that of the intervals: they hold the symmetric matrices that a certificate is about.
bool is_symmetric(const CovarianceArray& covariance) {
  for (std::size_t row = 0; row < covariance.size(); ++row) {
    for (std::size_t column = 0; column < row; ++column) {
      if (!rigor::identical(covariance[row][column].value, covariance[column][row].value)) {
        return false;
      }
    }
  }
  return true;
}

void initial_covariance(const TomlValue& value, Assumptions& assume) {
  if (value.is_string()) {
    if (value.line_of_text(100) != "steady-state") {
      value.refuse_kind();
    }
    assume.initial_covariance.reset();
    return;
  }
  CovarianceArray covariance;
  rigor::IntervalMatrix<3> matrix;
  const std::vector<TomlValue> rows = value.elements(covariance.size());
  for (std::size_t row = 0; row < covariance.size(); ++row) {
    const std::vector<TomlValue> entries = rows[row].elements(covariance.size());
    for (std::size_t column = 0; column < covariance.size(); ++column) {
      const Number number = entries[column].real(any_number);
      covariance[row][column] = number;
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = number.value;
    }
  }
  if (!is_symmetric(covariance)) {
    value.refuse("not symmetric");
  }
  switch (rigor::is_positive_definite(matrix)) {
    case rigor::Verdict::proved:
      break;
    case rigor::Verdict::refuted:
      value.refuse("not positive definite");
    case rigor::Verdict::undecided:
      value.refuse("too close to a singular matrix to be proved positive definite");
  }
  assume.initial_covariance = covariance;
}

using Assume = Assumptions;
constexpr std::array kAssumeKeys{
    Key<Assume>{"amplitude", kPositive, real<&Assume::amplitude, positive>, defaults_to("1")},
    Key<Assume>{
        "frequency",
        "[lowest, highest] in rad/sample, 0 <= lowest <= highest <= 3.141592653589793 (beyond pi a sampled "
        "frequency is the same as a lower one)",
        frequency, kRequired},
    Key<Assume>{"noise", kNotNegative, real<&Assume::noise, not_negative>, kRequired},
    Key<Assume>{"slew", kNotNegative, real<&Assume::slew, not_negative>, defaults_to("0")},
    Key<Assume>{"initial_frequency_error", kNotNegative, real<&Assume::initial_frequency_error, not_negative>,
                kRequired},
    Key<Assume>{"initial_phase_error", kNotNegative, real<&Assume::initial_phase_error, not_negative>,
                kRequired},
    Key<Assume>{"initial_amplitude_error", kNotNegative, real<&Assume::initial_amplitude_error, not_negative>,
                kRequired},
    Key<Assume>{"initial_covariance",
                "\"steady-state\" or a symmetric positive definite 3x3 array of numbers", initial_covariance,
                defaults_to("\"steady-state\"")},
};

/// kAssumeKeys with a frequency that may be one number.
constexpr std::array<Key<Assume>, kAssumeKeys.size()> with_one_frequency() {
  std::array<Key<Assume>, kAssumeKeys.size()> keys = kAssumeKeys;
  for (Key<Assume>& key : keys) {
    if (key.name == "frequency") {
      key.allowed =
          "a number or [lowest, highest] in rad/sample, 0 <= lowest <= highest <= 3.141592653589793 (beyond "
          "pi a sampled frequency is the same as a lower one)";
      key.read = one_frequency_or_band;
    }
  }
  return keys;
}
constexpr std::array kAssumeKeysWithOneFrequency = with_one_frequency();

}  // namespace

std::span<const Key<Assumptions>> assume_keys_with_one_frequency() {
  return kAssumeKeysWithOneFrequency;
}
std::span<const Key<Assumptions>> assume_keys() {
  return kAssumeKeys;
}
}  // namespace veritrack::certificates

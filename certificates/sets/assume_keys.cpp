// [assume] of the extended Kalman filters.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/matrix.hpp"
#include "certificates/design/hertz_keys.hpp"
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
  assume.frequency = read_band(value, frequency_of_a_sampled_signal);
}

/// One frequency, or a band.
void one_frequency_or_band(const TomlValue& value, Assumptions& assume) {
  if (!is_one_frequency(value)) {
    frequency(value, assume);
    return;
  }
  const Number number = read_frequency(value, frequency_of_a_sampled_signal);
  assume.frequency = {number, number};
}

/// A phase error beyond half a turn is a smaller one on the other side.
bool at_most_half_a_turn(const Interval& x) {
  constexpr double kSmallestDoubleAbovePi = 0x1.921fb54442d19p+1;
  return not_negative(x) && rigor::certainly_less_equal(x, Interval(kSmallestDoubleAbovePi));
}

bool within_200_decibels(const Interval& x) {
  return rigor::certainly_less_equal(rigor::abs(x), Interval(200.0));
}

/// x or { bound = x }.
Number bound_on_noise(const TomlValue& value) {
  if (!value.is_table()) {
    return value.real(not_negative);
  }
  const auto bound = value.fields({"bound"});
  if (!bound) {
    value.refuse("a table with other keys");
  }
  return bound->front().real(not_negative);
}
constexpr std::string_view kBoundOnNoise = "a number, 0 or more, or { bound = that number }";
void bounded_noise(const TomlValue& value, Assumptions& assume) {
  assume.noise = bound_on_noise(value);
}

/// The same where users sometimes ask for Gaussian noise, and nothing is certified with it.
void noise_in_a_disc(const TomlValue& value, Assumptions& assume) {
  if (value.is_table() && (value.fields({"snr_db"}) || value.fields({"deviation"}))) {
    value.refuse("Gaussian, with which nothing is certified for this tracker");
  }
  bounded_noise(value, assume);
}
constexpr std::string_view kNoiseInADisc =
    "a number, 0 or more, or { bound = that number }. Noise in a disc of the radius 1.42 A 10^(-SNR/20), A "
    "the "
    "amplitude, or twice the deviation of a channel, has the same variance: veritrack tune --objective "
    "simulated-rms compares simulations with it. As a model (docs/gaussian.md, section 15) the tracker can "
    "be "
    "certified in Gaussian noise";

/// A bound, or the deviation of Gaussian noise.
void noise(const TomlValue& value, Assumptions& assume) {
  read_noise(value, assume.noise, assume.gaussian);
}

/// Symmetry is that of the intervals: they contain the symmetric matrices that a certificate is about.
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

rigor::IntervalMatrix<3> matrix_of(const CovarianceArray& covariance) {
  rigor::IntervalMatrix<3> matrix;
  for (std::size_t row = 0; row < covariance.size(); ++row) {
    for (std::size_t column = 0; column < covariance.size(); ++column) {
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          covariance[row][column].value;
    }
  }
  return matrix;
}

/// A symmetric positive definite matrix.
CovarianceArray covariance_array(const TomlValue& value) {
  CovarianceArray covariance;
  const std::vector<TomlValue> rows = value.elements(covariance.size());
  for (std::size_t row = 0; row < covariance.size(); ++row) {
    const std::vector<TomlValue> entries = rows[row].elements(covariance.size());
    for (std::size_t column = 0; column < covariance.size(); ++column) {
      covariance[row][column] = entries[column].real(any_number);
    }
  }
  if (!is_symmetric(covariance)) {
    value.refuse("not symmetric");
  }
  switch (rigor::is_positive_definite(matrix_of(covariance))) {
    case rigor::Verdict::proved:
      break;
    case rigor::Verdict::refuted:
      value.refuse("not positive definite");
    case rigor::Verdict::undecided:
      value.refuse("too close to a singular matrix to be proved positive definite");
  }
  return covariance;
}

/// "steady-state" or one matrix.
void one_covariance(const TomlValue& value, Assumptions& assume) {
  assume.initial_covariance.reset();
  assume.covariance_range.reset();
  assume.covariance_multiples.reset();
  if (!value.is_string()) {
    assume.initial_covariance = covariance_array(value);
  } else if (value.line_of_text(100) != "steady-state") {
    value.refuse_kind();
  }
}

/// From one multiple of the printed matrix to another; the range is certainly not empty.
void covariance_multiples(const TomlValue& value, const TomlValue& from, const TomlValue& to,
                          Assumptions& assume) {
  const Number least = from.real(positive);
  const Number most = to.real(positive);
  if (!same_number(least, most) && !rigor::certainly_less(least.value, most.value)) {
    value.refuse(
        fmt::format("{{ from = {}, to = {} }}", printable(least.text, 40), printable(most.text, 40)));
  }
  assume.covariance_multiples = {least, most};
}

/// From one matrix to another that is certainly above it: no range without a matrix in it.
void covariance_range(const TomlValue& value, const TomlValue& from, const TomlValue& to,
                      Assumptions& assume) {
  const CovarianceArray least = covariance_array(from);
  const CovarianceArray most = covariance_array(to);
  switch (rigor::is_positive_definite(rigor::IntervalMatrix<3>(matrix_of(most) - matrix_of(least)))) {
    case rigor::Verdict::proved:
      break;
    case rigor::Verdict::refuted:
      value.refuse("not in order (to - from is not positive definite)");
    case rigor::Verdict::undecided:
      value.refuse("too narrow for to - from to be proved positive definite");
  }
  assume.covariance_range = {least, most};
}

void initial_covariance(const TomlValue& value, Assumptions& assume) {
  if (!value.is_table()) {
    one_covariance(value, assume);
    return;
  }
  assume.initial_covariance.reset();
  assume.covariance_range.reset();
  assume.covariance_multiples.reset();
  constexpr std::array<std::string_view, 2> kEnds{"from", "to"};
  const std::vector<TomlValue> ends = value.entries(kEnds);
  if (ends[0].is_number() != ends[1].is_number()) {
    value.refuse("a range between a matrix and a number");
  }
  (ends[0].is_number() ? covariance_multiples : covariance_range)(value, ends[0], ends[1], assume);
}

using Assume = Assumptions;
constexpr std::array kAssumeKeys{
    Key<Assume>{"amplitude", kPositive, real<&Assume::amplitude, positive>, defaults_to("1"), kWider},
    Key<Assume>{"sample_rate", kSampleRate, real<&Assume::sample_rate, positive>, kOptional, kOnlyEqual},
    Key<Assume>{"frequency",
                "[lowest, highest] in rad/sample, 0 <= lowest <= highest <= 3.141592653589793 (beyond pi a "
                "sampled frequency is the same as a lower one); f Hz at fs samples per second is 2 pi f/fs "
                "rad/sample: with sample_rate = fs write { hz = [lowest, highest] }",
                frequency, kRequired, kWiderBand},
    Key<Assume>{"noise", kBoundOnNoise, bounded_noise, kRequired, kContractOfNoise},
    Key<Assume>{"slew", kNotNegativeSlew, slew<&Assume::slew, not_negative>, defaults_to("0"), kMoreSlew},
    Key<Assume>{"initial_frequency_error", kNotNegativeFrequency,
                in_radians<&Assume::initial_frequency_error, not_negative>, kRequired, kMoreFrequency},
    Key<Assume>{
        "initial_phase_error",
        "a number from 0 to pi, rad (beyond half a turn an error of the phase is a smaller one on the "
        "other side)",
        real<&Assume::initial_phase_error, at_most_half_a_turn>, kRequired, kMore},
    Key<Assume>{"initial_amplitude_error", kNotNegative, real<&Assume::initial_amplitude_error, not_negative>,
                kRequired, kMore},
    Key<Assume>{
        "initial_covariance",
        "\"steady-state\", a symmetric positive definite 3x3 array of numbers, or { from = ..., to = "
        "... } with two such arrays, the first below the second, or with two numbers above 0, multiples "
        "of the steady state, the first not above the second",
        initial_covariance, defaults_to("\"steady-state\""), kWider},
};

/// kAssumeKeys with noise that may be Gaussian, and the keys that go with that.
constexpr std::array<Key<Assume>, kAssumeKeys.size() + 2> with_gaussian_noise() {
  std::array<Key<Assume>, kAssumeKeys.size() + 2> keys{};
  std::copy(kAssumeKeys.begin(), kAssumeKeys.end(), keys.begin());
  for (Key<Assume>& key : keys) {
    if (key.name == "noise") {
      key.allowed = kNoiseThatMayBeGaussian;
      key.read = noise;
    }
  }
  keys[kAssumeKeys.size()] = {"frequency_walk", kNotNegativeFrequency,
                              in_radians<&Assume::frequency_walk, not_negative>, kOptional, kMoreFrequency};
  keys[kAssumeKeys.size() + 1] = {"samples", kSamplesOfProbability,
                                  real<&Assume::samples, is_number_of_samples>, kOptional, kMoreSamples};
  return keys;
}
constexpr std::array kAssumeKeysWithGaussianNoise = with_gaussian_noise();

/// kAssumeKeys with a frequency that may be one number, without ranges of covariances, and with a remark on
/// Gaussian noise.
constexpr std::array<Key<Assume>, kAssumeKeys.size()> with_one_frequency() {
  std::array<Key<Assume>, kAssumeKeys.size()> keys = kAssumeKeys;
  for (Key<Assume>& key : keys) {
    if (key.name == "frequency") {
      key.allowed =
          "a number or [lowest, highest] in rad/sample, 0 <= lowest <= highest <= 3.141592653589793 (beyond "
          "pi a sampled frequency is the same as a lower one); f Hz at fs samples per second is 2 pi f/fs "
          "rad/sample: with sample_rate = fs write { hz = f } or { hz = [lowest, highest] }";
      key.read = one_frequency_or_band;
    } else if (key.name == "initial_covariance") {
      key.allowed = "\"steady-state\" or a symmetric positive definite 3x3 array of numbers";
      key.read = one_covariance;
    } else if (key.name == "noise") {
      key.allowed = kNoiseInADisc;
      key.read = noise_in_a_disc;
    }
  }
  return keys;
}
constexpr std::array kAssumeKeysWithOneFrequency = with_one_frequency();

}  // namespace

std::span<const Key<Assumptions>> assume_keys_with_one_frequency() {
  return kAssumeKeysWithOneFrequency;
}
void read_noise(const TomlValue& value, Number& bound, std::optional<GaussianNoise>& gaussian) {
  gaussian.reset();
  if (!value.is_table() || value.fields({"bound"})) {
    bound = bound_on_noise(value);
    return;
  }
  bound = {};
  if (const auto level = value.fields({"snr_db"})) {
    gaussian = GaussianNoise{level->front().real(within_200_decibels), std::nullopt};
  } else if (const auto deviation = value.fields({"deviation"})) {
    gaussian = GaussianNoise{std::nullopt, deviation->front().real(positive)};
  } else {
    value.refuse("a table with other keys");
  }
}

bool is_number_of_samples(const Interval& x) {
  return rigor::certainly_less_equal(Interval(1.0), x) && rigor::certainly_less_equal(x, Interval(1e15));
}

std::span<const Key<Assumptions>> assume_keys() {
  return kAssumeKeysWithGaussianNoise;
}
}  // namespace veritrack::certificates

// Frequencies in rad/sample and, with a sample rate, in Hz.
#pragma once

#include <optional>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "certificates/design/design.hpp"

namespace veritrack::certificates {

class FrequencyUnits {
 public:
  /// `sample_rate` in Hz; it must outlive the units.
  explicit FrequencyUnits(const std::optional<Number>& sample_rate) : sample_rate_(&sample_rate) {}
  explicit FrequencyUnits(std::optional<Number>&&) = delete;

  /// Whether there is a sample rate.
  [[nodiscard]] bool has_hertz() const { return sample_rate_->has_value(); }
  /// rad/sample in Hz; needs a sample rate. Holds its own rounding mode, as do all of these.
  [[nodiscard]] rigor::Interval in_hertz(const rigor::Interval& radians) const;
  /// In Hz with a sample rate, else unchanged; in doubles, for pictures.
  [[nodiscard]] double drawn(double radians) const;
  /// "Hz" or "rad/sample": the unit of `drawn`.
  [[nodiscard]] std::string drawn_unit() const { return has_hertz() ? "Hz" : "rad/sample"; }

  // "0.0021 rad/sample (3.4 Hz)", the second only with a sample rate. "unknown" unless finite.

  /// An upper bound, both rounded up.
  [[nodiscard]] std::string at_most(double radians, int digits = 4) const;
  [[nodiscard]] std::string at_most(const rigor::Interval& radians, int digits = 4) const;
  /// A lower bound, both rounded down.
  [[nodiscard]] std::string at_least(double radians, int digits = 4) const;
  [[nodiscard]] std::string at_least(const rigor::Interval& radians, int digits = 4) const;
  /// "3.14e-7 rad/sample per sample (5 Hz per second)": a slew, both rounded down.
  [[nodiscard]] std::string slew(double radians, int digits = 4) const;
  [[nodiscard]] std::string slew(const rigor::Interval& radians, int digits = 4) const;

  // The same for a decimal that stands in a sentence: the words are true of the decimal.

  [[nodiscard]] std::string at_most(const std::string& decimal) const;
  [[nodiscard]] std::string at_least(const std::string& decimal) const;
  [[nodiscard]] std::string slew(const std::string& decimal) const;
  /// "-1.7e-6 and 9e-7 rad/sample (-0.0028 and 0.0015 Hz)": the values between two decimals.
  [[nodiscard]] std::string between(const std::string& low, const std::string& high) const;

  /// ", sampled at 8000 Hz," of a tone in a sentence; empty without a sample rate.
  [[nodiscard]] std::string sampled() const;

 private:
  const std::optional<Number>* sample_rate_;
};

/// A frequency of the design file as written in sentences: "5 Hz" or "0.05 rad/sample".
[[nodiscard]] std::string frequency_words(const Number& number);
/// A slew likewise: "200 Hz per second" or "0.001 rad/sample per sample".
[[nodiscard]] std::string slew_words(const Number& number);
/// A time likewise: "0.01 seconds" or "120 samples".
[[nodiscard]] std::string time_words(const Number& number);

/// "[lower, upper]" with `digits` significant digits, rounded outward; "unknown" unless finite.
[[nodiscard]] std::string outward(const rigor::Interval& range, int digits = 4);

}  // namespace veritrack::certificates

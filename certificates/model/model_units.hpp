// Frequencies of a model in rad/sample and, with a sample rate, in Hz.
#pragma once

#include <string>

#include "analysis/rigor/interval.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

class ModelUnits {
 public:
  /// `assume` must outlive the units.
  explicit ModelUnits(const ModelAssumptions& assume) : assume_(&assume) {}

  /// Whether there is a sample rate.
  [[nodiscard]] bool has_hertz() const { return assume_->sample_rate.has_value(); }
  /// rad/sample in Hz; needs a sample rate and the upward rounding mode.
  [[nodiscard]] rigor::Interval in_hertz(const rigor::Interval& radians) const;
  /// In Hz with a sample rate, else unchanged; in doubles, for pictures.
  [[nodiscard]] double drawn(double radians) const;
  /// "Hz" or "rad/sample": the unit of `drawn`.
  [[nodiscard]] std::string drawn_unit() const { return has_hertz() ? "Hz" : "rad/sample"; }

  /// "0.0021 rad/sample (3.4 Hz)": an upper bound, both rounded up. "unknown" unless finite.
  [[nodiscard]] std::string at_most(double radians) const;
  /// Likewise a lower bound, rounded down.
  [[nodiscard]] std::string at_least(double radians) const;
  /// "3.14e-7 rad/sample per sample (5 Hz per second)": a slew, both rounded down.
  [[nodiscard]] std::string slew(double radians) const;

 private:
  const ModelAssumptions* assume_;
};

/// "[lower, upper]" with `digits` significant digits, rounded outward; "unknown" unless finite.
[[nodiscard]] std::string outward(const rigor::Interval& range, int digits = 4);

}  // namespace veritrack::certificates

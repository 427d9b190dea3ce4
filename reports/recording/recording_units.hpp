// Numbers of a recording as sentences have them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reports/recording/sample_ranges.hpp"

namespace veritrack::reports {

/// Frequencies in rad/sample and, when the sample rate is known, in Hz.
class RecordingUnits {
 public:
  /// `sample_rate` in Hz.
  explicit RecordingUnits(std::optional<double> sample_rate) : sample_rate_(sample_rate) {}

  [[nodiscard]] bool has_hertz() const { return sample_rate_.has_value(); }
  /// Hz, or rad/sample without a sample rate: for pictures, with `drawn_unit`.
  [[nodiscard]] double drawn(double radians) const;
  [[nodiscard]] std::string drawn_unit() const { return has_hertz() ? "Hz" : "rad/sample"; }
  /// s, or the number of the sample, with `drawn_time_unit`.
  [[nodiscard]] double drawn_time(std::int64_t sample) const;
  [[nodiscard]] std::string drawn_time_unit() const { return has_hertz() ? "s" : "sample"; }

  /// "0.3142 rad/sample (50 Hz)".
  [[nodiscard]] std::string frequency(double radians) const;
  /// "1e-06 rad/sample per sample (0.16 Hz per second)".
  [[nodiscard]] std::string slew(double radians) const;
  /// "sample 1200 (0.12 s)".
  [[nodiscard]] std::string sample(std::int64_t index) const;

 private:
  std::optional<double> sample_rate_;
};

/// "samples 3 to 5, 8 and 11 to 20", and how many more when there are more than `most`; "none".
[[nodiscard]] std::string listed(const SampleRanges& ranges, std::size_t most);

}  // namespace veritrack::reports

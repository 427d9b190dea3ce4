#include "reports/recording/recording_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

namespace veritrack::reports {

double RecordingUnits::drawn(double radians) const {
  return sample_rate_ ? radians * *sample_rate_ / (2.0 * std::numbers::pi) : radians;
}

double RecordingUnits::drawn_time(std::int64_t sample) const {
  const auto number = static_cast<double>(sample);
  return sample_rate_ ? number / *sample_rate_ : number;
}

std::string RecordingUnits::frequency(double radians) const {
  return fmt::format("{:.5g} rad/sample", radians) +
         (has_hertz() ? fmt::format(" ({:.6g} Hz)", drawn(radians)) : "");
}

std::string RecordingUnits::slew(double radians) const {
  return fmt::format("{:.3g} rad/sample per sample", radians) +
         (sample_rate_ ? fmt::format(" ({:.3g} Hz per second)", drawn(radians) * *sample_rate_) : "");
}

std::string RecordingUnits::sample(std::int64_t index) const {
  return fmt::format("sample {}", index) + (has_hertz() ? fmt::format(" ({:.6g} s)", drawn_time(index)) : "");
}

std::string listed(const SampleRanges& ranges, std::size_t most) {
  if (ranges.count() == 0) {
    return "none";
  }
  const std::size_t shown = std::min(most, ranges.kept().size());
  std::string text = ranges.count() == 1 && ranges.kept().front().first == ranges.kept().front().last
                         ? "sample "
                         : "samples ";
  for (std::size_t i = 0; i < shown; ++i) {
    const auto [first, last] = ranges.kept()[i];
    text += i == 0 ? "" : i + 1 == ranges.count() ? " and " : ", ";
    text += first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last);
  }
  if (shown < ranges.count()) {
    text += fmt::format(", and {} more ranges", ranges.count() - shown);
  }
  return text;
}

}  // namespace veritrack::reports

// A tone whose amplitude does not stay.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

constexpr double kSmallestChange = 0.02;

class AmplitudeDetector : public Detector {
 public:
  explicit AmplitudeDetector(const certificates::SignalAssumptions& assume)
      : is_free_(assume.amplitude_varies) {}

  bool judge(const ExaminedBlock& block) override {
    bool is_changed = false;
    for (const FittedPart& each : block.amplitudes) {
      if (!(reference_ > 0.0)) {
        reference_ = each.size;
        deviation_ = each.deviation;
      }
      const double change = std::fabs(each.size - reference_);
      is_changed = is_changed || (change > kSmallestChange * reference_ &&
                                  change > kSureDeviations * std::hypot(each.deviation, deviation_));
      least_ = least_ > 0.0 ? std::min(least_, each.size) : each.size;
      largest_ = std::max(largest_, each.size);
    }
    if (is_changed) {
      where_.add(block.first, block.last());
    }
    return true;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    const auto& [low, high] = context.assume.amplitude;
    const bool is_allowed = is_free_ && low <= least_ * context.scale && largest_ * context.scale <= high;
    if (where_.count() == 0 || is_allowed) {
      return std::nullopt;
    }
    Finding finding;
    finding.name = "amplitude drift";
    finding.sees = fmt::format("The tone's amplitude moves between {:.3g} and {:.3g}; it begins at {:.3g}.",
                               least_, largest_, reference_);
    finding.where = where_;
    const double margin = 1.0 + kSmallestChange;
    finding.remedy = "Hold the amplitude with a gain control before the tracker; or ";
    finding.remedy +=
        context.assume.has_signal_key
            ? fmt::format("certify the tracker for the range, `amplitude = [{:.3g}, {:.3g}]` under [assume]",
                          least_ * context.scale / margin, largest_ * context.scale * margin)
            : fmt::format(
                  "count it as noise: the distance to a tone of amplitude {:.3g} adds up to {:.3g} to "
                  "`noise`",
                  reference_ * context.scale,
                  std::max(largest_ - reference_, reference_ - least_) * context.scale);
    finding.remedy += ".";
    finding.is_signal = true;
    return finding;
  }

 private:
  bool is_free_;
  double reference_ = 0.0;  ///< the first one
  double deviation_ = 0.0;
  double least_ = 0.0;
  double largest_ = 0.0;
  SampleRanges where_;
};

}  // namespace

std::unique_ptr<Detector> amplitude_detector(const certificates::SignalAssumptions& assume) {
  return std::make_unique<AmplitudeDetector>(assume);
}

}  // namespace veritrack::reports

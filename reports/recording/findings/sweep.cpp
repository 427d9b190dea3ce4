// A frequency that moves faster than the design assumes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class SweepDetector : public Detector {
 public:
  SweepDetector(const certificates::SignalAssumptions& assume, int channels)
      : slew_(assume.slew), channels_(channels) {}

  void see(const ToneStretch& stretch, std::span<const RecordedSample> /*samples*/) override {
    const double deviation = deviation_of(stretch);
    if (stretch.follows && slew_) {
      const double distance = 0.5 * static_cast<double>(stretch.length + last_.length);
      const double slew = std::fabs(stretch.frequency - last_.frequency) / distance;
      if (slew - kSureDeviations * std::hypot(deviation, last_deviation_) / distance > *slew_) {
        where_.add(last_.first + last_.length / 2, stretch.first + stretch.length / 2);
        largest_ = std::max(largest_, slew);
      }
    }
    last_ = stretch;
    last_deviation_ = deviation;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    if (where_.count() == 0) {
      return std::nullopt;
    }
    Finding finding;
    finding.name = "fast sweep";
    finding.sees = fmt::format("The frequency moves by up to {}, and the design assumes at most {}.",
                               context.units.slew(largest_), context.units.slew(*slew_));
    finding.where = where_;
    constexpr double kMargin = 1.2;
    finding.remedy = fmt::format(
        "Certify the tracker for it, `slew = {:.2g}` under [assume]; if that is not proved, a "
        "tracker with a larger gain follows faster (`veritrack tune`).",
        kMargin * largest_);
    finding.is_slew = true;
    return finding;
  }

 private:
  /// The deviation of the frequency, in white noise (Cramer and Rao, twice for Hann's window), and from the
  /// leakage of other lines.
  [[nodiscard]] double deviation_of(const ToneStretch& stretch) const {
    constexpr double kLeak = 0.01;  // bins
    const double length = static_cast<double>(stretch.length);
    const double share = std::clamp(stretch.share, 1e-3, 1.0);
    // The power of noise over that of the tone.
    const double ratio = (1.0 - share) / share;
    const double white = std::sqrt(2.0 * (channels_ > 1 ? 6.0 : 12.0) * ratio / (length * length * length));
    return std::hypot(white, kLeak * 2.0 * std::numbers::pi / length);
  }

  std::optional<double> slew_;
  int channels_;
  ToneStretch last_;
  double last_deviation_ = 0.0;
  double largest_ = 0.0;
  SampleRanges where_;
};

}  // namespace

std::unique_ptr<Detector> sweep_detector(const certificates::SignalAssumptions& assume, int channels) {
  return std::make_unique<SweepDetector>(assume, channels);
}

}  // namespace veritrack::reports

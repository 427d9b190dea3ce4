// Values that lie on coarse steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class QuantisationDetector : public Detector {
 public:
  QuantisationDetector(const certificates::SignalAssumptions& assume, int channels)
      : noise_(assume.noise), channels_(channels) {}

  bool judge(const ExaminedBlock& block) override {
    const double step = step_of(block);
    // Noise of more than a step hides it; a tone whose periods are whole numbers of samples has few values,
    // and a residual that is no step's.
    constexpr double kHidden = 0.7;
    constexpr double kLeastResidual = 0.15;
    constexpr double kCoarse = 1.0 / 256.0;
    const bool is_seen = step > kCoarse * block.amplitude && block.noise_deviation < kHidden * step &&
                         block.noise_deviation > kLeastResidual * step;
    if (is_seen) {
      where_.add(block.first, block.last());
      step_ = std::max(step_, step);
      amplitude_ = block.amplitude;
    }
    return !is_seen;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    if (where_.count() == 0) {
      return std::nullopt;
    }
    const double half = 0.5 * step_ * context.scale * std::sqrt(static_cast<double>(channels_));
    Finding finding;
    finding.name = "quantisation";
    finding.sees = fmt::format(
        "The values lie on steps of {:.3g}, {:.2g} % of the tone's amplitude, and noise does not "
        "hide them.",
        step_, 100.0 * step_ / amplitude_);
    finding.where = where_;
    finding.remedy = fmt::format(
        "Record with more bits or more gain; or count it as noise: `noise` of at least {:.2g} "
        "under [assume] has room for it. It is not Gaussian.",
        half);
    finding.is_signal = !noise_.has_value();
    return finding;
  }

 private:
  /// The step of which all differences of values are whole multiples; 0 when there is none.
  [[nodiscard]] double step_of(const ExaminedBlock& block) const {
    std::vector<double> values;
    for (const RecordedSample& each : block.samples) {
      values.push_back(each.in_phase);
      if (channels_ > 1) {
        values.push_back(each.quadrature);
      }
    }
    std::sort(values.begin(), values.end());
    const double tolerance = 1e-6 * (values.back() - values.front());
    double step = values.back() - values.front();
    for (std::size_t k = 1; k < values.size(); ++k) {
      const double difference = values[k] - values[k - 1];
      if (difference > tolerance) {
        step = std::min(step, difference);
      }
    }
    const bool is_steady = step > 0.0 && std::all_of(values.begin(), values.end(), [&](double value) {
                             return std::fabs(std::remainder(value - values.front(), step)) <= kSteady * step;
                           });
    return is_steady ? step : 0.0;
  }

  static constexpr double kSteady = 0.01;
  std::optional<double> noise_;
  int channels_;
  double step_ = 0.0;
  double amplitude_ = 0.0;
  SampleRanges where_;
};

}  // namespace

std::unique_ptr<Detector> quantisation_detector(const certificates::SignalAssumptions& assume, int channels) {
  return std::make_unique<QuantisationDetector>(assume, channels);
}

}  // namespace veritrack::reports

// A constant beside the tone.
#include <fmt/format.h>

#include <cmath>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class OffsetDetector : public Detector {
 public:
  explicit OffsetDetector(int channels) : channels_(channels) {}

  bool judge(const ExaminedBlock& block) override {
    const FittedPart& offset = block.offset;
    if (offset.size > 0.0 && is_there(offset, block.amplitude, channels_)) {
      where_.add(block.first, block.last());
      sum_ += offset.value;
      amplitudes_ += block.amplitude;
      ++blocks_;
    }
    return true;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    if (blocks_ == 0) {
      return std::nullopt;
    }
    const std::complex<double> mean = sum_ / static_cast<double>(blocks_);
    const std::string size =
        channels_ > 1 ? fmt::format("{:.3g} in phase and {:.3g} in quadrature", mean.real(), mean.imag())
                      : fmt::format("{:.3g}", mean.real());
    Finding finding;
    finding.name = "DC offset";
    finding.sees = fmt::format("A constant of {} is added to a tone of amplitude {:.3g}.", size,
                               amplitudes_ / static_cast<double>(blocks_));
    finding.where = where_;
    finding.remedy = fmt::format(
        "Subtract it before the tracker, or use a high-pass filter{}.",
        context.assume.has_signal_key && channels_ == 1
            ? fmt::format("; or make it a part of the signal that is certified: `signal = "
                          "'{} {} {:.3g}'` under [assume]",
                          "A*cos(phi)", mean.real() < 0.0 ? "-" : "+", std::fabs(mean.real() * context.scale))
            : std::string());
    finding.is_signal = true;
    return finding;
  }

 private:
  int channels_;
  SampleRanges where_;
  std::complex<double> sum_ = 0.0;
  double amplitudes_ = 0.0;
  std::int64_t blocks_ = 0;
};

}  // namespace

std::unique_ptr<Detector> offset_detector(int channels) {
  return std::make_unique<OffsetDetector>(channels);
}

}  // namespace veritrack::reports

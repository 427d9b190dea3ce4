// The frequency of the mains, 50 or 60 Hz.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class HumDetector : public Detector {
 public:
  bool judge(const ExaminedBlock& block) override {
    const FittedPart* largest = nullptr;
    double beside = 0.0;  // breath or wind, which is all about, is no hum
    for (const FittedPart& each : block.hum) {
      const bool is_mains = each.hertz == 50.0 || each.hertz == 60.0;
      beside = is_mains ? beside : std::max(beside, each.size);
      if (is_mains && is_there(each, block.amplitude, 2) &&
          (largest == nullptr || each.size > largest->size)) {
        largest = &each;
      }
    }
    constexpr double kStandsOut = 3.0;
    if (largest != nullptr && largest->size > kStandsOut * beside) {
      Seen& seen = seen_[largest->hertz];
      seen.sizes += largest->size;
      seen.amplitudes += block.amplitude;
      ++seen.blocks;
      where_.add(block.first, block.last());
    }
    return true;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    (void)context;
    if (seen_.empty()) {
      return std::nullopt;
    }
    const auto& [hertz, seen] = *std::max_element(
        seen_.begin(), seen_.end(),
        [](const auto& one, const auto& other) { return one.second.blocks < other.second.blocks; });
    Finding finding;
    finding.name = "hum";
    finding.sees = fmt::format(
        "A line at {:g} Hz of amplitude {:.3g} beside a tone of amplitude {:.3g}: mains hum.", hertz,
        seen.sizes / static_cast<double>(seen.blocks), seen.amplitudes / static_cast<double>(seen.blocks));
    finding.where = where_;
    finding.remedy = fmt::format(
        "Shield the input or break its ground loop; or take the line away before the tracker "
        "with a notch or high-pass filter at {:g} Hz.",
        hertz);
    finding.is_signal = true;
    return finding;
  }

 private:
  struct Seen {
    double sizes = 0.0;
    double amplitudes = 0.0;
    std::int64_t blocks = 0;
  };

  std::map<double, Seen> seen_;
  SampleRanges where_;
};

}  // namespace

std::unique_ptr<Detector> hum_detector() {
  return std::make_unique<HumDetector>();
}

}  // namespace veritrack::reports

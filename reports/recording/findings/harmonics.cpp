// Whole multiples of the tone's frequency that the design's signal does not have.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class HarmonicsDetector : public Detector {
 public:
  bool judge(const ExaminedBlock& block) override {
    bool is_any = false;
    for (const FittedPart& each : block.harmonics) {
      if (is_there(each, block.amplitude, 2)) {
        Seen& seen = seen_[each.order];
        seen.values += each.value / block.amplitude;
        seen.squares += each.size * each.size / (block.amplitude * block.amplitude);
        ++seen.blocks;
        is_any = true;
      }
    }
    if (is_any) {
      where_.add(block.first, block.last());
    }
    return true;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    if (seen_.empty()) {
      return std::nullopt;
    }
    std::vector<std::string> parts;
    std::string formula = "A*cos(phi)";
    bool is_steady = true;
    for (const auto& [order, seen] : seen_) {
      const double blocks = static_cast<double>(seen.blocks);
      const double size = std::sqrt(seen.squares / blocks);
      parts.push_back(fmt::format("the {} with {:.2g} % of the tone's amplitude ({:.2g} % of its power)",
                                  ordinal(order), 100.0 * size, 100.0 * size * size));
      const std::complex<double> mean = seen.values / blocks;
      is_steady = is_steady && std::abs(mean) > kSteady * size;
      formula += fmt::format(" + {:.3g}*A*cos({}*phi {} {:.3g})", std::abs(mean), order,
                             std::arg(mean) < 0.0 ? "-" : "+", std::fabs(std::arg(mean)));
    }
    Finding finding;
    finding.name = "harmonics";
    finding.sees = fmt::format("Multiples of the tone's frequency: {}.", fmt::join(parts, "; "));
    finding.where = where_;
    finding.remedy = "Take them away with a band-pass filter before the tracker";
    if (context.assume.has_signal_key && context.channels == 1 && context.waveform.is_tone() && is_steady) {
      finding.remedy += fmt::format(
          "; or make them a part of the signal that is certified: `signal = '{}'` under [assume]", formula);
    } else if (!context.assume.has_signal_key) {
      finding.remedy += "; or write the tracker as a `model`, whose `signal` may have harmonics";
    }
    finding.remedy += ".";
    finding.is_signal = true;
    return finding;
  }

 private:
  struct Seen {
    std::complex<double> values = 0.0;
    double squares = 0.0;
    std::int64_t blocks = 0;
  };

  static std::string ordinal(int order) {
    return order == 2 ? "second" : order == 3 ? "third" : fmt::format("{}th", order);
  }

  /// Phases of a harmonic that stay have a mean as large as the harmonic.
  static constexpr double kSteady = 0.9;
  std::map<int, Seen> seen_;
  SampleRanges where_;
};

}  // namespace

std::unique_ptr<Detector> harmonics_detector() {
  return std::make_unique<HarmonicsDetector>();
}

}  // namespace veritrack::reports

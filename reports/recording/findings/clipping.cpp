// Samples that all stop at one value where the tone goes on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

/// The samples at one end of a channel's values.
struct End {
  double value = 0.0;
  std::vector<std::size_t> places;
  bool is_clipped = false;
};

/// `values` of a channel, `sign` 1 for the upper end and -1 for the lower one. At least 8 samples and 0.5 %
/// of all have the largest value to within a hundredth of a percent of the range. A tone that is not clipped
/// has at most 2.5 times as many there as in the next such step, however coarse its steps are (arc cosine of
/// 1 - q against that of 1 - 2q), and noise without a bound has fewer. Where a tone has whole numbers of
/// samples in its periods, the fitted tone does not vary over the samples at the end.
End end_of(std::span<const double> values, std::span<const double> tone, double range, double sign) {
  constexpr std::size_t kLeast = 8;
  constexpr double kLeastShare = 0.005;
  constexpr double kMore = 4.0;
  constexpr double kSame = 1e-4;
  constexpr double kNext = 0.005;
  constexpr double kVaries = 2e-3;
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  End end;
  end.value = sign > 0.0 ? *largest : *least;
  double below = range;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double distance = sign * (end.value - values[k]);
    if (distance <= kSame * range) {
      end.places.push_back(k);
    } else {
      below = std::min(below, distance);
    }
  }
  if (end.places.size() < kLeast ||
      static_cast<double>(end.places.size()) < kLeastShare * static_cast<double>(values.size())) {
    return end;
  }
  // The step of coarse values, or a part of the range.
  const double next = std::max(kNext * range, 1.01 * below < 0.2 * range ? 1.01 * below : 0.0);
  const auto beside = static_cast<double>(std::count_if(values.begin(), values.end(), [&](double value) {
    const double distance = sign * (end.value - value);
    return distance > kSame * range && distance <= next;
  }));
  double low = tone[end.places.front()];
  double high = low;
  for (const std::size_t k : end.places) {
    low = std::min(low, tone[k]);
    high = std::max(high, tone[k]);
  }
  end.is_clipped = static_cast<double>(end.places.size()) > kMore * beside &&
                   high - low > std::max(kVaries * range, 2.0 * below);
  return end;
}

class ClippingDetector : public Detector {
 public:
  explicit ClippingDetector(int channels) : channels_(channels) {}

  bool judge(const ExaminedBlock& block) override {
    bool is_clean = true;
    std::vector<double> values(block.samples.size());
    std::vector<double> tone(block.samples.size());
    std::vector<std::size_t> places;
    for (int channel = 0; channel < channels_; ++channel) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = channel == 0 ? block.samples[k].in_phase : block.samples[k].quadrature;
        tone[k] = channel == 0 ? block.tone[k].real() : block.tone[k].imag();
      }
      const auto [least, largest] = std::minmax_element(values.begin(), values.end());
      for (std::size_t begin = 0; begin < values.size(); begin += kPiece) {
        const std::size_t count = std::min(kPiece, values.size() - begin);
        for (const double sign : {1.0, -1.0}) {
          const End end = end_of(std::span(values).subspan(begin, count),
                                 std::span(tone).subspan(begin, count), *largest - *least, sign);
          if (end.is_clipped) {
            is_clean = false;
            (sign > 0.0 ? upper_ : lower_) = end.value;
            for (const std::size_t k : end.places) {
              places.push_back(begin + k);
            }
          }
        }
      }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    // A tone that is flat for most of the time has another waveform: its harmonics are the finding.
    constexpr double kSquare = 0.75;
    if (static_cast<double>(places.size()) > kSquare * static_cast<double>(block.samples.size()) &&
        channels_ == 1) {
      return true;
    }
    for (const std::size_t k : places) {
      const std::int64_t index = block.first + static_cast<std::int64_t>(k);
      where_.add(index, index);
    }
    judged_ += static_cast<std::int64_t>(block.samples.size());
    return is_clean;
  }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    (void)context;
    if (where_.count() == 0) {
      return std::nullopt;
    }
    Finding finding;
    finding.name = "clipping";
    std::string levels = upper_ ? fmt::format("{:.4g}", *upper_) : std::string();
    if (lower_) {
      levels += fmt::format("{}{:.4g}", levels.empty() ? "" : " and ", *lower_);
    }
    finding.sees =
        fmt::format("{:.2g} % of the samples stop at {}, where the tone goes on.",
                    100.0 * static_cast<double>(where_.samples()) / static_cast<double>(judged_), levels);
    finding.where = where_;
    finding.remedy =
        "Lower the gain before the converter and record again: no filter brings the peaks back. Offset, "
        "harmonics, hum "
        "and drift were not looked for in these stretches.";
    finding.is_signal = true;
    return finding;
  }

 private:
  static constexpr std::int64_t kBridge = 4096;
  static constexpr std::size_t kPiece = 512;  // samples: what is clipped in part shows in its pieces
  int channels_;
  SampleRanges where_{kBridge};
  std::optional<double> upper_;
  std::optional<double> lower_;
  std::int64_t judged_ = 0;
};

}  // namespace

std::unique_ptr<Detector> clipping_detector(int channels) {
  return std::make_unique<ClippingDetector>(channels);
}

}  // namespace veritrack::reports

// Samples that stand for nothing: the tone is away for a while, or frozen, and silence before and after it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/recording/findings/detectors.hpp"

namespace veritrack::reports {

namespace {

class DropoutDetector : public Detector {
 public:
  explicit DropoutDetector(int channels) : channels_(channels) {}

  /// A tone is below a twentieth of its amplitude for a tenth of a radian at a time: a run of a radian is
  /// none. Nor is one of three radians in which no sample differs.
  void see(const ToneStretch& stretch, std::span<const RecordedSample> samples) override {
    if (!stretch.has_tone && !(amplitude_ > 0.0)) {
      // How loud the tone is, is not known yet.
      if (!before_.empty()) {
        quiet_.add(waiting_, waiting_ + static_cast<std::int64_t>(before_.size()) - 1);
        loudest_before_ = std::max(loudest_before_, last_loudness_);
      }
      waiting_ = stretch.first;
      last_loudness_ = stretch.root_mean_square;
      before_.assign(samples.begin(), samples.end());
      return;
    }
    if (stretch.has_tone) {
      // A stretch that is silent in part has a smaller amplitude.
      amplitude_ = stretch.follows ? std::max(stretch.amplitude, kKept * amplitude_) : stretch.amplitude;
      frequency_ = std::fabs(stretch.frequency);
    }
    if (!before_.empty()) {
      constexpr double kSilent = 0.02;
      if (quiet_.count() > 0 && loudest_before_ < kSilent * amplitude_) {
        runs_.add(quiet_.kept().front().first, quiet_.kept().front().last);
      }
      scan(waiting_, before_);
      before_.clear();
    }
    scan(stretch.first, samples);
  }

  bool judge(const ExaminedBlock& block) override { return last_bad_ < block.first; }

  [[nodiscard]] std::optional<Finding> finding(const FindingContext& context) const override {
    (void)context;
    const SampleRanges& where = runs_;
    if (where.count() == 0) {
      return std::nullopt;
    }
    const auto is_long = [](const SampleRange& each) { return each.last - each.first + 1 >= kSilence; };
    const bool has_silence = std::any_of(where.kept().begin(), where.kept().end(), is_long);
    const bool is_all = std::all_of(where.kept().begin(), where.kept().end(), is_long);
    Finding finding;
    finding.name = is_all ? "silence" : has_silence ? "dropouts and silence" : "dropouts";
    finding.sees = fmt::format("The tone is away, or one value stays, for {} samples{}.", where.samples(),
                               where.count() > 1 ? fmt::format(" in {} places", where.count()) : "");
    finding.where = where;
    finding.remedy = has_silence ? "Leave the silence out: `--from` and `--to` choose the samples. " : "";
    finding.remedy +=
        is_all ? ""
               : "Mark dropouts as missing (an empty cell, NaN), so that an extended Kalman filter goes on "
                 "by its prediction. ";
    finding.remedy += "A certificate counts again from a start behind them.";
    finding.is_missing = true;
    return finding;
  }

 private:
  void scan(std::int64_t first, std::span<const RecordedSample> samples) {
    if (first != next_) {
      low_ = same_ = 0;
    }
    next_ = first + static_cast<std::int64_t>(samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const std::int64_t index = first + static_cast<std::int64_t>(k);
      const double size = std::hypot(samples[k].in_phase, channels_ > 1 ? samples[k].quadrature : 0.0);
      const bool is_same = samples[k].in_phase == previous_.in_phase &&
                           (channels_ < 2 || samples[k].quadrature == previous_.quadrature);
      previous_ = samples[k];
      low_ = size < kQuiet * amplitude_ ? low_ + 1 : 0;
      same_ = is_same ? same_ + 1 : 1;
      note(index, low_, kQuietRun);
      note(index, same_, kSameRun);
    }
  }

  /// The run that ends with this sample is added as soon as the tone turns by so much in it.
  void note(std::int64_t index, std::int64_t run, double turn) {
    const double samples = std::max(kLeastRun, turn / std::max(frequency_, 1e-9));
    if (static_cast<double>(run) >= samples && index > last_bad_) {
      runs_.add(std::max(index - run, last_bad_) + 1, index);
      last_bad_ = index;
    }
  }

  static constexpr double kQuiet = 0.05;
  static constexpr double kQuietRun = 1.0;  // rad
  static constexpr double kSameRun = 7.0;   // rad: more than a period, of a square wave, too
  static constexpr double kLeastRun = 5.0;  // samples
  static constexpr double kKept = 0.9;
  static constexpr std::int64_t kSilence = 2048;  // samples
  int channels_;
  double amplitude_ = 0.0;
  double frequency_ = 0.0;
  std::vector<RecordedSample> before_;  ///< of the last stretch before the first tone
  std::int64_t waiting_ = 0;            ///< its first sample
  double last_loudness_ = 0.0;
  SampleRanges quiet_;  ///< all stretches before that one
  double loudest_before_ = 0.0;
  SampleRanges runs_;
  std::int64_t low_ = 0;   ///< samples of the run that goes on
  std::int64_t same_ = 0;  ///< likewise
  std::int64_t next_ = -1;
  std::int64_t last_bad_ = -1;
  RecordedSample previous_;
};

}  // namespace

std::unique_ptr<Detector> dropout_detector(int channels) {
  return std::make_unique<DropoutDetector>(channels);
}

}  // namespace veritrack::reports

#include "reports/recording/findings/recording_examiner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/recording/findings/detectors.hpp"
#include "reports/recording/tone_start.hpp"

namespace veritrack::reports {

namespace {

constexpr std::size_t kShortest = 64;

/// A tone of a hundred times the energy that noise has in a bin is not taken for another one. Noise alone has
/// a share of some 12 / length of its power at its largest frequency.
bool is_tone(const FoundTone& found) {
  constexpr double kLeastShare = 0.15;
  constexpr double kLeastEnergy = 100.0;
  return found.share > kLeastShare &&
         found.share * static_cast<double>(found.length) > kLeastEnergy * (1.0 - found.share);
}

}  // namespace

RecordingExaminer::RecordingExaminer(const certificates::SignalAssumptions& assume, int channels,
                                     std::optional<double> sample_rate)
    : assume_(assume),
      channels_(channels),
      sample_rate_(sample_rate),
      waveform_(assume.signal, channels),
      search_(waveform_, channels, assume.frequency),
      fit_(waveform_, channels, assume, sample_rate),
      detectors_(all_detectors(assume, channels)),
      longest_(start_length(assume.frequency[0])),
      wanted_(longest_) {}

void RecordingExaminer::push(std::int64_t index, const RecordedSample& sample) {
  if (!sample.is_present) {
    look(true);
    close_block();
    gaps_.add(index, index);
    return;
  }
  if (ahead_.empty()) {
    next_ = index;
  }
  ahead_.push_back(sample);
  if (ahead_.size() >= wanted_) {
    look(false);
  }
}

void RecordingExaminer::finish() {
  look(true);
  close_block();
}

void RecordingExaminer::look(bool at_end) {
  constexpr double kNearly = 0.9;
  constexpr double kLeastPeriods = 4.0 * kWholeTurn;  // rad: four periods
  while (ahead_.size() >= wanted_ || (at_end && ahead_.size() >= kShortest)) {
    const std::span<const RecordedSample> all(ahead_);
    const std::size_t length = last_found_.length;
    FoundTone found;
    if (length > 0 && length <= all.size() && is_tone(last_found_)) {
      found = search_.in(all.first(length), length < longest_ ? kLeastPeriods / static_cast<double>(length)
                                                              : assume_.frequency[0]);
    }
    if (!(found.share >= kNearly * last_found_.share)) {
      if (all.size() < longest_ && !at_end) {
        wanted_ = longest_;
        return;
      }
      found = search_.in_first(all.first(std::min(all.size(), longest_)), kShortest);
    }
    take(found);
  }
  if (at_end) {
    if (!ahead_.empty()) {
      FoundTone rest;
      rest.length = ahead_.size();
      take(rest);
    }
    last_found_ = {};
    wanted_ = longest_;
    follows_ = false;
  }
}

void RecordingExaminer::take(const FoundTone& found) {
  const std::span<const RecordedSample> samples = std::span<const RecordedSample>(ahead_).first(found.length);
  ToneStretch stretch;
  stretch.first = next_;
  stretch.length = static_cast<std::int64_t>(found.length);
  stretch.frequency = found.frequency;
  stretch.amplitude = found.amplitude;
  stretch.phase = found.phase;
  stretch.share = found.share;
  double squares = 0.0;
  for (const RecordedSample& each : samples) {
    squares += each.in_phase * each.in_phase + (channels_ > 1 ? each.quadrature * each.quadrature : 0.0);
  }
  stretch.root_mean_square = std::sqrt(squares / static_cast<double>(found.length));
  // At the end of a recording, or before a gap, a rest may be too short to know its frequency.
  constexpr double kPeriods = 3.5;
  const bool is_long_enough = assume_.frequency[0] <= 0.0 ||
                              found.frequency * static_cast<double>(found.length) >= kPeriods * kWholeTurn;
  stretch.has_tone = is_tone(found) && is_long_enough && found.amplitude > 0.0;
  stretch.follows = follows_ && stretch.has_tone;
  for (const std::unique_ptr<Detector>& each : detectors_) {
    each->see(stretch, samples);
  }
  if (stretch.has_tone) {
    frequency_.add(stretch.frequency);
    stretches_.push_back(stretch);
    block_.insert(block_.end(), samples.begin(), samples.end());
    if (block_.size() >= fit_.length()) {
      close_block();
    }
  } else {
    close_block();
  }
  follows_ = stretch.has_tone;
  last_found_ = found;
  wanted_ = std::max(found.length, kShortest);
  next_ += stretch.length;
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(found.length));
}

void RecordingExaminer::close_block() {
  if (!stretches_.empty()) {
    if (const std::optional<ExaminedBlock> block = fit_.fit(stretches_, block_)) {
      for (const std::unique_ptr<Detector>& each : detectors_) {
        if (!each->judge(*block)) {
          break;
        }
      }
    }
  }
  stretches_.clear();
  block_.clear();
}

std::vector<Finding> RecordingExaminer::findings(double scale) const {
  const FindingContext context{assume_, waveform_, RecordingUnits(sample_rate_), scale, channels_};
  std::vector<Finding> found;
  for (const std::unique_ptr<Detector>& each : detectors_) {
    if (std::optional<Finding> one = each->finding(context)) {
      found.push_back(std::move(*one));
    }
  }
  if (gaps_.count() > 0) {
    found.push_back(
        {"gaps", fmt::format("{} samples are missing.", gaps_.samples()), gaps_,
         "A certificate is for samples that all arrive: it counts again from a start behind each gap "
         "(`--from`, `--to`).",
         false, false, true});
  }
  return found;
}

}  // namespace veritrack::reports

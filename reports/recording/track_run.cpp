#include "reports/recording/track_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "reports/recording/chi_square.hpp"
#include "reports/recording/lock_indicator.hpp"
#include "reports/recording/sample_stream.hpp"
#include "reports/recording/tone_start.hpp"

namespace veritrack::reports {

namespace {

using certificates::TrackerOutput;

constexpr TrackerOutput kNoOutput{NAN, NAN, {NAN, NAN}, NAN};

/// The run, sample by sample.
class Run {
 public:
  Run(certificates::TrackerOnSamples& tracker, const TrackSettings& settings, bool is_derived)
      : tracker_(tracker.tracker.get()),
        assume_(tracker.assume),
        settings_(settings),
        waveform_(assume_.signal, tracker_->channels()),
        window_(lock_window(assume_.frequency[0], tracker_->channels() == 1 || !waveform_.is_tone())),
        lock_(window_, tracker_->channels(), waveform_),
        check_(assume_, window_, tracker_->channels(), is_derived) {
    const auto bridge = static_cast<std::int64_t>(window_);
    result_.channels = tracker_->channels();
    result_.has_innovation = tracker_->has_innovation();
    result_.quadrature_is_derived = is_derived;
    result_.window = window_;
    result_.scale = settings.scale.value_or(1.0);
    result_.no_lock = result_.nis.too_large = SampleRanges(bridge);
  }

  [[nodiscard]] TrackedSample next(SampleStream& stream) {
    if (!is_running_ && !is_stopped_ && stream.index() >= next_try_) {
      start(stream);
    }
    TrackedSample tracked;
    tracked.index = stream.index();
    tracked.sample = stream.take();
    tracked.sample.in_phase *= result_.scale;
    tracked.sample.quadrature *= result_.scale;
    tracked.output = kNoOutput;
    tracked.tone_share = NAN;
    if (result_.samples++ == 0) {
      result_.first = tracked.index;
    }
    if (!tracked.sample.is_present) {
      pass_gap(tracked);
    } else if (is_running_) {
      follow(tracked);
    }
    note(tracked);
    return tracked;
  }

  [[nodiscard]] TrackResult take() {
    result_.assumptions = check_.findings();
    result_.blocks.assign(tracker_->blocks().begin(), tracker_->blocks().end());
    return std::move(result_);
  }

 private:
  void start(SampleStream& stream) {
    const std::span<const RecordedSample> ahead = stream.present_ahead(start_length(assume_.frequency[0]));
    if (ahead.size() < kShortestStretch) {
      return;
    }
    certificates::ToneAtSample tone =
        find_tone(ahead, waveform_, result_.channels, assume_.frequency, settings_.start_frequency);
    if (result_.start_count == 0 && !settings_.scale && tone.amplitude > 0.0) {
      result_.scale = 0.5 * (assume_.amplitude[0] + assume_.amplitude[1]) / tone.amplitude;
    }
    tone.amplitude *= result_.scale;
    if (!(tone.amplitude > 0.0)) {
      next_try_ = stream.index() + static_cast<std::int64_t>(ahead.size());  // silence
      return;
    }
    if (++result_.start_count <= TrackResult::kStarts) {
      result_.starts.push_back({stream.index(), tone});
    }
    tracker_->start(tone);
    lock_.clear();
    check_.interrupt();
    is_running_ = true;
  }

  void pass_gap(TrackedSample& tracked) {
    is_stopped_ = false;
    check_.interrupt();
    const std::optional<TrackerOutput> output = is_running_ ? tracker_->predict() : std::nullopt;
    tracked.state = TrackState::gap;
    if (output) {
      tracked.output = *output;
      lock_.pass(output->frequency);
    } else {
      is_running_ = false;
    }
  }

  void follow(TrackedSample& tracked) {
    const std::array<double, 2> sample{tracked.sample.in_phase, tracked.sample.quadrature};
    tracked.output = tracker_->step(std::span(sample).first(static_cast<std::size_t>(result_.channels)));
    if (!std::isfinite(tracked.output.frequency)) {
      if (!result_.no_number) {
        result_.no_number = tracked.index;
      }
      tracked.output = kNoOutput;
      is_running_ = false;
      is_stopped_ = true;
      return;
    }
    lock_.push(tracked.sample, tracked.output.frequency);
    tracked.tone_share = lock_.share();
    tracked.state = std::isnan(tracked.tone_share)     ? TrackState::settling
                    : tracked.tone_share >= kLockShare ? TrackState::lock
                                                       : TrackState::no_lock;
  }

  void note(const TrackedSample& tracked) {
    const std::int64_t index = tracked.index;
    result_.series.add(tracked);
    const bool is_lost =
        tracked.state == TrackState::no_lock || (tracked.state == TrackState::untracked && result_.no_number);
    if (tracked.state == TrackState::gap) {
      result_.gaps.add(index, index);
      is_behind_gap_ = result_.first_lock.has_value();
    } else if (tracked.state == TrackState::untracked) {
      result_.untracked.add(index, index);
    } else if (tracked.state == TrackState::no_lock) {
      result_.no_lock.add(index, index);
    }
    if (is_lost && result_.first_lock && !result_.lost_lock) {
      result_.lost_lock = index;
    }
    if (is_lost || tracked.state == TrackState::lock) {
      result_.ends_in_lock = tracked.state == TrackState::lock;
    }
    if (tracked.state != TrackState::lock) {
      check_.interrupt();
      nis_in_stretch_ = {};
      return;
    }
    ++result_.in_lock;
    result_.has_gap_between = result_.has_gap_between || is_behind_gap_;
    if (!result_.first_lock) {
      result_.first_lock = index;
    }
    result_.frequency.add(tracked.output.frequency);
    check_.push(index, tracked.sample, tracked.output.frequency);
    note_nis(tracked);
  }

  void note_nis(const TrackedSample& tracked) {
    const double nis = tracked.output.nis;
    if (!std::isfinite(nis)) {
      return;
    }
    ++result_.nis.count;
    result_.nis.sum += nis;
    result_.nis.largest = std::max(result_.nis.largest, nis);
    nis_in_stretch_.add(nis);
    if (nis_in_stretch_.count == static_cast<std::int64_t>(window_)) {
      const double channels = result_.channels;
      const double freedom = channels * static_cast<double>(window_);
      if (nis_in_stretch_.mean() > channels * mean_square_quantile(freedom, kNormalFive)) {
        result_.nis.too_large.add(tracked.index - nis_in_stretch_.count + 1, tracked.index);
      }
      nis_in_stretch_ = {};
    }
  }

  certificates::TrackerRun* tracker_;
  certificates::SignalAssumptions assume_;
  TrackSettings settings_;
  Waveform waveform_;
  std::size_t window_;
  LockIndicator lock_;
  AssumptionCheck check_;
  std::int64_t next_try_ = 0;  ///< the sample from which a start is tried
  bool is_running_ = false;
  bool is_stopped_ = false;  ///< until the next gap
  bool is_behind_gap_ = false;
  Spread nis_in_stretch_;
  TrackResult result_;
};

}  // namespace

std::size_t lock_window(double lowest, bool by_periods) {
  constexpr double kLeastSamples = 64.0;
  constexpr double kMost = 65536.0;
  constexpr double kUnknown = 4096.0;
  const double periods = lowest > 0.0 ? std::ceil(4.0 * std::numbers::pi / lowest) : kUnknown;
  return static_cast<std::size_t>(by_periods ? std::clamp(periods, kLeastSamples, kMost) : kLeastSamples);
}

NisFindings::Verdict verdict_on(const NisFindings& nis, int channels) {
  constexpr std::int64_t kFew = 30;
  if (nis.count == 0) {
    return NisFindings::Verdict::none;
  }
  if (nis.count < kFew) {
    return NisFindings::Verdict::too_few;
  }
  const double count = static_cast<double>(nis.count);
  const double mean = nis.sum / count / channels;
  if (mean > mean_square_quantile(channels * count, kNormal975)) {
    return NisFindings::Verdict::over_confident;
  }
  return mean < mean_square_quantile(channels * count, -kNormal975) ? NisFindings::Verdict::cautious
                                                                    : NisFindings::Verdict::consistent;
}

TrackResult track_recording(SampleSource& source, certificates::TrackerOnSamples& tracker,
                            const TrackSettings& settings, const EachSample& each,
                            const std::function<void(std::int64_t)>& progress) {
  constexpr std::int64_t kProgress = 1 << 16;
  const rigor::NearestRounding nearest;
  SampleStream stream(source, settings.from, settings.to);
  Run run(tracker, settings, source.quadrature_is_derived());
  for (std::int64_t count = 1; stream.has_next(); ++count) {
    const TrackedSample sample = run.next(stream);
    if (each) {
      each(sample);
    }
    if (progress && count % kProgress == 0) {
      progress(count);
    }
  }
  return run.take();
}

}  // namespace veritrack::reports

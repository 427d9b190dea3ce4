// A design's tracker run over a recording, and the observations. Nothing here is proved.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/assumption_check.hpp"
#include "reports/recording/findings/finding.hpp"
#include "reports/recording/sample_ranges.hpp"
#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/track_series.hpp"

namespace veritrack::reports {

struct TrackSettings {
  std::int64_t from = 0;                                       ///< the first sample that is used
  std::int64_t to = std::numeric_limits<std::int64_t>::max();  ///< the first one that is not used any more
  /// The factor of the samples; none: the one with which the tone at the start has the assumed amplitude.
  std::optional<double> scale = 1.0;
  std::optional<double> start_frequency;  ///< rad/sample; none: from the recording
};

/// A start of the tracker.
struct TrackStart {
  std::int64_t sample = 0;
  certificates::ToneAtSample tone;  ///< in the units of the design
};

/// Normalised innovations squared, of samples in lock.
struct NisFindings {
  std::int64_t count = 0;
  double sum = 0.0;
  double largest = 0.0;
  SampleRanges too_large;  ///< stretches in which their mean is beyond its chi-squared band

  enum class Verdict { none, too_few, cautious, consistent, over_confident };
};

struct TrackResult {
  int channels = 1;
  bool has_innovation = false;
  bool quadrature_is_derived = false;  ///< by a Hilbert filter
  std::size_t window = 0;              ///< of the lock indicator, and the length of a stretch
  double scale = 1.0;
  std::int64_t first = 0;        ///< the first sample that was used
  std::int64_t samples = 0;      ///< from then on, missing ones included
  SampleRanges gaps;             ///< missing samples
  bool has_gap_between = false;  ///< one between samples in lock
  SampleRanges untracked;
  std::vector<TrackStart> starts;  ///< the first kStarts
  std::size_t start_count = 0;
  std::int64_t in_lock = 0;                ///< samples
  std::optional<std::int64_t> first_lock;  ///< sample
  std::optional<std::int64_t> lost_lock;   ///< the first sample out of lock after one in lock
  bool ends_in_lock = false;
  SampleRanges no_lock;
  std::optional<std::int64_t> no_number;  ///< the first sample after which the estimate was no finite number
  NisFindings nis;
  Spread frequency;  ///< estimates in lock, rad/sample
  AssumptionFindings assumptions;
  std::vector<Finding> recording;  ///< properties of the recording itself
  Spread recorded_frequency;       ///< of its tone, from stretch to stretch, rad/sample
  TrackSeries series;
  std::vector<certificates::TrackedBlock> blocks;  ///< of a tracker in blocks

  static constexpr std::size_t kStarts = 10;
};

/// The mean of the NIS against the band in which it is with 95 % when the filter's belief is right.
[[nodiscard]] NisFindings::Verdict verdict_on(const NisFindings& nis, int channels);

/// The share of the power below which the tracker is out of lock.
inline constexpr double kLockShare = 0.5;
/// Stretches without gaps that are shorter than this are not tracked.
inline constexpr std::size_t kShortestStretch = 32;

/// How many samples the lock indicator looks at: 64, and with one channel or a signal with harmonics at least
/// two periods of the lowest frequency (rad/sample) that is assumed, but 65536.
[[nodiscard]] std::size_t lock_window(double lowest, bool by_periods);

using EachSample = std::function<void(const TrackedSample&)>;

/// The source has as many channels as the tracker. Holds round-to-nearest. `each` sees every sample;
/// `progress` is called now and then with the number of samples. Throws certificates::InputError, and the
/// exceptions of the tracker.
[[nodiscard]] TrackResult track_recording(SampleSource& source, certificates::TrackerOnSamples& tracker,
                                          const TrackSettings& settings, const EachSample& each,
                                          const std::function<void(std::int64_t)>& progress);

}  // namespace veritrack::reports

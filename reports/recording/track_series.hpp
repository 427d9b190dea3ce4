// A run of any length in a constant number of rows: each represents one sample, or a stretch of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

/// The state of a sample, from best to worst.
enum class TrackState {
  lock,
  settling,  ///< just started: too early to tell
  no_lock,
  gap,       ///< missing; the tracker goes on by its prediction, where it has one
  untracked  ///< no tracker was running
};

/// "lock", "settling", "no-lock", "gap", "untracked".
[[nodiscard]] const char* name_of(TrackState state);

/// One sample of the run.
struct TrackedSample {
  std::int64_t index = 0;
  RecordedSample sample;  ///< in the units of the design
  certificates::TrackerOutput output{};
  double tone_share = 0.0;  ///< see LockIndicator; NaN where unknown
  TrackState state = TrackState::untracked;
};

/// The spread of one quantity over a stretch, where it is a number.
struct Spread {
  std::int64_t count = 0;
  double sum = 0.0;
  double least = 0.0;
  double largest = 0.0;

  void add(double value);
  void add(const Spread& other);
  /// NaN when there is none.
  [[nodiscard]] double mean() const;
};

struct TrackRow {
  std::int64_t first = 0;  ///< samples, both included
  std::int64_t last = 0;
  Spread frequency;           ///< rad/sample
  Spread deviation;           ///< rad/sample
  Spread innovation_squares;  ///< of all channels together, signal units squared
  Spread nis;
  Spread tone_share;
  TrackState worst = TrackState::lock;
};

/// When there are kMostRows rows, neighbours are joined, and a row represents twice as many samples.
class TrackSeries {
 public:
  void add(const TrackedSample& sample);
  [[nodiscard]] const std::vector<TrackRow>& rows() const { return rows_; }
  /// How many samples a row represents; the last one may have fewer.
  [[nodiscard]] std::int64_t samples_per_row() const { return per_row_; }

  static constexpr std::size_t kMostRows = 8192;

 private:
  std::vector<TrackRow> rows_;
  std::int64_t per_row_ = 1;
};

/// Rows joined until there are at most `most`.
[[nodiscard]] std::vector<TrackRow> joined(std::vector<TrackRow> rows, std::size_t most);

}  // namespace veritrack::reports

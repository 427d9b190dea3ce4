#include "reports/recording/track_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace veritrack::reports {

namespace {

void join(TrackRow& row, const TrackRow& next) {
  row.last = next.last;
  row.frequency.add(next.frequency);
  row.deviation.add(next.deviation);
  row.innovation_squares.add(next.innovation_squares);
  row.nis.add(next.nis);
  row.tone_share.add(next.tone_share);
  row.worst = std::max(row.worst, next.worst);
}

void join_pairs(std::vector<TrackRow>& rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    TrackRow row = rows[i];
    if (i + 1 < rows.size()) {
      join(row, rows[i + 1]);
    }
    rows[count++] = row;
  }
  rows.resize(count);
}

TrackRow row_of(const TrackedSample& sample) {
  TrackRow row;
  row.first = row.last = sample.index;
  row.frequency.add(sample.output.frequency);
  row.deviation.add(sample.output.frequency_deviation);
  const auto& [first, second] = sample.output.innovation;
  row.innovation_squares.add(first * first + (std::isnan(second) ? 0.0 : second * second));
  row.nis.add(sample.output.nis);
  row.tone_share.add(sample.tone_share);
  row.worst = sample.state;
  return row;
}

}  // namespace

const char* name_of(TrackState state) {
  constexpr std::array kNames{"lock", "settling", "no-lock", "gap", "untracked"};
  return kNames.at(static_cast<std::size_t>(state));
}

void Spread::add(double value) {
  if (!std::isfinite(value)) {
    return;
  }
  least = count == 0 ? value : std::min(least, value);
  largest = count == 0 ? value : std::max(largest, value);
  sum += value;
  ++count;
}

void Spread::add(const Spread& other) {
  if (other.count == 0) {
    return;
  }
  least = count == 0 ? other.least : std::min(least, other.least);
  largest = count == 0 ? other.largest : std::max(largest, other.largest);
  sum += other.sum;
  count += other.count;
}

double Spread::mean() const {
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

void TrackSeries::add(const TrackedSample& sample) {
  const TrackRow row = row_of(sample);
  if (!rows_.empty() && rows_.back().last - rows_.back().first + 1 < per_row_) {
    join(rows_.back(), row);
    return;
  }
  if (rows_.size() == kMostRows) {
    join_pairs(rows_);
    per_row_ *= 2;
  }
  rows_.push_back(row);
}

std::vector<TrackRow> joined(std::vector<TrackRow> rows, std::size_t most) {
  while (rows.size() > most) {
    join_pairs(rows);
  }
  return rows;
}

}  // namespace veritrack::reports

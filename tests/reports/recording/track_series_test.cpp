#include "reports/recording/track_series.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

TrackedSample sample_with(std::int64_t index, double frequency) {
  TrackedSample sample;
  sample.index = index;
  sample.output = {frequency, 0.1, {frequency, NAN}, NAN};
  sample.tone_share = 0.9;
  sample.state = TrackState::lock;
  return sample;
}

TEST_CASE("rows cover all samples once, whatever their number, and keep least and largest") {
  test::Random random;
  for (const std::int64_t count : {1, 8192, 8193, 100000}) {
    TrackSeries series;
    double largest = -1.0;
    double sum = 0.0;
    for (std::int64_t k = 0; k < count; ++k) {
      const double value = random.uniform();
      largest = std::max(largest, value);
      sum += value;
      series.add(sample_with(k + 5, value));
    }
    const auto& rows = series.rows();
    CHECK(rows.size() <= TrackSeries::kMostRows);
    CHECK(2 * rows.size() * static_cast<std::size_t>(series.samples_per_row()) >=
          static_cast<std::size_t>(count));
    std::int64_t next = 5;
    Spread all;
    for (const TrackRow& row : rows) {
      CHECK(row.first == next);
      next = row.last + 1;
      all.add(row.frequency);
      CHECK(row.nis.count == 0);
    }
    CHECK(next == count + 5);
    CHECK(all.count == count);
    CHECK(all.largest == largest);
    CHECK(all.sum == doctest::Approx(sum));
    const auto few = joined(rows, 100);
    CHECK(few.size() <= 100);
    CHECK(few.back().last == count + 4);
  }
}

TEST_CASE("the state of a row is the worst of its samples") {
  TrackSeries series;
  for (std::int64_t k = 0; k < 20000; ++k) {
    TrackedSample sample = sample_with(k, 0.5);
    sample.state = k == 12345 ? TrackState::no_lock : TrackState::lock;
    series.add(sample);
  }
  const auto& rows = series.rows();
  CHECK(std::count_if(rows.begin(), rows.end(), [](const TrackRow& row) {
          return row.worst == TrackState::no_lock && row.first <= 12345 && 12345 <= row.last;
        }) == 1);
  CHECK(std::string(name_of(TrackState::no_lock)) == "no-lock");
}

}  // namespace
}  // namespace veritrack::reports

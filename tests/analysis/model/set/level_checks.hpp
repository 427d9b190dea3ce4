// The levels of proved tubes, verified once more.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::test {

/// Every level of every tube again, by the verification alone.
inline void check_levels(const model::TrackerModel& tracker, const model::TubeSet& set) {
  REQUIRE_FALSE(set.tubes.empty());
  for (const model::ProvedTube& proved : set.tubes) {
    CAPTURE(proved.tube.frequency);
    const std::vector<double>& levels = proved.levels;
    REQUIRE(proved.shrinking.size() == std::max<std::size_t>(levels.size() - 1, 1));
    for (std::size_t j = 0; j < proved.shrinking.size(); ++j) {
      const double scale = j + 1 < levels.size() ? levels[j + 1] / levels[j] * (1.0 - 1e-12) : 1.0;
      CHECK(verify_level(tracker, proved.tube, {levels[j], set.noise, scale, proved.shrinking[j], set.slew},
                         proved.grid)
                .verdict == rigor::Verdict::proved);
      CHECK((j + 1 == levels.size() || levels[j + 1] < levels[j]));
    }
  }
}

}  // namespace veritrack::test

// Points of a LockSet to look at in a search.
#pragma once

#include <array>
#include <vector>

#include "analysis/quadrature/gaussian/lock_set.hpp"

namespace veritrack::quadrature {

/// (u1, u2, u3, s), u = T e.
using LevelPoint = std::array<double, 4>;

/// In the direction of unit length, (u, sqrt(gamma) s), at this level.
struct LockSample {
  LevelPoint direction;
  double level;
};

/// Unit vectors, evenly spread, with u3 and s not negative; always the same.
[[nodiscard]] std::vector<LevelPoint> sample_directions(int count);

[[nodiscard]] LevelPoint point_at(const LockSet& set, const LockSample& sample);

}  // namespace veritrack::quadrature

#include "checker/model/tube_borders.hpp"

#include <algorithm>
#include <cmath>

#include "checker/model/length_bound.hpp"
#include "checker/model/place_matrix.hpp"
#include "checker/model/tube_evidence.hpp"

namespace veritrack::checker {

namespace {

/// From one cell into another, over frequencies about `middle`, half_width to both sides.
struct Crossing {
  const PhaseTube* from;
  const PhaseTube* to;
  Ball middle, half_width;
};

/// The same phases and frequencies, as a part of a tube.
TubePart part_of_tube(const Crossing& crossing, const TubePart& part, const PhaseTube& tube) {
  const Ball width(tube.half_width);
  const Ball z = (crossing.middle + crossing.half_width * Ball(part.z) - Ball(tube.frequency)) / width;
  const Ball half_z = crossing.half_width * Ball(part.half_z) / width;
  TubePart result{part.turn, part.half_turn, z.near(), half_z.near(), 0.0};
  result.z_error = (abs(z - Ball(result.z)) + abs(half_z - Ball(result.half_z))).upper_double();
  return result;
}

/// Whether the covariance bounds of one tube, narrower by the margin, are between those of the other.
bool fits_covariance(const Crossing& crossing, const TubePart& part, double margin) {
  const TubeOver from(*crossing.from, part_of_tube(crossing, part, *crossing.from), 0);
  const TubeOver to(*crossing.to, part_of_tube(crossing, part, *crossing.to), 0);
  const std::size_t states = crossing.from->curve.size();
  const Ball left = one - Ball(margin);
  const auto is_below = [&](const std::vector<BallPolynomial>& low, const std::vector<BallPolynomial>& high) {
    // left low < high
    return certainly_definite(
        sum(symmetric_of(high, states), symmetric_of(low, states), BallPolynomial(-left)));
  };
  return certainly_positive(left) && certainly_less(left, one) &&
         is_below(from.covariance_high, to.covariance_high) &&
         is_below(to.covariance_low, from.covariance_low);
}

/// States of one tube in the coordinates of the other: U'^-1 (C - C' + radius U xi).
std::vector<BallPolynomial> in_other_coordinates(const Crossing& crossing, const TubePart& part,
                                                 double radius, const VectorMonomials& monomials) {
  const TubeOver from(*crossing.from, part_of_tube(crossing, part, *crossing.from), 0);
  const TubeOver to(*crossing.to, part_of_tube(crossing, part, *crossing.to), 0);
  if (!from.has_shape() || !to.has_shape()) {
    return {};
  }
  std::vector<BallPolynomial> difference = from.point(radius, components(monomials));
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference[i] -= to.curve[i];
  }
  return to.coordinates(difference);
}

}  // namespace

std::vector<Ball> common_levels(const TubeSet& set) {
  std::vector<Ball> levels;
  for (const PhaseTube& tube : set.tubes) {
    for (std::size_t j = 0; j < tube.levels.size(); ++j) {
      const Ball ratio = (Ball(tube.levels[j]) / Ball(tube.levels[0])).lower();
      if (j == levels.size()) {
        levels.push_back(ratio);
      } else {
        levels[j] = min(levels[j], ratio);
      }
    }
  }
  return levels;
}

void check_common_levels(const TubeSet& set, Objections& objections) {
  const std::vector<Ball> common = common_levels(set);
  const Ball little_more = one + Ball(0x1p-38);
  for (const PhaseTube& tube : set.tubes) {
    bool is_common = tube.levels.size() == common.size() && set.crossing.size() == pairs_of(tube);
    for (std::size_t j = 0; j < tube.levels.size() && is_common; ++j) {
      is_common = certainly_at_most(Ball(tube.levels[j]), common[j] * Ball(tube.levels[0]) * little_more);
    }
    if (!is_common) {
      objections.emplace_back(
          "cells of a frequency that moves have the same levels, and a number for each pair");
      return;
    }
  }
  const bool has_one_level = common.size() <= 1;
  for (const double rate : set.crossing) {
    if (!certainly_positive(Ball(rate)) ||
        !(has_one_level ? certainly_at_most(Ball(rate), one) : certainly_less(Ball(rate), one))) {
      objections.emplace_back("crossing a border does not shrink levels");
      return;
    }
  }
}

bool crosses_borders(const TubeSet& set, std::size_t states, std::int64_t& cells) {
  const Ball slew(set.slew);
  const std::vector<Ball> common = common_levels(set);
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i + 1 < set.tubes.size(); ++i) {
    const PhaseTube& below = set.tubes[i];
    const PhaseTube& above = set.tubes[i + 1];
    const bool reaches_only_above =
        i + 2 == set.tubes.size() || certainly_at_most(high_end(below) + slew, high_end(above));
    const bool reaches_only_below = i == 0 || certainly_at_most(low_end(below), low_end(above) - slew);
    if (!reaches_only_above || !reaches_only_below) {
      return false;
    }
    crossings.push_back({&below, &above, high_end(below) + half * slew, half * slew});
    crossings.push_back({&above, &below, low_end(above) - half * slew, half * slew});
  }
  if (crossings.empty()) {
    return true;
  }
  const VectorMonomials monomials(states);
  const std::size_t pairs = pairs_of(set.tubes.front());
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& questions) {
    const Crossing& crossing = crossings[number];
    PartAnswer answer;
    const bool has_bounds = !bounds_covariance(set) || fits_covariance(crossing, part, set.margin);
    double by_phase = 0.0;
    double by_frequency = 0.0;
    for (const std::size_t j : questions) {
      constexpr double kDown = 1.0 - 0x1p-48;
      constexpr double kUp = 1.0 + 0x1p-48;
      const PhaseTube& from = *crossing.from;
      const double radius = from.levels[j] * from.shrinking[j] * kUp;
      const LengthBound bound(in_other_coordinates(crossing, part, radius, monomials));
      const double factor = set.crossing[j] * (crossing.to->levels[0] / from.levels[0]) * kDown * kDown;
      bool certain = has_bounds && bound.is_at_most(factor * from.levels[j] * kDown, 1.0);
      if (certain && from.levels.size() > 1) {
        const double low = (common[j + 1] * Ball(from.levels[0])).lower_double();
        certain = bound.is_at_most(factor * low * kDown, low / from.levels[j] * kUp);
      }
      if (!certain) {
        answer.open.push_back(j);
        by_phase += bound.by_phase() / radius;
        by_frequency += bound.by_frequency() / radius;
      }
    }
    answer.halve_frequencies = by_frequency > by_phase;
    return answer;
  };
  std::vector<FirstGrid> grids(crossings.size());
  for (std::size_t k = 0; k < grids.size(); ++k) {
    grids[k] = {crossings[k].from->phases, 1, pairs};
  }
  return certain_everywhere(grids, ask, cells);
}

}  // namespace veritrack::checker

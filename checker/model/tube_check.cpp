#include "checker/model/tube_check.hpp"

#include <algorithm>
#include <cmath>

#include "checker/model/length_bound.hpp"
#include "checker/model/turn_count.hpp"

namespace veritrack::checker {

namespace {

std::size_t pairs_of(const Tube& tube) {
  return std::max<std::size_t>(tube.levels.size(), 2) - 1;
}

/// Between the levels number j and j + 1, with a bound on F for |xi| <= R_j.
bool shrinks(const LengthBound& step, const Tube& tube, std::size_t j) {
  constexpr double kDown = 1.0 - 0x1p-48;
  constexpr double kUp = 1.0 + 0x1p-48;
  const double rate = tube.shrinking[j] * kDown;
  const bool at_high_end = step.is_at_most(rate * tube.levels[j], 1.0);
  if (!at_high_end || tube.levels.size() == 1) {
    return at_high_end;
  }
  const double low_end = tube.levels[j + 1];
  return step.is_at_most(rate * low_end, low_end / tube.levels[j] * kUp);
}

}  // namespace

bool TubeCheck::is_never_left(Objections& objections) const {
  const ModelRecursion& recursion = *model_->recursion;
  if (const std::string objection = angle_objection(recursion); !objection.empty()) {
    objections.push_back(objection);
    return false;
  }
  for (const Tube& tube : set_->tubes) {
    for (std::size_t i = 0; i < recursion.states(); ++i) {
      if (tube.turns.at(i) != 0 && !recursion.is_angle()[i]) {
        objections.emplace_back("the curve turns in a state that is no angle");
        return false;
      }
    }
  }
  const bool is_noisy = !certainly_equal(Ball(set_->noise), zero);
  const VectorMonomials monomials(recursion.states(), is_noisy ? recursion.samples() : 0);
  const auto grid = [](const Tube& tube) { return FirstGrid{tube.phases, tube.frequencies}; };
  const auto ask = [&](const Tube& tube, const TubePart& part, const std::vector<std::size_t>& pairs) {
    PartAnswer answer;
    const TubeStep step(*model_, tube, part);
    if (!step.has_shape()) {
      answer.open = pairs;
      return answer;
    }
    double by_phase = 0.0;
    double by_frequency = 0.0;
    for (const std::size_t j : pairs) {
      const double radius = tube.levels[j];
      const LengthBound bound(step.map(monomials, radius, set_->noise));
      if (!shrinks(bound, tube, j)) {
        answer.open.push_back(j);
        by_phase += bound.by_phase() / radius;
        by_frequency += bound.by_frequency() / radius;
      }
    }
    answer.halve_frequencies = by_frequency > by_phase;
    return answer;
  };
  const bool certain = certain_everywhere(set_->tubes, grid, pairs_of, ask, *cells_);
  if (!certain) {
    objections.emplace_back("a step may leave the tube, or not shrink as much as is said");
  }
  return certain;
}

Ball samples_to_level(const Tube& tube, std::size_t level) {
  Ball sum;
  for (std::size_t j = 0; j < level; ++j) {
    const Ball from(tube.levels.at(j));
    const Ball to(tube.levels.at(j + 1));
    const Ball rate(tube.shrinking.at(j));
    const Ball samples = log(to / from) / log(rate);
    // A whole number that is enough, or the next one.
    const double near = std::round(samples.near());
    bool is_enough = near >= 0.0 && near < 1e15;
    if (is_enough) {
      Ball power;
      arb_pow_ui(power.raw(), rate.raw(), static_cast<ulong>(near), precision());
      is_enough = certainly_at_most(power * from, to);
    }
    sum += Ball(is_enough ? near : std::ceil(samples.upper_double()));
  }
  return sum.upper();
}

}  // namespace veritrack::checker

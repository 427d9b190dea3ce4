#include "checker/model/long_run.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "checker/model/filter_step.hpp"
#include "checker/model/length_bound.hpp"

namespace veritrack::checker {

namespace {

bool are_alike(const TubeSet& around, const TubeSet& inner) {
  bool alike = !inner.tubes.empty() && around.tubes.size() == inner.tubes.size() &&
               bounds_covariance(around) && bounds_covariance(inner) && !around.gaussian && !inner.gaussian &&
               certainly_equal(Ball(around.noise), Ball(inner.noise)) &&
               certainly_equal(Ball(around.slew), zero) && certainly_equal(Ball(inner.slew), zero);
  for (std::size_t i = 0; alike && i < inner.tubes.size(); ++i) {
    const PhaseTube& a = around.tubes[i];
    const PhaseTube& b = inner.tubes[i];
    alike = certainly_equal(Ball(a.frequency), Ball(b.frequency)) &&
            certainly_equal(Ball(a.half_width), Ball(b.half_width)) && a.turns == b.turns && b.entry;
  }
  return alike;
}

/// Whether factor b - a is positive definite, from lower triangles.
bool is_below(const std::vector<BallPolynomial>& a, const std::vector<BallPolynomial>& b, double factor,
              std::size_t states) {
  const PlaceMatrix wide = sum(place_matrix(states, states), symmetric_of(b, states), BallPolynomial(factor));
  return certainly_definite(sum(wide, symmetric_of(a, states), BallPolynomial(-1.0)));
}

}  // namespace

bool is_entered(const TrackedModel& model, const TubeSet& around, const TubeSet& inner, std::int64_t& cells,
                Objections& objections) {
  if (!are_alike(around, inner)) {
    objections.emplace_back("the set around it has other cells, or another noise");
    return false;
  }
  const std::size_t states = model.recursion->filtered();
  const VectorMonomials monomials(states);
  // The estimates of one tube, with the bounds of the other.
  std::vector<PhaseTube> mixed = around.tubes;
  std::vector<FirstGrid> grids;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    mixed[i].covariance_low = inner.tubes[i].covariance_low;
    mixed[i].covariance_high = inner.tubes[i].covariance_high;
    grids.push_back({inner.tubes[i].phases, inner.tubes[i].frequencies, 1});
  }
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& questions) {
    const PhaseTube& tube = inner.tubes[number];
    const LongRunEntry& entry = *tube.entry;
    const double radius = around.tubes[number].levels.back();
    const TubeOver from(around.tubes[number], part, 0);
    const TubeOver into(tube, part, 0);
    PartAnswer answer{questions, false};
    if (!from.has_shape() || !into.has_shape()) {
      return answer;
    }
    std::vector<BallPolynomial> difference = from.point(radius, components(monomials));
    for (std::size_t i = 0; i < difference.size(); ++i) {
      difference[i] -= into.curve[i];
    }
    const LengthBound length(into.coordinates(difference));
    answer.halve_frequencies = length.by_frequency() > length.by_phase();
    const bool certain = length.is_at_most(tube.levels.front() * (1.0 - 0x1p-48), 1.0) &&
                         is_below(from.covariance_high, into.covariance_high, entry.ratio, states) &&
                         is_below(into.covariance_low, from.covariance_low, entry.ratio, states) &&
                         FilterStep(model, mixed[number], part, monomials)
                             .keeps_covariance(radius, {entry.margin, entry.ratio});
    if (certain) {
      answer.open.clear();
    }
    return answer;
  };
  if (!certain_everywhere(grids, ask, cells)) {
    objections.emplace_back("the covariance, or the estimate, may not come into the bounds of the long run");
    return false;
  }
  return true;
}

Ball samples_to_long_run(const PhaseTube& inner) {
  const Ball samples = log(Ball(inner.entry->ratio)) / -log(one - Ball(inner.entry->margin));
  return Ball(std::ceil(samples.upper_double()));
}

}  // namespace veritrack::checker

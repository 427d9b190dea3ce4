#include "analysis/quadrature/leak/steady_verification.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/quadrature/leak/steady_contraction.hpp"
#include "analysis/quadrature/leak/steady_motion.hpp"
#include "analysis/quadrature/leak/steady_rate.hpp"
#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/quadrature/rounding/steady_rounding.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using Design = trackers::ToneModel<Interval>;

bool is_symmetric(const rigor::Matrix<3>& p) {
  return p(0, 1) == p(1, 0) && p(0, 2) == p(2, 0) && p(1, 2) == p(2, 1) && rigor::is_finite(p);
}

/// The first hypothesis on the proposal that does not hold, as a sentence; empty when all hold.
std::string objection(const Design& design, const SteadySet& set) {
  const auto& t = set.metric;
  if (!certainly_positive(design.r) || !certainly_not_negative(design.q1) ||
      !certainly_not_negative(design.q2) || !certainly_not_negative(design.epsilon) ||
      !certainly_less(design.epsilon, Interval(1.0))) {
    return "the design is not one with q1 >= 0, q2 >= 0, r > 0 and 0 <= epsilon < 1.";
  }
  if (!rigor::is_finite(t) || t(1, 0) != 0.0 || t(2, 0) != 0.0 || t(2, 1) != 0.0 ||
      !certainly_positive(Interval(t(0, 0))) || !certainly_positive(Interval(t(1, 1))) ||
      !certainly_positive(Interval(t(2, 2)))) {
    return "the metric does not have the form that the proof needs.";
  }
  if (!certainly_not_negative(Interval(set.noise)) || !certainly_not_negative(Interval(set.slew))) {
    return "noise or slew is not a valid bound.";
  }
  if (!is_symmetric(set.below) || !is_symmetric(set.above) ||
      !certainly_positive_definite(to_symmetric(set.below)) ||
      !certainly_positive_definite(to_symmetric(set.above))) {
    return "the covariance bounds are not certainly positive definite.";
  }
  double last = 1.0;
  for (std::size_t j = 0; j < set.levels.size(); ++j) {
    const double level = set.levels[j];
    const bool falls = level > 0.0 && (j == 0 ? level == 1.0 : level < last);
    if (!falls) {
      return "the levels do not decrease from 1.";
    }
    last = level;
  }
  return set.levels.empty() ? "there are no levels." : std::string();
}

TriangularMetric<Interval> metric_of(const SteadySet& set) {
  const auto& t = set.metric;
  return {Interval(t(0, 0)), Interval(t(0, 1)), Interval(t(0, 2)),
          Interval(t(1, 1)), Interval(t(1, 2)), Interval(t(2, 2))};
}

/// Are the directions of the metric known well enough to divide by?
bool sees_directions(const SteadyDirections<Interval>& d) {
  return certainly_positive(d.a11) && certainly_positive(d.a22) && rigor::is_finite(d.a21) &&
         rigor::is_finite(d.m1) && rigor::is_finite(d.m2) && rigor::is_finite(d.m3);
}

struct CellResult {
  std::size_t steps = 0;  ///< from level to level that are proved
  SteadyDivision division;
  std::string reason;  ///< why no more of them
  std::int64_t cells = 0;
};

/// X* = center + (p - p0) slope + tight.
SteadyState<SteadySecant> steady_secants(const sets::BranchCell& tube) {
  const rigor::IntervalVector<sets::QuadraturePolarLoop::kStates> box = tube.box();
  const rigor::IntervalVector<sets::QuadraturePolarLoop::kStates> middle =
      tube.at(Interval(tube.parameter_center));
  const auto entry = [&](Eigen::Index i, const Interval& shift) {
    return SteadySecant::affine(middle[i] + shift, box[i] + shift, Interval(tube.slope[i]), kFrequency);
  };
  const Interval none(0.0);
  return {entry(0, Interval(1.0)),
          entry(1, none),
          entry(2, none),
          {entry(3, none), entry(4, none), entry(5, none), entry(6, none), entry(7, none), entry(8, none)}};
}

/// Goes on to so many steps, from level to level, as far as they are proved.
void verify_cell(const Design& design, const sets::BranchCell& tube, const SteadySet& set,
                 const SteadyMotion& motion, std::size_t steps, CellResult& result) {
  const rigor::UpwardRounding upward;
  SteadySettings settings;
  SteadySetting<Interval>& setting = settings.over_cell;
  setting.design = design;
  setting.steady = steady_state(tube, tube.parameter);
  setting.metric = metric_of(set);
  setting.band = {to_symmetric(set.below), to_symmetric(set.above)};
  fill_turns(setting);
  const Symmetric<Interval> least = plus(setting.steady.covariance, setting.band.below, Interval(-1.0));
  // cannot bind (setting.steady.covariance): it is the sum of `least` and of the bound below.
  if (!certainly_positive_definite(least) || !certainly_positive_definite(setting.steady.covariance)) {
    result.reason = "the lower covariance bound is not certainly positive definite.";
    return;
  }
  setting.directions = directions_of(setting.metric);
  if (!sees_directions(setting.directions)) {
    result.reason = "the directions of the set could not be distinguished.";
    return;
  }
  settings.frequencies = tube.parameter - Interval(tube.parameter_center);
  settings.secants = convert<SteadySecant>(setting);
  settings.secants.steady = steady_secants(tube);
  fill_turns(settings.secants);
  const SteadyDisturbance disturbance{Interval(set.noise), motion.errors, motion.covariance};
  // A set that needs more is not proposed well: one that is a little smaller is proved in much less time.
  constexpr std::int64_t kMostCells = 120;
  constexpr std::int64_t kMostCellsOfOne = 1200;
  const std::int64_t most_cells = set.levels.size() == 1 ? kMostCellsOfOne : kMostCells;
  while (result.steps < steps) {
    const double level = set.levels[result.steps];
    const double next = set.levels.size() == 1 ? level : set.levels[result.steps + 1];
    const SteadyContraction contraction =
        prove_contraction(settings, level, next, disturbance, most_cells, result.division);
    result.cells += contraction.cells;
    if (!contraction.proved) {
      result.reason = contraction.reason;
      return;
    }
    ++result.steps;
  }
}

constexpr std::size_t kSpread = 6;

/// 0 to size - 1, beginning with the ends and some between.
std::vector<std::size_t> spread_first(std::size_t size) {
  std::vector<std::size_t> order;
  order.reserve(size);
  for (const std::size_t sixth : {0U, 6U, 5U, 3U, 1U, 4U}) {
    const std::size_t i = size * sixth / kSpread;
    order.push_back(std::min(i, size - 1));
  }
  for (std::size_t i = 0; i < size; ++i) {
    order.push_back(i);
  }
  std::vector<std::size_t> once;
  once.reserve(size);
  for (const std::size_t i : order) {
    if (std::find(once.begin(), once.end(), i) == once.end()) {
      once.push_back(i);
    }
  }
  return once;
}

}  // namespace

SteadyState<Interval> steady_state(const sets::BranchCell& cell, const Interval& part) {
  const rigor::IntervalVector<sets::QuadraturePolarLoop::kStates> x = cell.at(part);
  return {Interval(1.0) + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}};
}

SteadyVerification verify_steady_set(const Design& design, const std::vector<sets::BranchCell>& branch,
                                     const SteadySet& proposal, const TrackedSignal& signal) {
  const rigor::UpwardRounding upward;
  SteadyVerification result;
  result.set = proposal;
  result.reason = objection(design, proposal);
  if (!result.reason.empty()) {
    return result;
  }
  auto motion = steady_motion(design, branch, proposal);
  if (branch.empty() || !motion) {
    result.reason = "the change of the steady state with the frequency could not be enclosed.";
    return result;
  }
  const SteadyRounding rounding = steady_rounding(design, signal, branch, proposal);
  if (!rigor::is_finite(rounding.error) || !rigor::is_finite(rounding.covariance)) {
    result.reason = "the rounding of a step in double precision could not be bounded.";
    return result;
  }
  motion->errors += rounding.error;
  motion->covariance += rounding.covariance;
  // In blocks, so that a failure is found early, and the same one whatever the number of threads; cells
  // spread over the band come first.
  const std::vector<std::size_t> order = spread_first(branch.size());
  constexpr std::size_t kFirst = 2;
  constexpr std::size_t kBlock = 8;
  std::vector<CellResult> results(branch.size());
  std::size_t steps = 0;
  // The first level is the hardest: it is looked at everywhere before the others are.
  for (const std::size_t goal : {std::size_t{1}, std::max<std::size_t>(proposal.levels.size(), 2) - 1}) {
    if (goal == steps) {
      continue;
    }
    steps = goal;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < branch.size(); begin = end) {
      end = std::min(begin + (begin < kSpread ? kFirst : kBlock), branch.size());
      tbb::parallel_for(begin, end, [&](std::size_t i) {
        verify_cell(design, branch[order[i]], proposal, *motion, steps, results[i]);
      });
      for (std::size_t i = begin; i < end; ++i) {
        steps = std::min(steps, results[i].steps);
        if (steps == 0) {
          result.failed_frequency = branch[order[i]].parameter;
          result.reason = "for frequencies near " +
                          rigor::to_decimal(midpoint(result.failed_frequency), 4, rigor::Direction::down) +
                          " rad/sample: " + results[i].reason;
          return result;
        }
      }
    }
  }
  for (const CellResult& cell : results) {
    result.cells += cell.cells;
  }
  if (proposal.levels.size() > 1) {
    result.set.levels.resize(steps + 1);
  }
  result.verdict = Verdict::proved;
  result.reason = "every step maps the set into itself and contracts.";
  return result;
}

}  // namespace veritrack::quadrature

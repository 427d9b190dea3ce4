#include "checker/model/tube_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "checker/model/filter_step.hpp"
#include "checker/model/length_bound.hpp"
#include "checker/model/tube_borders.hpp"
#include "checker/model/turn_count.hpp"

namespace veritrack::checker {

namespace {

/// Between the levels number j and j + 1, with a bound on F for |xi| <= R_j. `low_end`: R_{j+1}, or a little
/// less. `bound_up_to` bounds F for |xi| up to another radius, where truncation is less.
bool shrinks(const LengthBound& step, const PhaseTube& tube, std::size_t j, double low_end,
             const std::function<LengthBound(double radius)>& bound_up_to) {
  constexpr double kDown = 1.0 - 0x1p-48;
  constexpr double kUp = 1.0 + 0x1p-48;
  const double rate = tube.shrinking[j] * kDown;
  const double radius = tube.levels[j];
  const auto shrinks_to = [&](const LengthBound& bound, double r, double of) {
    return bound.is_at_most(rate * r * kDown, r == of ? 1.0 : r / of * kUp);
  };
  const bool at_high_end = shrinks_to(step, radius, radius);
  if (!at_high_end || tube.levels.size() == 1 || shrinks_to(step, low_end, radius)) {
    return at_high_end;
  }
  if (!step.is_cut_off()) {
    return false;
  }
  // From low_end to `between`, and from there to R_j.
  const double between = std::sqrt(low_end * radius);
  const bool is_between = low_end < between && between < radius;
  if (!is_between || !shrinks_to(step, between, radius)) {
    return false;
  }
  const LengthBound nearer = bound_up_to(between);
  return shrinks_to(nearer, between, between) && shrinks_to(nearer, low_end, between);
}

/// The lowest of the radii between the levels number j and j + 1.
double low_end_of(const TubeSet& set, const PhaseTube& tube, std::size_t j, const std::vector<Ball>& common) {
  const bool moves = !certainly_equal(Ball(set.slew), zero);
  return tube.levels.size() == 1 ? tube.levels[j]
         : moves                 ? (common[j + 1] * Ball(tube.levels[0])).lower_double()
                                 : tube.levels[j + 1];
}

/// Whether truncation is the reason why a pair of levels is not certain: it must not be much more than the
/// amount by which a step lowers the lower level. Not evidence.
bool fails_by_error(const LengthBound& bound, double shrinking, double low_end) {
  constexpr double kShare = 0.25;
  return bound.error() > kShare * (1.0 - shrinking) * low_end;
}

/// The truncation of functions of the phases here and a sample later: the wider of both determines it.
/// Frequencies count more, because curve and shape also depend on them.
bool is_wider_in_frequency(const PhaseTube& tube, const TubePart& part) {
  constexpr double kMore = 3.0;
  constexpr double kTurn = 6.283;
  return kMore * part.half_z * tube.half_width > kTurn * part.half_turn;
}

/// Whether halving the frequencies of a part reduces truncation more than halving its phases does. Both are
/// tried once for all parts of the same widths, in the middle of a turn: whichever part asks first, the
/// answer is the same. A guess, as everything that chooses parts.
class TriedHalvings {
 public:
  /// `map_over` is the step for the pair of levels of the tube, both with their numbers.
  bool by_frequency(std::size_t number, std::size_t pair, const PhaseTube& tube, const TubePart& part,
                    const std::function<std::vector<BallPolynomial>(const TubePart&)>& map_over) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = tried_.try_emplace({number, pair, part.half_turn, part.half_z}, false);
    if (is_new) {
      const double of_narrower =
          cut_off(map_over({kMiddle, part.half_turn, 0.0, part.half_z / 2.0, part.z_error}));
      const double of_shorter =
          cut_off(map_over({kMiddle, part.half_turn / 2.0, 0.0, part.half_z, part.z_error}));
      place->second =
          of_narrower == of_shorter ? is_wider_in_frequency(tube, part) : of_narrower < of_shorter;
    }
    return place->second;
  }

 private:
  static constexpr double kMiddle = 0.5;
  static double cut_off(const std::vector<BallPolynomial>& map) {
    double sum = 0.0;
    for (const BallPolynomial& component : map) {
      sum += component.error() * component.error();
    }
    return sum;
  }

  std::mutex mutex_;
  std::map<std::tuple<std::size_t, std::size_t, double, double>, bool> tried_;
};

/// For a filter, with the largest radius: also whether the bounds of the covariance are kept.
PartAnswer ask_of_filter(const TubeSet& set, std::size_t number, const FilterStep& step,
                         const std::vector<Ball>& common, const std::vector<std::size_t>& pairs) {
  const PhaseTube& tube = set.tubes[number];
  PartAnswer answer;
  if (!step.has_shape()) {
    answer.open = pairs;
    return answer;
  }
  double by_phase = 0.0;
  double by_frequency = 0.0;
  bool lacks_bounds = false;  // the effect of the widths on these is unknown
  bool is_telling = true;
  for (const std::size_t j : pairs) {
    const double radius = tube.levels[j];
    const auto bound_up_to = [&](double r) { return LengthBound(step.map(r, set.noise)); };
    const LengthBound bound = bound_up_to(radius);
    const double low_end = low_end_of(set, tube, j, common);
    // In the long run, bounds of the covariance are kept for estimates in another tube (long_run.hpp).
    const bool has_bounds = tube.entry || j > 0 || step.keeps_covariance(radius, {set.margin, 1.0});
    if (!shrinks(bound, tube, j, low_end, bound_up_to) || !has_bounds) {
      answer.open.push_back(j);
      by_phase += bound.by_phase() / radius;
      by_frequency += bound.by_frequency() / radius;
      lacks_bounds = lacks_bounds || !has_bounds;
      is_telling = is_telling && bound.tells_extents(radius);
    }
  }
  if (!lacks_bounds && is_telling && std::isfinite(by_phase + by_frequency)) {
    answer.halve_frequencies = by_frequency > by_phase;
  }
  return answer;
}

/// The number of samples in which r falls from `from` to `to` when each multiplies it by `rate`.
Ball samples_between(const Ball& from, const Ball& to, const Ball& rate) {
  const Ball samples = log(to / from) / log(rate);
  // A whole number that is enough, or the next one.
  const double near = std::round(samples.near());
  bool is_enough = near >= 0.0 && near < 1e15;
  if (is_enough) {
    Ball power;
    arb_pow_ui(power.raw(), rate.raw(), static_cast<ulong>(near), precision());
    is_enough = certainly_at_most(power * from, to);
  }
  return Ball(is_enough ? near : std::ceil(samples.upper_double()));
}

}  // namespace

bool has_known_angles(const TrackedModel& model, const TubeSet& set, Objections& objections) {
  const ModelRecursion& recursion = *model.recursion;
  const std::size_t before = objections.size();
  if (const std::string objection = angle_objection(recursion); !objection.empty()) {
    objections.push_back(objection);
  }
  for (const PhaseTube& tube : set.tubes) {
    for (std::size_t i = 0; i < tube.turns.size(); ++i) {
      if (tube.turns.at(i) != 0 && (bounds_covariance(set) || !recursion.is_angle()[i])) {
        objections.emplace_back("the curve turns in a state that is no angle");
      }
    }
  }
  return objections.size() == before;
}

bool PhaseTubeCheck::is_never_left(Objections& objections) const {
  const ModelRecursion& recursion = *model_->recursion;
  const std::size_t before = objections.size();
  (void)has_known_angles(*model_, *set_, objections);
  if (set_->gaussian) {
    objections.emplace_back("in Gaussian noise every set is left some time");
  }
  const bool is_noisy = model_->is_disturbed(set_->noise);
  const bool moves = !certainly_equal(Ball(set_->slew), zero);
  if (moves) {
    check_common_levels(*set_, objections);
  }
  if (objections.size() > before) {
    return false;
  }
  const bool is_filter = bounds_covariance(*set_);
  if (is_filter && !bounds_suit(recursion)) {
    objections.emplace_back("bounds of a covariance are for filters with a linear measurement");
    return false;
  }
  const VectorMonomials monomials(is_filter ? recursion.filtered() : recursion.states(),
                                  is_noisy ? recursion.samples() : 0, moves ? 1 : 0);
  const std::vector<Ball> common = common_levels(*set_);
  TriedHalvings tried;
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& pairs) {
    const PhaseTube& tube = set_->tubes[number];
    PartAnswer answer;
    if (is_filter) {
      return ask_of_filter(*set_, number, FilterStep(*model_, tube, part, monomials, set_->slew), common,
                           pairs);
    }
    const TubeStep step(*model_, tube, part, monomials, set_->slew);
    if (!step.has_shape()) {
      answer.open = pairs;
      return answer;
    }
    double by_phase = 0.0;
    double by_frequency = 0.0;
    std::optional<std::size_t> by_error;
    for (const std::size_t j : pairs) {
      const double radius = tube.levels[j];
      const auto bound_up_to = [&](double r) { return LengthBound(step.map(r, set_->noise)); };
      const LengthBound bound = bound_up_to(radius);
      const double low_end = low_end_of(*set_, tube, j, common);
      if (!shrinks(bound, tube, j, low_end, bound_up_to)) {
        answer.open.push_back(j);
        by_error = fails_by_error(bound, tube.shrinking[j], low_end) ? j : by_error;
        by_phase += bound.by_phase() / radius;
        by_frequency += bound.by_frequency() / radius;
      }
    }
    const auto map_over = [&](const TubePart& over) {
      return TubeStep(*model_, tube, over, monomials, set_->slew).map(tube.levels[*by_error], set_->noise);
    };
    answer.halve_frequencies =
        by_error ? tried.by_frequency(number, *by_error, tube, part, map_over) : by_frequency > by_phase;
    return answer;
  };
  std::vector<FirstGrid> grids;
  grids.reserve(set_->tubes.size());
  for (const PhaseTube& tube : set_->tubes) {
    grids.push_back({tube.phases, tube.frequencies, pairs_of(tube)});
  }
  if (!certain_everywhere(grids, ask, *cells_)) {
    objections.emplace_back("a step may leave the tube, or not shrink as much as is said");
  } else if (moves && !crosses_borders(*set_, set_->tubes.front().curve.size(), *cells_)) {
    objections.emplace_back("a tube may be left where the frequency crosses the border of a cell");
  }
  return objections.size() == before;
}

Ball samples_to_level(const TubeSet& set, const PhaseTube& tube, std::size_t level) {
  const bool moves = !certainly_equal(Ball(set.slew), zero);
  const std::vector<Ball> common = common_levels(set);
  Ball sum;
  for (std::size_t j = 0; j < level; ++j) {
    if (!moves) {
      sum +=
          samples_between(Ball(tube.levels.at(j)), Ball(tube.levels.at(j + 1)), Ball(tube.shrinking.at(j)));
      continue;
    }
    Ball rate(set.crossing.at(j));
    for (const PhaseTube& each : set.tubes) {
      rate = max(rate, Ball(each.shrinking.at(j)));
    }
    sum += samples_between(common.at(j), common.at(j + 1), rate);
  }
  return sum.upper();
}

}  // namespace veritrack::checker

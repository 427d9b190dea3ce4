#include "analysis/quadrature/gaussian/drift_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quadrature/gaussian/drift_elimination.hpp"
#include "analysis/quadrature/gaussian/level_proposal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// 2 log(kappa + c_0/W) less what rounding may add, from below over the cell.
Interval core_over(const LockSet& set, const LevelCell& cell) {
  const Interval highest(levels_in(set, cell).upper());
  const Interval core =
      Interval(2.0) * rigor::log(Interval(set.decay) + Interval(set.drift) * rigor::exp(-highest));
  return Interval(core.lower()) - Interval(2.0 * kRoundingRoom);
}

}  // namespace

DriftInequality::DriftInequality(const trackers::ToneModel<Interval>& design, const LockSet& set)
    : set_(set), settings_(design, set) {}

CellDrift DriftInequality::check(const LevelCell& cell) const {
  const CellStep step(settings_.enclosed, cell);
  CellDrift found;
  found.influence = step.sizes(set_.weight);
  const std::optional<ImageLevel> level = find_image_level(settings_, step);
  if (!level) {
    return found;
  }
  const Interval core = core_over(set_, cell);
  const Interval& weight = settings_.enclosed.weight;
  // |u|^2 and s^2 are at least their tangents, and -t^2 is concave. So with one multiplier for both, what
  // holds at the two ends of s holds in between.
  const auto left = [&]<typename Scalar>(const std::array<Scalar, 3>& u, const Scalar& t,
                                         const Interval& away) {
    using rigor::square;
    const Interval level_squared = square(step.level_middle) + Interval(2.0) * step.level_middle * away;
    const Scalar next = t + Interval(kRoundingRoom);
    return Scalar(square(u[0]) + square(u[1]) + square(u[2]) - square(next) * weight +
                  (weight * level_squared + core));
  };
  CellLeft l;
  for (std::size_t end = 0; end < 2; ++end) {
    l.at[end] = left(step.middle, level->at[end], step.ends[end]);
    l.over[end] = left(step.tangent, level->over[end], step.ends[end]);
  }
  std::array<double, 3> influence{};
  found.holds = certainly_left_over(settings_, step, l, influence);
  prefer_widest(step, influence, found);
  return found;
}

double DriftInequality::margin_at(const std::array<double, 4>& x) const {
  const LockSetting<double>& rough = settings_.rough;
  const LevelStep<double> step = level_step(rough, std::array<double, 3>{x[0], x[1], x[2]}, x[3]);
  const LevelSlope level = propose_level(rough, step, {});
  LevelImages<double> images = images_at(step, 0.0, rough.design.r);
  if (!std::isfinite(level.level)) {
    return -1.0;
  }
  const double twice = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set_.weight * x[3] * x[3];
  const double left = twice - set_.weight * std::max(0.0, level.level) * level.level +
                      2.0 * std::log(set_.decay + set_.drift * std::exp(-0.5 * twice));
  double rest = std::numeric_limits<double>::infinity();
  // The error is affine in the frequency: one end of its range or the other is worst.
  const double middle = images.error[2];
  const double reach = rough.leak_reach;
  for (const double way : {reach, -reach}) {
    images.error[2] = middle + way;
    rest = std::min(rest, choose_multiplier(rough, images, left).left);
    if (reach == 0.0) {
      break;
    }
  }
  return std::isfinite(rest) ? rest / (1.0 + twice) : -1.0;
}

}  // namespace veritrack::quadrature

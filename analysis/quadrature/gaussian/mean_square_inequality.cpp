#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quadrature/gaussian/drift_elimination.hpp"
#include "analysis/quadrature/gaussian/level_proposal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

template <typename Scalar>
BlockMetric<Scalar> metric_of(const BlockMetric<double>& r) {
  return {Scalar(r.amplitude), Scalar(r.phase), Scalar(r.coupling), Scalar(r.frequency)};
}

/// The sum of the squares of the entries of R T^-1.
template <typename Scalar>
Scalar norm_squared(const BlockMetric<Scalar>& r, const BlockMetric<Scalar>& t) {
  using trackers::detail::square;
  const Scalar phase = r.phase / t.phase;
  const Scalar across = (r.coupling - phase * t.coupling) / t.frequency;
  return square(r.amplitude / t.amplitude) + square(phase) + square(r.frequency / t.frequency) +
         square(across);
}

/// At least (eta + eta^2) |R T^-1|^2: what rounding adds, docs/gaussian.md, section 14.
template <typename Scalar>
Scalar rounding_share(const BlockMetric<Scalar>& r, const BlockMetric<Scalar>& t) {
  return Scalar(2.0 * kRoundingRoom) * norm_squared(r, t);
}

/// |R (e - f)|^2 - h nu^2, nu = e_3 + e_03: convex, as the frequency's entry of R is at least sqrt(h).
/// `next` has R and f.
template <typename Constant, typename Scalar>
Scalar left_of_errors(const LockSetting<Constant>& next, const Constant& rate,
                      const std::array<Scalar, 3>& e) {
  using trackers::detail::square;
  const auto& f = next.offset;
  const std::array<Scalar, 3> y =
      image(next.metric, Scalar(e[0] - f[0]), Scalar(e[1] - f[1]), Scalar(e[2] - f[2]));
  return square(y[0]) + square(y[1]) + square(y[2]) - square(e[2] + next.bias[2]) * rate;
}

}  // namespace

Interval relative_norm_squared(const LockMeanSquare& mean_square, const LockSet& set) {
  return norm_squared(metric_of<Interval>(mean_square.metric), metric_of<Interval>(set.metric));
}

Interval offset_length(const LockMeanSquare& mean_square) {
  const auto& f = mean_square.offset;
  const std::array<Interval, 3> y =
      image(metric_of<Interval>(mean_square.metric), Interval(f[0]), Interval(f[1]), Interval(f[2]));
  return rigor::sqrt(rigor::square(y[0]) + rigor::square(y[1]) + rigor::square(y[2]));
}

MeanSquareInequality::MeanSquareInequality(const trackers::ToneModel<Interval>& design, const LockSet& set,
                                           const LockMeanSquare& mean_square)
    : set_(set), mean_square_(mean_square), settings_(design, set), next_(settings_) {
  next_.enclosed.metric = metric_of<Interval>(mean_square.metric);
  next_.rough.metric = mean_square.metric;
  for (std::size_t i = 0; i < 3; ++i) {
    next_.enclosed.offset[i] = Interval(mean_square.offset[i]);
    next_.rough.offset[i] = mean_square.offset[i];
  }
}

CellDrift MeanSquareInequality::check(const LevelCell& cell) const {
  const CellStep step(settings_.enclosed, cell);
  CellDrift found;
  found.influence = step.sizes(set_.weight);
  const std::optional<ImageLevel> level = find_image_level(settings_, step);
  if (!level) {
    return found;
  }
  const Interval weight(mean_square_.weight);
  const Interval rate(mean_square_.rate);
  // W is at least exp(x) (1 + level - x), whatever x.
  const Interval least(levels_in(set_, cell).lower());
  const Interval growth =
      Interval(mean_square_.share) * (Interval(1.0) - Interval(set_.decay)) * rigor::exp(least);
  const Interval constant =
      rate * Interval(mean_square_.bound) - Interval(mean_square_.share) * Interval(set_.drift) +
      growth * (Interval(1.0) - least) - rounding_share(next_.enclosed.metric, settings_.enclosed.metric);
  // As in the drift inequality, tangents are below what is convex.
  const auto left = [&]<typename Scalar>(const std::array<Scalar, 3>& u, const Scalar& t,
                                         const Interval& away) {
    using rigor::square;
    const Interval level_squared = square(step.level_middle) + Interval(2.0) * step.level_middle * away;
    const Scalar twice_level =
        square(u[0]) + square(u[1]) + square(u[2]) + Interval(set_.weight) * level_squared;
    const std::array<Scalar, 3> e = errors_of(settings_.enclosed.metric, u);
    const Scalar next = t + Interval(kRoundingRoom);
    return Scalar(left_of_errors(next_.enclosed, rate, e) + twice_level * (Interval(0.5) * growth) -
                  square(next) * weight + (weight * level_squared + constant));
  };
  CellLeft l;
  for (std::size_t end = 0; end < 2; ++end) {
    l.at[end] = left(step.middle, level->at[end], step.ends[end]);
    l.over[end] = left(step.tangent, level->over[end], step.ends[end]);
  }
  std::array<double, 3> influence{};
  found.holds = certainly_left_over(next_, step, l, influence);
  prefer_widest(step, influence, found);
  return found;
}

double MeanSquareInequality::needed_at(const std::array<double, 4>& x) const {
  constexpr double kTooMuch = 1e3;
  const LockSetting<double>& rough = settings_.rough;
  const std::array<double, 3> u{x[0], x[1], x[2]};
  const LevelStep<double> step = level_step(rough, u, x[3]);
  const double level = propose_level(rough, step, {}).level;
  const double twice = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set_.weight * x[3] * x[3];
  const double w = std::exp(0.5 * twice);
  const double left = left_of_errors(next_.rough, mean_square_.rate, errors_of(rough.metric, u)) +
                      mean_square_.weight * (x[3] * x[3] - std::max(0.0, level) * level) +
                      mean_square_.share * ((1.0 - set_.decay) * w - set_.drift) -
                      rounding_share(mean_square_.metric, rough.metric);
  LevelImages<double> images = images_at(step, 0.0, rough.design.r);
  double rest = std::numeric_limits<double>::infinity();
  // The error is affine in the frequency: one end of its range or the other is worst.
  const double middle = images.error[2];
  const double reach = rough.leak_reach;
  for (const double way : {reach, -reach}) {
    images.error[2] = middle + way;
    // Whatever is far above needs a multiplier as near to the others as what is just enough.
    rest = std::min(rest,
                    choose_multiplier(next_.rough, images, std::min(left, 0.0)).left + std::max(left, 0.0));
    if (reach == 0.0) {
      break;
    }
  }
  return std::isfinite(rest) ? -rest / mean_square_.rate : kTooMuch;
}

}  // namespace veritrack::quadrature

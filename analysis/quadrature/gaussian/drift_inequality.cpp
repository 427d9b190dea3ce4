#include "analysis/quadrature/gaussian/drift_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/quadrature/gaussian/drift_form.hpp"
#include "analysis/quadrature/gaussian/level_proposal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/mean_value_definiteness.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using Derivatives = rigor::Dual<Interval, 3>;
using Point = std::array<double, 3>;

/// Of the level of an image above its tangent: more is of no use in any cell.
constexpr double kMostRaise = 1.0;

double middle_of(const Interval& x) {
  return midpoint(x);
}

template <typename Scalar, typename Part>
LevelImage<double> rough(const LevelImage<Scalar>& image, const Part& part) {
  LevelImage<double> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result.covariance[i][j] = part(image.covariance[i][j]);
      result.slope[i][j] = part(image.slope[i][j]);
    }
    result.mean[i] = part(image.mean[i]);
  }
  return result;
}
template <typename Scalar, typename Part>
LevelStep<double> rough(const LevelStep<Scalar>& step, const Part& part) {
  return {rough(step.lower, part),
          rough(step.upper, part),
          {part(step.prediction_error[0]), part(step.prediction_error[1])}};
}

template <typename Scalar>
LockSetting<Scalar> setting_of(const trackers::ToneModel<Scalar>& design, const LockSet& set,
                               const Scalar& frequency) {
  const Scalar deviation(set.noise_deviation);
  const Scalar walk(set.frequency_walk);
  return {design,
          {Scalar(set.metric.amplitude), Scalar(set.metric.phase), Scalar(set.metric.coupling),
           Scalar(set.metric.frequency)},
          level_covariance<Scalar>(set.centre),
          inverse(level_covariance<Scalar>(set.centre)),
          level_covariance<Scalar>(set.spread_above),
          level_covariance<Scalar>(set.spread_below),
          Scalar(set.weight),
          deviation,
          deviation * deviation,
          walk * walk,
          frequency,
          {Scalar(set.bias[0]), Scalar(set.bias[1]), Scalar(set.bias[2])}};
}

/// An upper bound on the level anywhere in the cell, at most that of the set.
Interval highest_level(const LockSet& set, const LevelCell& cell) {
  Interval twice(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Interval most(std::max(std::fabs(cell.low[i]), std::fabs(cell.high[i])));
    twice += (i == 3 ? Interval(set.weight) : Interval(1.0)) * rigor::square(most);
  }
  return Interval(std::min((Interval(0.5) * twice).upper(), set.level));
}

/// What is left of l by elimination with the determinant of the other rows as that of the noise; and what the
/// choice of a multiplier is to make large. Where a pivot is too small, less and less, so that a search finds
/// its way out.
struct Elimination {
  double rest, quality;
};
Elimination eliminated(DriftForm<double> form) {
  constexpr double kLeastPivot = 1e-3;
  const auto logarithm = [](double x) {
    return x > kLeastPivot ? std::log(x) : std::log(kLeastPivot) + x / kLeastPivot - 1.0;
  };
  double log_determinant = 0.0;
  for (std::size_t k = 0; k < kLeft; ++k) {
    double& pivot = form[k][k];
    log_determinant += logarithm(pivot);
    pivot = std::max(kLeastPivot, pivot);
    for (std::size_t i = k + 1; i < form.size(); ++i) {
      const double factor = form[i][k] / pivot;
      for (std::size_t j = k + 1; j <= i; ++j) {
        form[i][j] -= factor * form[j][k];
      }
    }
  }
  const double rest = form[kLeft][kLeft] + log_determinant;
  return {rest, log_determinant + logarithm(rest)};
}

/// The multiplier away from all limits, as a cell needs it, and what it leaves.
struct Choice {
  double multiplier = 0.0, left = -std::numeric_limits<double>::infinity();
};
Choice choose_multiplier(const LockSetting<double>& setting, const LevelImages<double>& images, double left) {
  const SymmetricMatrix<double>& delta = images.half_spread;
  const SymmetricMatrix<double> spread = transformed(setting.metric, delta);
  const auto at = [&](double log_multiplier) {
    return eliminated(drift_form(setting, images, left, std::exp(log_multiplier)));
  };
  const double least = spread[0][0] + spread[1][1] + spread[2][2];
  const double most =
      setting.design.r * setting.design.r / (setting.noise_variance * (delta[0][0] + delta[1][1]));
  constexpr int kSteps = 12;
  const double low = std::log(std::max(least, 1e-12)) - 0.7;
  const double high = std::max(low + 1.0, std::min(std::log(most) + 0.7, low + 12.0));
  const search::GoldenPoint best =
      search::golden_section(low, high, kSteps, [&](double x) { return -at(x).quality; });
  return {std::exp(best.point), at(best.point).rest};
}

/// The rows but the last.
template <typename Scalar>
rigor::LowerTriangle<5, Scalar> without_last(const DriftForm<Scalar>& form) {
  rigor::LowerTriangle<5, Scalar> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(form[i].begin(), rows.size(), rows[i].begin());
  }
  return rows;
}

}  // namespace

DriftInequality::DriftInequality(const trackers::ToneModel<Interval>& design, const LockSet& set)
    : set_(set),
      setting_(setting_of(design, set, Interval::from_bounds(set.lowest_frequency, set.highest_frequency))),
      rough_(setting_of(trackers::ToneModel<double>{midpoint(design.q1), midpoint(design.q2),
                                                    midpoint(design.r), midpoint(design.epsilon)},
                        set, 0.5 * (set.lowest_frequency + set.highest_frequency))) {}

bool DriftInequality::outside(const LevelCell& cell) const {
  Interval twice(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const double least = cell.low[i] > 0.0 ? cell.low[i] : cell.high[i] < 0.0 ? cell.high[i] : 0.0;
    twice += (i == 3 ? Interval(set_.weight) : Interval(1.0)) * rigor::square(Interval(least));
  }
  return certainly_less(Interval(set_.level), Interval(0.5) * twice);
}

/// A cell, and the images of its points: in the middle and over it.
struct DriftInequality::CellStep {
  CellStep(const LockSetting<Interval>& setting, const LevelCell& cell)
      : level_middle(0.5 * (cell.low[3] + cell.high[3])),
        ends{Interval(cell.low[3]) - level_middle, Interval(cell.high[3]) - level_middle},
        level_width(std::max(ends[1].upper(), -ends[0].lower())) {
    for (std::size_t i = 0; i < 3; ++i) {
      middle[i] = Interval(0.5 * (cell.low[i] + cell.high[i]));
      std::array<Interval, 3> unit;
      unit.fill(Interval(0.0));
      unit[i] = Interval(1.0);
      range[i] = Derivatives(Interval::from_bounds(cell.low[i], cell.high[i]), unit);
      half_widths[i] =
          std::max((Interval(cell.high[i]) - middle[i]).upper(), (middle[i] - Interval(cell.low[i])).upper());
    }
    at = level_step(setting, middle, level_middle);
    over = level_step(setting, range, level_middle);
    roughly = rough(at, middle_of);
  }

  [[nodiscard]] std::array<double, 4> sizes(double weight) const {
    return {half_widths[0], half_widths[1], half_widths[2], std::sqrt(weight) * level_width};
  }

  std::array<Interval, 3> middle;
  std::array<Derivatives, 3> range;
  Point half_widths{};
  Interval level_middle;
  std::array<Interval, 2> ends;  ///< of the level, from its middle
  double level_width;
  LevelStep<Interval> at;
  LevelStep<Derivatives> over;
  LevelStep<double> roughly;
};

/// A level of the images, affine in u and in s: at the ends of s, in the middle of u and over the cell.
struct DriftInequality::ImageLevel {
  std::array<Interval, 2> at;
  std::array<Derivatives, 2> over;
};

bool DriftInequality::is_level(const CellStep& step, const ImageLevel& level) const {
  for (std::size_t end = 0; end < 2; ++end) {
    const Interval& t = level.at[end];
    const Derivatives& over = level.over[end];
    const Interval& away = step.ends[end];
    Point moved_by{};
    if (!certainly_not_negative(over.value()) ||
        !rigor::certainly_definite_over<3, 3>(
            difference(symmetric_of(upper_covariance(setting_, t)),
                       moved(step.at.upper.covariance, away, step.at.upper.slope)),
            difference(symmetric_of(upper_covariance(setting_, over)),
                       moved(step.over.upper.covariance, away, step.over.upper.slope)),
            step.half_widths, moved_by) ||
        !rigor::certainly_definite_over<3, 3>(
            difference(moved(step.at.lower.covariance, away, step.at.lower.slope),
                       symmetric_of(lower_covariance(setting_, t))),
            difference(moved(step.over.lower.covariance, away, step.over.lower.slope),
                       symmetric_of(lower_covariance(setting_, over))),
            step.half_widths, moved_by)) {
      return false;
    }
  }
  return true;
}

std::optional<DriftInequality::ImageLevel> DriftInequality::find_level(const CellStep& step) const {
  std::array<LevelStep<double>, 3> slopes;
  for (int i = 0; i < 3; ++i) {
    slopes[static_cast<std::size_t>(i)] =
        rough(step.over, [&](const Derivatives& entry) { return midpoint(entry.derivative(i)); });
  }
  LevelSlope proposed = propose_level(rough_, step.roughly, slopes);
  if (!std::isfinite(proposed.level)) {
    return std::nullopt;
  }
  // Not negative in the cell: for a negative level lo would not be a covariance.
  Interval reach(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    reach += Interval(proposed.along[i]) * rigor::symmetric(step.half_widths[i]);
  }
  const double by_level = std::fabs(proposed.with_level) * step.level_width;
  if (!(proposed.level + reach.lower() - by_level >= 0.0)) {
    proposed = {std::max(0.0, proposed.level + reach.upper() + by_level), {}, 0.0};
    reach = Interval(0.0);
  }
  const std::array<Interval, 3> slope{Interval(proposed.along[0]), Interval(proposed.along[1]),
                                      Interval(proposed.along[2])};
  const double widest =
      std::max(step.level_width, *std::max_element(step.half_widths.begin(), step.half_widths.end()));
  for (double raise = std::max(0.02 * widest * widest, 1e-9); raise < kMostRaise; raise *= 3.0) {
    ImageLevel level;
    for (std::size_t end = 0; end < 2; ++end) {
      level.at[end] = Interval(proposed.level + raise) + Interval(proposed.with_level) * step.ends[end];
      level.over[end] = Derivatives(level.at[end] + reach, slope);
    }
    if (is_level(step, level)) {
      return level;
    }
  }
  return std::nullopt;
}

Interval DriftInequality::constant_over(const LevelCell& cell) const {
  const Interval core =
      Interval(2.0) *
      rigor::log(Interval(1.0) + Interval(set_.drift) * rigor::exp(-highest_level(set_, cell)));
  return Interval(core.lower()) - Interval(2.0 * kRoundingRoom);
}

CellDrift DriftInequality::check(const LevelCell& cell) const {
  const CellStep step(setting_, cell);
  CellDrift found;
  found.influence = step.sizes(set_.weight);
  const std::optional<ImageLevel> image_level = find_level(step);
  if (!image_level) {
    return found;
  }
  const Interval constant = constant_over(cell);
  // s^2 is at least its tangent, and -t^2 is concave. So with one multiplier for both, what holds at the two
  // ends holds in between.
  const auto left = [&]<typename Scalar>(const std::array<Scalar, 3>& u, const Scalar& t,
                                         const Interval& away) {
    using rigor::square;
    const Interval level_squared = square(step.level_middle) + Interval(2.0) * step.level_middle * away;
    const Scalar next = t + Interval(kRoundingRoom);
    return Scalar(square(u[0]) + square(u[1]) + square(u[2]) - square(next) * setting_.weight +
                  (setting_.weight * level_squared + constant));
  };
  const Interval& r = setting_.design.r;
  const Interval in_the_middle = Interval(0.5) * (image_level->at[0] + image_level->at[1]);
  const Interval multiplier(choose_multiplier(rough_, images_at(step.roughly, 0.0, rough_.design.r),
                                              midpoint(left(step.middle, in_the_middle, Interval(0.0))))
                                .multiplier);
  // The rows but the last bound the determinant of the noise for all covariances: docs/gaussian.md.
  std::array<DriftForm<Interval>, 2> at;
  std::array<DriftForm<Derivatives>, 2> over;
  Interval determinant(1.0);
  for (std::size_t end = 0; end < 2; ++end) {
    const Interval& away = step.ends[end];
    at[end] = drift_form(setting_, images_at(step.at, away, r), left(step.middle, image_level->at[end], away),
                         multiplier);
    over[end] = drift_form(setting_, images_at(step.over, away, r),
                           left(step.range, image_level->over[end], away), multiplier);
    determinant = min(determinant, rigor::least_determinant_over<5, 3>(
                                       without_last(at[end]), without_last(over[end]), step.half_widths));
  }
  const Interval noise = -rigor::log(determinant);
  Point influence{};
  found.holds = certainly_positive(multiplier) && is_finite(noise);
  for (std::size_t end = 0; end < 2 && found.holds; ++end) {
    at[end][kLeft][kLeft] -= Interval(noise.upper());
    over[end][kLeft][kLeft] -= Interval(noise.upper());
    found.holds = rigor::certainly_definite_over<6, 3>(at[end], over[end], step.half_widths, influence);
  }
  // A matter of speed: the level is bisected when it is the widest side in the metric of the set.
  const double all = influence[0] + influence[1] + influence[2];
  const double widest = *std::max_element(step.half_widths.begin(), step.half_widths.end());
  if (found.influence[3] <= widest && std::isfinite(all) && all > 0.0) {
    found.influence = {influence[0], influence[1], influence[2], 0.0};
  }
  return found;
}

double DriftInequality::margin_at(const std::array<double, 4>& x) const {
  const LevelStep<double> step = level_step(rough_, std::array<double, 3>{x[0], x[1], x[2]}, x[3]);
  const LevelSlope level = propose_level(rough_, step, {});
  LevelImages<double> images = images_at(step, 0.0, rough_.design.r);
  if (!std::isfinite(level.level)) {
    return -1.0;
  }
  const double twice = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set_.weight * x[3] * x[3];
  const double left = twice - set_.weight * std::max(0.0, level.level) * level.level +
                      2.0 * std::log1p(set_.drift * std::exp(-0.5 * twice));
  double rest = std::numeric_limits<double>::infinity();
  // The error is affine in the frequency: one end of its range or the other is worst.
  const double middle = images.error[2];
  const double reach = 0.5 * rough_.design.epsilon * (set_.highest_frequency - set_.lowest_frequency);
  for (const double way : {reach, -reach}) {
    images.error[2] = middle + way;
    rest = std::min(rest, choose_multiplier(rough_, images, left).left);
    if (reach == 0.0) {
      break;
    }
  }
  return std::isfinite(rest) ? rest / (1.0 + twice) : -1.0;
}

}  // namespace veritrack::quadrature

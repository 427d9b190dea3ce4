#include "analysis/quadrature/gaussian/drift_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// What a step in double precision may change, and more (docs/gaussian.md).
constexpr double kStrictness = 1e-9;
/// Of the level of an image above its tangent: more is of no use in any cell.
constexpr double kMostRaise = 1.0;

double middle_of(const Interval& x) {
  return midpoint(x);
}

template <typename Scalar, typename Part>
CovarianceImage<double> rough(const CovarianceImage<Scalar>& image, const Part& part) {
  CovarianceImage<double> result{};
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
LockSetting<Scalar> setting_of(const trackers::ToneModel<Scalar>& design, const LockSet& set) {
  const auto block = [](const BlockCovariance<double>& p) {
    return BlockCovariance<Scalar>{Scalar(p.p11), Scalar(p.p22), Scalar(p.p23), Scalar(p.p33)};
  };
  const Scalar deviation(set.noise_deviation);
  const Scalar walk(set.frequency_walk);
  return {design,
          {Scalar(set.metric.amplitude), Scalar(set.metric.phase), Scalar(set.metric.coupling),
           Scalar(set.metric.frequency)},
          block(set.centre),
          inverse(block(set.centre)),
          block(set.spread_above),
          block(set.spread_below),
          Scalar(set.weight),
          deviation,
          deviation * deviation,
          walk * walk};
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

/// The multiplier that leaves most, with a form at a point.
struct Choice {
  double multiplier = 0.0, left = -std::numeric_limits<double>::infinity();
};
Choice choose_multiplier(const LockSetting<double>& setting, const LevelImages<double>& images, double left) {
  const Symmetric<double>& delta = images.half_spread;
  const Symmetric<double> spread = transformed(setting.metric, delta);
  const auto value = [&](double log_multiplier) {
    DriftForm<double> form = drift_form(setting, images, left, std::exp(log_multiplier));
    return rigor::eliminate(form, kLeft) ? -form[kLeft][kLeft] : std::numeric_limits<double>::infinity();
  };
  const double least = spread[0][0] + spread[1][1] + spread[2][2];
  const double most =
      setting.design.r * setting.design.r / (setting.noise_variance * (delta[0][0] + delta[1][1]));
  constexpr int kSteps = 12;
  const double low = std::log(std::max(least, 1e-12)) - 0.7;
  const double high = std::max(low + 1.0, std::min(std::log(most) + 0.7, low + 12.0));
  const search::GoldenPoint best = search::golden_section(low, high, kSteps, value);
  return {std::exp(best.point), -best.cost};
}

}  // namespace

DriftInequality::DriftInequality(const trackers::ToneModel<Interval>& design, const LockSet& set)
    : set_(set),
      setting_(setting_of(design, set)),
      rough_(setting_of(
          trackers::ToneModel<double>{midpoint(design.q1), midpoint(design.q2), midpoint(design.r), 0.0},
          set)) {
  const BlockMetric<Interval>& t = setting_.metric;
  // M_t = T'(I + w^2 t3 t3'/(1 - w^2 |t3|^2)) T, t3 = (0, coupling, frequency).
  const Interval length = rigor::square(t.coupling) + rigor::square(t.frequency);
  walk_determinant_ = Interval(1.0) - setting_.walk_variance * length;
  const Interval more = setting_.walk_variance / walk_determinant_;
  const std::array<Interval, 3> t3{Interval(0.0), t.phase * t.coupling, length};
  weight_ = Symmetric<Interval>{};
  const Interval none(0.0);
  weight_ = {{{rigor::square(t.amplitude), none, none},
              {none, rigor::square(t.phase), none},
              {none, t.phase * t.coupling, length}}};
  for (std::size_t i = 1; i < 3; ++i) {
    for (std::size_t j = 1; j <= i; ++j) {
      weight_[i][j] += more * t3[i] * t3[j];
    }
  }
}

bool DriftInequality::outside(const LevelCell& cell) const {
  Interval twice(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const double least = cell.low[i] > 0.0 ? cell.low[i] : cell.high[i] < 0.0 ? cell.high[i] : 0.0;
    twice += (i == 3 ? Interval(set_.weight) : Interval(1.0)) * rigor::square(Interval(least));
  }
  return certainly_less(Interval(set_.level), Interval(0.5) * twice);
}

Interval DriftInequality::log_determinant(const LevelImages<Interval>& images) const {
  const Interval over_r = Interval(1.0) / setting_.design.r;
  const Symmetric<Interval>& delta = images.half_spread;
  const auto at = [](const Symmetric<Interval>& x, std::size_t i, std::size_t j) -> const Interval& {
    return x[std::max(i, j)][std::min(i, j)];
  };
  // X = H'K'M_t/r, and tr K'M_t K, at the mean image.
  std::array<std::array<Interval, 3>, 3> x;
  Interval trace(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      x[k][i] = Interval(0.0);
      for (std::size_t j = 0; k < 2 && j < 3; ++j) {
        x[k][i] += at(weight_, i, j) * at(images.mean, j, k) * over_r;
      }
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      trace += x[k][j] * at(images.mean, j, k) * over_r;
    }
  }
  // |tr(sym(D'X D) Y)| <= sqrt(3) |sym(D'X D)|_F, D D' = Delta, |Y| <= 1, and |.|_F^2 = tr(X_s Delta X_s
  // Delta).
  std::array<std::array<Interval, 3>, 3> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = Interval(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        product[i][j] += Interval(0.5) * over_r * (x[i][k] + x[k][i]) * at(delta, k, j);
      }
    }
  }
  Interval square(0.0);
  Interval last(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      square += product[i][j] * product[j][i];
      last += at(weight_, i, j) * at(delta, i, j);
    }
  }
  const Interval linear = Interval(2.0) * rigor::sqrt(Interval(3.0) * max(square, Interval(0.0)));
  const Interval quadratic = last * (delta[0][0] + delta[1][1]) * rigor::square(over_r);
  const Interval most = setting_.noise_variance * (trace + linear + quadratic);
  return -(rigor::log(Interval(1.0) - most) + rigor::log(walk_determinant_));
}

CellDrift DriftInequality::check(const LevelCell& cell) const {
  CellDrift found;
  std::array<Derivatives, 3> range;
  std::array<Interval, 3> middle;
  Point half_widths{};
  for (std::size_t i = 0; i < 3; ++i) {
    middle[i] = Interval(0.5 * (cell.low[i] + cell.high[i]));
    std::array<Interval, 3> unit;
    unit.fill(Interval(0.0));
    unit[i] = Interval(1.0);
    range[i] = Derivatives(Interval::from_bounds(cell.low[i], cell.high[i]), unit);
    half_widths[i] =
        std::max((Interval(cell.high[i]) - middle[i]).upper(), (middle[i] - Interval(cell.low[i])).upper());
  }
  const Interval level_middle(0.5 * (cell.low[3] + cell.high[3]));
  const std::array<Interval, 2> ends{Interval(cell.low[3]) - level_middle,
                                     Interval(cell.high[3]) - level_middle};
  const double level_width = std::max(ends[1].upper(), -ends[0].lower());
  const double level_size = std::sqrt(set_.weight) * level_width;
  const std::array<double, 4> sizes{half_widths[0], half_widths[1], half_widths[2], level_size};
  found.influence = sizes;

  const LevelStep<Interval> at = level_step(setting_, middle, level_middle);
  const LevelStep<Derivatives> over = level_step(setting_, range, level_middle);
  const LevelStep<double> roughly = rough(at, middle_of);
  std::array<LevelStep<double>, 3> slopes;
  for (int i = 0; i < 3; ++i) {
    slopes[static_cast<std::size_t>(i)] =
        rough(over, [&](const Derivatives& entry) { return midpoint(entry.derivative(i)); });
  }
  LevelSlope proposed = propose_level(rough_, roughly, slopes);
  if (!std::isfinite(proposed.level)) {
    return found;
  }
  // The level of the image, an affine function in the cell, raised until it is one. It is not negative there:
  // for a negative level lo would not be a covariance.
  Interval reach(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    reach += Interval(proposed.along[i]) * rigor::symmetric(half_widths[i]);
  }
  const double by_level = std::fabs(proposed.with_level) * level_width;
  if (!(proposed.level + reach.lower() - by_level >= 0.0)) {
    proposed = {std::max(0.0, proposed.level + reach.upper() + by_level), {}, 0.0};
    reach = Interval(0.0);
  }
  const std::array<Interval, 3> slope{Interval(proposed.along[0]), Interval(proposed.along[1]),
                                      Interval(proposed.along[2])};
  double widest = level_width;
  for (const double width : half_widths) {
    widest = std::max(widest, width);
  }
  std::array<Interval, 2> image_level;
  const auto is_level = [&](double raise) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Interval t = Interval(proposed.level + raise) + Interval(proposed.with_level) * ends[end] +
                         Interval(kStrictness);
      const Derivatives affine(t + reach, slope);
      Point moved_by{};
      image_level[end] = t;
      if (!certainly_not_negative(affine.value()) ||
          !rigor::certainly_definite_over<3, 3>(
              difference(symmetric_of(upper_covariance(setting_, t)),
                         moved(at.upper.covariance, ends[end], at.upper.slope)),
              difference(symmetric_of(upper_covariance(setting_, affine)),
                         moved(over.upper.covariance, ends[end], over.upper.slope)),
              half_widths, moved_by) ||
          !rigor::certainly_definite_over<3, 3>(
              difference(moved(at.lower.covariance, ends[end], at.lower.slope),
                         symmetric_of(lower_covariance(setting_, t))),
              difference(moved(over.lower.covariance, ends[end], over.lower.slope),
                         symmetric_of(lower_covariance(setting_, affine))),
              half_widths, moved_by)) {
        return false;
      }
    }
    return true;
  };
  double raise = std::max(0.02 * widest * widest, 1e-9);
  while (!is_level(raise)) {
    raise *= 3.0;
    if (!(raise < kMostRaise)) {
      return found;
    }
  }

  LevelStep<Interval> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      values.lower.covariance[i][j] = over.lower.covariance[i][j].value();
      values.upper.covariance[i][j] = over.upper.covariance[i][j].value();
      values.lower.slope[i][j] = over.lower.slope[i][j].value();
      values.upper.slope[i][j] = over.upper.slope[i][j].value();
    }
    values.lower.mean[i] = values.upper.mean[i] = Interval(0.0);
  }
  values.prediction_error = {Interval(0.0), Interval(0.0)};
  const Interval determinant = log_determinant(images_at(values, hull(ends[0], ends[1]), setting_.design.r));
  const Interval core =
      Interval(2.0) *
      rigor::log(Interval(1.0) + Interval(set_.drift) * rigor::exp(-highest_level(set_, cell)));
  if (!is_finite(determinant) || !is_finite(core)) {
    return found;
  }
  // s^2 is at least its tangent, and -t^2 is concave: with both, what holds at the two ends holds between.
  const Interval constant(Interval(core.lower()) - Interval(determinant.upper()) -
                          Interval(2.0 * kStrictness));
  const auto left = [&]<typename Scalar>(const std::array<Scalar, 3>& u, const Scalar& t,
                                         const Interval& end) {
    using rigor::square;
    const Interval level_squared = square(level_middle) + Interval(2.0) * level_middle * end;
    return Scalar(square(u[0]) + square(u[1]) + square(u[2]) - square(t) * setting_.weight +
                  (setting_.weight * level_squared + constant));
  };
  found.influence.fill(0.0);
  for (std::size_t end = 0; end < 2; ++end) {
    const Interval& t = image_level[end];
    const LevelImages<Interval> images = images_at(at, ends[end], setting_.design.r);
    const Interval left_at = left(middle, t, ends[end]);
    const double multiplier =
        choose_multiplier(rough_, images_at(roughly, midpoint(ends[end]), rough_.design.r), midpoint(left_at))
            .multiplier;
    Point moved_by{};
    found.holds = certainly_positive(Interval(multiplier)) &&
                  rigor::certainly_definite_over<6, 3>(
                      drift_form(setting_, images, left_at, Interval(multiplier)),
                      drift_form(setting_, images_at(over, ends[end], setting_.design.r),
                                 left(range, Derivatives(t + reach, slope), ends[end]), Interval(multiplier)),
                      half_widths, moved_by);
    for (std::size_t i = 0; i < 3; ++i) {
      found.influence[i] = std::max(found.influence[i], moved_by[i]);
    }
    if (!found.holds) {
      break;
    }
  }
  // A matter of speed: the level when it is the widest side in the metric of the set.
  const double influence = found.influence[0] + found.influence[1] + found.influence[2];
  const bool known = std::isfinite(influence) && influence > 0.0;
  found.influence[3] =
      level_size > *std::max_element(half_widths.begin(), half_widths.end()) ? HUGE_VAL : 0.0;
  if (!known) {
    found.influence = sizes;
  }
  return found;
}

double DriftInequality::margin_at(const std::array<double, 4>& x) const {
  const LevelStep<double> step = level_step(rough_, std::array<double, 3>{x[0], x[1], x[2]}, x[3]);
  const LevelSlope level = propose_level(rough_, step, {});
  const LevelImages<double> images = images_at(step, 0.0, rough_.design.r);
  LevelImages<Interval> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      values.mean[i][j] = Interval(images.mean[i][j]);
      values.half_spread[i][j] = Interval(images.half_spread[i][j]);
    }
  }
  const Interval determinant = log_determinant(values);
  if (!is_finite(determinant) || !std::isfinite(level.level)) {
    return -1.0;
  }
  const double twice = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set_.weight * x[3] * x[3];
  const double left = twice - set_.weight * std::max(0.0, level.level) * level.level - determinant.upper() +
                      2.0 * std::log1p(set_.drift * std::exp(-0.5 * twice));
  const double rest = choose_multiplier(rough_, images, left).left;
  return std::isfinite(rest) ? rest / (1.0 + twice) : -1.0;
}

}  // namespace veritrack::quadrature

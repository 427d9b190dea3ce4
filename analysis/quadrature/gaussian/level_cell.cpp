#include "analysis/quadrature/gaussian/level_cell.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quadrature/gaussian/level_proposal.hpp"
#include "analysis/rigor/mean_value_definiteness.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// The most by which the level of an image is raised above its tangent: more is of no use in any cell.
constexpr double kMostRaise = 1.0;

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
LockSetting<Scalar> setting_of(const trackers::ToneModel<Scalar>& design, const LockSet& set) {
  const Scalar deviation(set.noise_deviation);
  const Scalar walk(set.frequency_walk);
  const double frequency = 0.5 * (set.lowest_frequency + set.highest_frequency);
  using std::max;
  const Scalar half_band = max(Scalar(set.highest_frequency) - Scalar(frequency),
                               Scalar(frequency) - Scalar(set.lowest_frequency));
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
          Scalar(frequency),
          design.epsilon * half_band,
          {Scalar(set.bias[0]), Scalar(set.bias[1]), Scalar(set.bias[2])}};
}

double middle_of(const Interval& x) {
  return midpoint(x);
}

/// True only when the level is one of the images everywhere in the cell.
bool is_level(const LockSetting<Interval>& setting, const CellStep& step, const ImageLevel& level) {
  for (std::size_t end = 0; end < 2; ++end) {
    const Interval& t = level.at[end];
    const CellDerivatives& over = level.over[end];
    const Interval& away = step.ends[end];
    std::array<double, 3> moved_by{};
    if (!certainly_not_negative(over.value()) ||
        !rigor::certainly_definite_over<3, 3>(
            difference(symmetric_of(upper_covariance(setting, t)),
                       moved(step.at.upper.covariance, away, step.at.upper.slope)),
            difference(symmetric_of(upper_covariance(setting, over)),
                       moved(step.over.upper.covariance, away, step.over.upper.slope)),
            step.half_widths, moved_by) ||
        !rigor::certainly_definite_over<3, 3>(
            difference(moved(step.at.lower.covariance, away, step.at.lower.slope),
                       symmetric_of(lower_covariance(setting, t))),
            difference(moved(step.over.lower.covariance, away, step.over.lower.slope),
                       symmetric_of(lower_covariance(setting, over))),
            step.half_widths, moved_by)) {
      return false;
    }
  }
  return true;
}

}  // namespace

LockSettings::LockSettings(const trackers::ToneModel<Interval>& design, const LockSet& set)
    : enclosed(setting_of(design, set)),
      rough(setting_of(trackers::ToneModel<double>{midpoint(design.q1), midpoint(design.q2),
                                                   midpoint(design.r), midpoint(design.epsilon)},
                       set)) {}

CellStep::CellStep(const LockSetting<Interval>& setting, const LevelCell& cell)
    : level_middle(0.5 * (cell.low[3] + cell.high[3])),
      ends{Interval(cell.low[3]) - level_middle, Interval(cell.high[3]) - level_middle},
      level_width(std::max(ends[1].upper(), -ends[0].lower())) {
  for (std::size_t i = 0; i < 3; ++i) {
    middle[i] = Interval(0.5 * (cell.low[i] + cell.high[i]));
    std::array<Interval, 3> unit;
    unit.fill(Interval(0.0));
    unit[i] = Interval(1.0);
    range[i] = CellDerivatives(Interval::from_bounds(cell.low[i], cell.high[i]), unit);
    tangent[i] = CellDerivatives(middle[i], unit);
    half_widths[i] =
        std::max((Interval(cell.high[i]) - middle[i]).upper(), (middle[i] - Interval(cell.low[i])).upper());
  }
  at = level_step(setting, middle, level_middle);
  over = level_step(setting, range, level_middle);
  roughly = rough(at, middle_of);
}

std::array<double, 4> CellStep::sizes(double weight) const {
  return {half_widths[0], half_widths[1], half_widths[2], std::sqrt(weight) * level_width};
}

std::optional<ImageLevel> find_image_level(const LockSettings& settings, const CellStep& step) {
  std::array<LevelStep<double>, 3> slopes;
  for (int i = 0; i < 3; ++i) {
    slopes[static_cast<std::size_t>(i)] =
        rough(step.over, [&](const CellDerivatives& entry) { return midpoint(entry.derivative(i)); });
  }
  LevelSlope proposed = propose_level(settings.rough, step.roughly, slopes);
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
      level.over[end] = CellDerivatives(level.at[end] + reach, slope);
    }
    if (is_level(settings.enclosed, step, level)) {
      return level;
    }
  }
  return std::nullopt;
}

void prefer_widest(const CellStep& step, const std::array<double, 3>& influence, CellDrift& found) {
  const double all = influence[0] + influence[1] + influence[2];
  const double widest = *std::max_element(step.half_widths.begin(), step.half_widths.end());
  if (found.influence[3] <= widest && std::isfinite(all) && all > 0.0) {
    found.influence = {influence[0], influence[1], influence[2], 0.0};
  }
}

bool is_outside(const LockSet& set, const LevelCell& cell) {
  return certainly_less(Interval(set.level), Interval(levels_in(set, cell).lower()));
}

Interval levels_in(const LockSet& set, const LevelCell& cell) {
  Interval least(0.0);
  Interval most(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Interval share = i == 3 ? Interval(set.weight) : Interval(1.0);
    const double nearest = cell.low[i] > 0.0 ? cell.low[i] : cell.high[i] < 0.0 ? cell.high[i] : 0.0;
    least += share * rigor::square(Interval(nearest));
    most += share * rigor::square(Interval(std::max(std::fabs(cell.low[i]), std::fabs(cell.high[i]))));
  }
  const double low = (Interval(0.5) * least).lower();
  return Interval::from_bounds(low, std::max(low, std::min((Interval(0.5) * most).upper(), set.level)));
}

}  // namespace veritrack::quadrature

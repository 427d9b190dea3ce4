#include "analysis/model/moving_frequency/border.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/model/filter/filter_models.hpp"
#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

/// The ends of two cells of frequencies.
struct Ends {
  Interval lower_begins, lower_ends, upper_begins, upper_ends;
};

Ends ends_of(const Tube& from, const Tube& to) {
  const Tube& lower = from.frequency < to.frequency ? from : to;
  const Tube& upper = from.frequency < to.frequency ? to : from;
  return {Interval(lower.frequency) - Interval(lower.half_width),
          Interval(lower.frequency) + Interval(lower.half_width),
          Interval(upper.frequency) - Interval(upper.half_width),
          Interval(upper.frequency) + Interval(upper.half_width)};
}

/// Frequencies middle - half to middle + half contain all those within W of the border.
struct Strip {
  double middle = 0.0;
  double half = 0.0;
};

Strip strip_of(const Tube& from, const Tube& to, double slew) {
  const Ends ends = ends_of(from, to);
  const Interval border = hull(ends.lower_ends, ends.upper_begins);
  const Interval strip = hull(border - Interval(slew), border + Interval(slew));
  const double middle = midpoint(strip);
  return {middle, abs(strip - Interval(middle)).upper()};
}

/// z of a tube, where the frequency is middle + half place.
BallModel z_in(const Tube& tube, const Strip& strip, const BallModel& place) {
  const Interval width(tube.half_width);
  return BallModel((Interval(strip.middle) - Interval(tube.frequency)) / width) +
         BallModel(Interval(strip.half) / width) * place;
}

/// Whether all bounds are at most the scale of the radius; then `largest` is the largest bound/(scale R_b). A
/// comparison with NaN is false.
bool fits(const StepBounds& bounds, const std::vector<double>& scales, double radius, Interval& largest) {
  if (bounds.steps.size() != scales.size() || scales.empty()) {
    return false;
  }
  double most = 0.0;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const Interval relative = Interval(bounds.steps[i]) / (Interval(scales[i]) * Interval(radius));
    if (!rigor::certainly_less_equal(relative, Interval(1.0))) {
      return false;
    }
    most = std::max(most, relative.upper());
  }
  largest = Interval(most);
  return true;
}

/// Whether the bounds of the covariance in the one tube, narrower by the margin, are between those of the
/// other.
bool fits_covariance(const Tube& from, const Tube& to, const TubeCell& cell, double slew, double margin) {
  const rigor::BallModelScope plane(0, 0);
  const CellPlace place = place_of(cell);
  const Strip strip = strip_of(from, to, slew);
  const TubeHere here = tube_at(from, place.phase, z_in(from, strip, place.z));
  const TubeHere there = tube_at(to, place.phase, z_in(to, strip, place.z));
  const Interval left = Interval(1.0) - Interval(margin);
  return is_positive_definite(symmetric(there.covariance_high) -
                              scaled(symmetric(here.covariance_high), BallModel(left))) &&
         is_positive_definite(scaled(symmetric(here.covariance_low), BallModel(Interval(1.0) / left)) -
                              symmetric(there.covariance_low));
}

std::string objection_to(const Tube& from, const Tube& to, const BorderQuestion& question,
                         const VerificationBudget& budget) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(question.from_radius) || !is_positive(question.to_radius) || !is_positive(question.slew) ||
      !(question.least_scale > 0.0 && question.least_scale <= 1.0) || !is_grid(budget) ||
      (question.covariance_margin &&
       !(*question.covariance_margin > 0.0 && *question.covariance_margin < 1.0))) {
    return "no radius, slew or budget that could be verified";
  }
  if (from.turns != to.turns) {
    return "neighbouring curves do not turn alike";
  }
  const Ends ends = ends_of(from, to);
  if (!rigor::certainly_less_equal(ends.lower_ends + Interval(question.slew), ends.upper_ends) ||
      !rigor::certainly_less_equal(ends.lower_begins + Interval(question.slew), ends.upper_begins)) {
    return "the slew is more than a cell of frequencies";
  }
  return "";
}

}  // namespace

StepBounds bound_border(const TrackerModel& model, const Tube& from, const Tube& to, const TubeCell& cell,
                        const BorderQuestion& question, const std::vector<double>& scales) {
  require_sizes(model, from);
  require_sizes(model, to);
  const std::size_t states = from.curve.size();
  const rigor::BallModelScope scope(static_cast<int>(states), 0);
  const CellPlace place = place_of(cell);
  const Strip strip = strip_of(from, to, question.slew);
  const BallModel z_to = z_in(to, strip, place.z);
  const TubeHere there = tube_at(to, place.phase, z_to);
  const TubeHere difference = tube_difference(from, z_in(from, strip, place.z), to, z_to, place.phase);
  std::vector<BallModel> deviation = in_units_of(there, state_in(difference, question.from_radius));
  const BallModel radius(question.from_radius);
  for (std::size_t i = 0; i < states; ++i) {
    deviation[i] = deviation[i] + radius * BallModel::ball(static_cast<int>(i));
  }
  StepBounds bounds;
  bounds.steps = length_bounds(deviation, scales);
  const WidthShares shares = width_shares(deviation);
  bounds.by_phase = shares.by_phase;
  bounds.by_frequency = shares.by_frequency;
  return bounds;
}

BorderResult verify_border(const TrackerModel& model, const Tube& from, const Tube& to,
                           const BorderQuestion& question, const VerificationBudget& budget) {
  const rigor::UpwardRounding upward;
  BorderResult result;
  require_sizes(model, from);
  require_sizes(model, to);
  result.reason = objection_to(from, to, question, budget);
  if (!result.reason.empty()) {
    return result;
  }
  std::vector<double> scales{1.0};
  if (question.least_scale < 1.0) {
    scales.push_back(question.least_scale);
  }
  const auto ask = [&](const TubeCell& cell) {
    CellAnswer answer;
    const StepBounds bounds = bound_border(model, from, to, cell, question, scales);
    answer.is_proved = fits(bounds, scales, question.to_radius, answer.range) &&
                       (!question.covariance_margin ||
                        fits_covariance(from, to, cell, question.slew, *question.covariance_margin));
    answer.by_phase = bounds.by_phase;
    answer.by_frequency = bounds.by_frequency;
    return answer;
  };
  const CoverResult cover = cover_cells(ask, budget);
  if (!cover.is_proved) {
    const Strip strip = strip_of(from, to, question.slew);
    result.worst_cell = cover.failed;
    result.reason = fmt::format(
        "at phases about {:.4g} of a turn and frequencies about {:.4g} rad/sample the tube does not fit into "
        "its neighbour",
        cover.failed.turn, strip.middle + strip.half * cover.failed.z);
    return result;
  }
  result.cells = cover.cells;
  result.largest = cover.range.upper();
  result.verdict = rigor::Verdict::proved;
  return result;
}

}  // namespace veritrack::model

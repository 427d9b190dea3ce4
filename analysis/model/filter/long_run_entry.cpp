#include "analysis/model/filter/long_run_entry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analysis/model/filter/filter_models.hpp"
#include "analysis/model/filter/filter_step.hpp"
#include "analysis/model/filter/orbit_points.hpp"
#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

/// Whether ratio b - a is positive definite in a cell, as matrices at its place; lower triangles.
bool is_below(const std::vector<BallModel>& a, const std::vector<BallModel>& b, double ratio) {
  return is_positive_definite(scaled(symmetric(b), BallModel(ratio)) - symmetric(a));
}

/// The largest eigenvalue of a in units of b; infinity when b is not positive definite.
double largest_in_units(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const auto root = rigor::cholesky(b);
  return root ? rigor::largest_eigenvalue(rigor::in_units_of(*root, a))
              : std::numeric_limits<double>::infinity();
}

}  // namespace

double LongRunEntry::samples() const {
  if (!(margin > 0.0 && margin < 1.0) || !(ratio >= 1.0) || !std::isfinite(ratio)) {
    return std::numeric_limits<double>::infinity();
  }
  const Interval count = log(Interval(ratio)) / -log(Interval(1.0) - Interval(margin));
  return rigor::is_finite(count) ? std::ceil(count.upper()) : std::numeric_limits<double>::infinity();
}

CoverResult verify_long_run_entry(const TrackerModel& model, const Tube& from, double radius,
                                  const Tube& into, double into_radius, const LongRunEntry& entry,
                                  const VerificationBudget& budget) {
  const rigor::UpwardRounding upward;
  require_sizes(model, from);
  require_sizes(model, into);
  if (!from.bounds_covariance() || !into.bounds_covariance()) {
    throw std::invalid_argument("tubes without bounds of a covariance");
  }
  const bool is_question = std::isfinite(radius) && radius > 0.0 && std::isfinite(into_radius) &&
                           into_radius > 0.0 && std::isfinite(entry.samples()) && from.turns == into.turns &&
                           from.frequency == into.frequency && from.half_width == into.half_width &&
                           is_grid(budget);
  if (!is_question) {
    return {};
  }
  // The estimates of one tube, with the bounds of the other.
  Tube mixed = from;
  mixed.covariance_low = into.covariance_low;
  mixed.covariance_high = into.covariance_high;
  const auto states = static_cast<int>(from.curve.size());
  const auto ask = [&](const TubeCell& cell) -> CellAnswer {
    CellAnswer answer;
    const bool orders = [&] {
      const rigor::BallModelScope plane(0, 0);
      const CellPlace place = place_of(cell);
      const TubeHere outer = tube_at(from, place.phase, place.z);
      const TubeHere inner = tube_at(into, place.phase, place.z);
      return is_below(outer.covariance_high, inner.covariance_high, entry.ratio) &&
             is_below(inner.covariance_low, outer.covariance_low, entry.ratio);
    }();
    const rigor::BallModelScope scope(states, 0);
    const CellPlace place = place_of(cell);
    const TubeHere there = tube_at(into, place.phase, place.z);
    TubeHere here = tube_difference(from, place.z, into, place.z, place.phase);
    here.shape = tube_at(from, place.phase, place.z).shape;
    const std::vector<BallModel> deviation = in_units_of(there, state_in(here, radius));
    const WidthShares shares = width_shares(deviation);
    answer.by_phase = shares.by_phase;
    answer.by_frequency = shares.by_frequency;
    const Interval length(length_bounds(deviation, {1.0}).front());
    // A little more, for a checker whose bounds are cruder.
    constexpr double kRoom = 1.01;
    answer.is_proved = orders && is_shape(there) &&
                       rigor::certainly_less_equal(length, Interval(into_radius)) &&
                       keeps_range(model, mixed, cell, {kRoom * radius, entry.margin, entry.ratio});
    return answer;
  };
  return cover_cells(ask, budget);
}

SampledEntry sampled_long_run_entry(const Tube& from, double radius, const Tube& into, int phases) {
  const rigor::NearestRounding nearest;
  SampledEntry sampled;
  for (int j = 0; j < phases; ++j) {
    const double phase = 2.0 * std::numbers::pi * j / phases;
    for (const double z : {-1.0, 0.0, 1.0}) {
      const auto at = [&](const std::vector<PhaseSeries>& triangle, bool is_symmetric) {
        return detail::matrix_at(triangle, phase, z, is_symmetric);
      };
      const Eigen::MatrixXd u = at(from.shape, false);
      const Eigen::MatrixXd v = at(into.shape, false);
      sampled.level =
          std::max(sampled.level, radius * std::sqrt(largest_in_units(u * u.transpose(), v * v.transpose())));
      sampled.ratio = std::max(
          {sampled.ratio, largest_in_units(at(from.covariance_high, true), at(into.covariance_high, true)),
           largest_in_units(at(into.covariance_low, true), at(from.covariance_low, true))});
    }
  }
  return sampled;
}

}  // namespace veritrack::model

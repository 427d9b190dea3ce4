#include "analysis/model/filter/filter_step.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/model/filter/covariance_order.hpp"
#include "analysis/model/filter/filter_models.hpp"
#include "analysis/model/step/map_bound.hpp"
#include "analysis/model/step/place_store.hpp"
#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

BallMatrix lifted(const BallMatrix& matrix) {
  std::vector<BallModel> entries;
  entries.reserve(matrix.entries().size());
  for (const BallModel& entry : matrix.entries()) {
    entries.push_back(entry.lifted());
  }
  return {std::move(entries), matrix.columns()};
}

/// The quantities that depend on the place in the cell only.
struct FilterPlace {
  CellFrame frame;
  FilterNoise noise;
  BallMatrix low_here, high_here;    ///< of the updated covariance at the phase
  BallMatrix low_there, high_there;  ///< of the predicted one at the next phase
  BallMatrix gain;                   ///< K of the middle of both updated ones there
  BallMatrix spread;                 ///< U^-1 Delta U^-T there, Delta half of their difference
  BallMatrix factor;                 ///< L of R^-1 H Delta H' R^-1
};

/// Among models without a ball. With a slew, everything at the next phase is for every frequency to which it
/// moves.
FilterPlace place_of_filter(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double slew) {
  CellFrame frame =
      frame_of(model, tube, cell, slew > 0.0 ? FrameParts::with_samples : FrameParts::with_next);
  if (slew > 0.0) {
    const Interval move = Interval(slew) / Interval(tube.half_width);
    frame.there = tube_at(tube, frame.next_phase, frame.z + BallModel(hull(-move, move)));
  }
  FilterNoise noise = noise_of(model);
  BallMatrix low_here = updated(symmetric(frame.here.covariance_low), noise);
  BallMatrix high_here = updated(symmetric(frame.here.covariance_high), noise);
  BallMatrix low_there = symmetric(frame.there.covariance_low);
  BallMatrix high_there = symmetric(frame.there.covariance_high);
  const BallMatrix low = updated(low_there, noise);
  const BallMatrix high = updated(high_there, noise);
  const BallMatrix middle = scaled(high + low, BallModel(0.5));
  const BallMatrix delta = scaled(high - low, BallModel(0.5));
  const BallMatrix weighted = noise.inverse * noise.measured;  // R^-1 H
  BallMatrix gain = middle * transposed(weighted);
  const BallMatrix shape = [&] {
    const std::size_t n = frame.there.curve.size();
    BallMatrix u(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        u(i, j) = frame.there.shape[i * (i + 1) / 2 + j];
      }
    }
    return u;
  }();
  const auto in_units = [&](const BallMatrix& matrix) {  // U^-1 M, column by column
    BallMatrix result(matrix.rows(), matrix.columns());
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      std::vector<BallModel> column;
      for (std::size_t i = 0; i < matrix.rows(); ++i) {
        column.push_back(matrix(i, j));
      }
      const std::vector<BallModel> x = solved(shape, column);
      for (std::size_t i = 0; i < matrix.rows(); ++i) {
        result(i, j) = x[i];
      }
    }
    return result;
  };
  BallMatrix spread = in_units(transposed(in_units(delta)));
  BallMatrix factor = cholesky(congruent(weighted, delta));
  return {std::move(frame),     std::move(noise),     std::move(low_here),
          std::move(high_here), std::move(low_there), std::move(high_there),
          std::move(gain),      std::move(spread),    std::move(factor)};
}

/// Whether the bounds are a nonempty range of covariances, and bounds again at the next phase.
bool keeps_covariance(const TrackerModel& model, const FilterPlace& place, const RangeQuestion& question) {
  const std::size_t n = place.low_here.rows();
  if (!is_positive_definite(place.low_here) || !is_positive_definite(place.high_there - place.low_there)) {
    return false;
  }
  const std::vector<BallModel> jacobian = [&] {
    const rigor::BallModelScope scope(static_cast<int>(n), 0);
    TubeHere here;
    for (const BallModel& each : place.frame.here.curve) {
      here.curve.push_back(each.lifted());
    }
    for (const BallModel& each : place.frame.here.shape) {
      here.shape.push_back(each.lifted());
    }
    const std::vector<BallModel> none(static_cast<std::size_t>(model.filter->samples), BallModel(0.0));
    return parts_at(model, state_in(here, question.radius), none).jacobian;
  }();
  const JacobianParts parts = parts_of_jacobian(jacobian, n);
  if (!std::isfinite(parts.error)) {
    return false;
  }
  const Interval share = Interval(1.0) - Interval(question.margin);
  const bool has_margin = question.margin > 0.0;
  const BallMatrix high = has_margin ? scaled(place.high_there, BallModel(share)) : place.high_there;
  const BallMatrix low =
      has_margin ? scaled(place.low_there, BallModel(Interval(1.0) / share)) : place.low_there;
  if (!stays_below(parts, place.high_here, place.noise.process, high) ||
      !stays_above(parts, place.low_here, place.noise.process, low)) {
    return false;
  }
  // As functions of c, with both sides divided by c, or multiplied by it: affine in 1/c, or in c. The ends
  // decide.
  const Interval ratio(question.ratio);
  return question.ratio == 1.0 ||
         (stays_below(parts, place.high_here, scaled(place.noise.process, BallModel(Interval(1.0) / ratio)),
                      high) &&
          stays_above(parts, place.low_here, scaled(place.noise.process, BallModel(ratio)), low));
}

/// The coefficients of a class at s = z = 0, a row for each model.
Eigen::MatrixXd linear_at_middle(const std::vector<BallModel>& vector, int ball, int disturbance) {
  const rigor::BallMonomials& monomials = vector.front().monomials();
  const rigor::BallMonomials::Class& here = monomials.classes()[monomials.class_of(ball, disturbance, 0, 0)];
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(vector.size()),
                         static_cast<Eigen::Index>(here.last - here.first));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      matrix(i, j) =
          vector[static_cast<std::size_t>(i)].coefficients()[here.first + static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

/// The mu for which the linear part is shortest, in floating point; 0 when there is none. `of_gaussian`: the
/// factor of the square of Gaussian noise; 0: the noise is bounded, or there is none.
double best_multiplier(const BallMatrix& spread, const std::vector<BallModel>& deviation,
                       const std::vector<BallModel>& reach, bool is_noisy, double of_gaussian) {
  const auto n = static_cast<Eigen::Index>(spread.rows());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = spread(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).constant();
    }
  }
  const Eigen::MatrixXd of_x = linear_at_middle(deviation, 1, 0);
  const Eigen::MatrixXd reach_of_x = linear_at_middle(reach, 1, 0);
  Eigen::MatrixXd of_v;
  Eigen::MatrixXd reach_of_v;
  if (is_noisy) {
    of_v = linear_at_middle(deviation, 0, 1);
    reach_of_v = linear_at_middle(reach, 0, 1);
  }
  if (!middle.allFinite() || !of_x.allFinite() || !reach_of_x.allFinite()) {
    return 0.0;
  }
  const double largest = rigor::largest_eigenvalue(middle);
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const rigor::SmallMatrix& gram, double mu) {
    const double length = rigor::largest_eigenvalue(gram);
    if (length < least) {
      least = length;
      best = mu;
    }
  };
  for (const double factor : {1.04, 1.1, 1.2, 1.35, 1.6, 2.0, 2.7, 4.0, 7.0, 15.0, 60.0}) {
    const double mu = factor * largest + std::numeric_limits<double>::min();
    const auto root = rigor::cholesky(rigor::combination(1.0, rigor::identity(n), -1.0 / mu, middle));
    if (!root) {
      continue;
    }
    const auto gram_of = [&](const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
      const rigor::SmallMatrix both =
          rigor::stacked(rigor::lower_solution(*root, top), std::sqrt(mu) * bottom);
      return rigor::product_with_transpose(both, both);
    };
    const rigor::SmallMatrix gram = gram_of(of_x, reach_of_x);
    if (is_noisy) {
      const rigor::SmallMatrix other = gram_of(of_v, reach_of_v);
      if (of_gaussian > 0.0) {
        consider(rigor::combination(1.0, gram, of_gaussian, other), mu);
        continue;
      }
      for (const double t : {0.5, 0.68, 0.8, 0.9, 0.96}) {
        consider(rigor::combination(1.0 / t, gram, 1.0 / (1.0 - t), other), mu);
      }
    } else {
      consider(gram, mu);
    }
  }
  return best;
}

TubeHere lifted_tube(const TubeHere& of_place) {
  TubeHere result;
  for (const BallModel& each : of_place.curve) {
    result.curve.push_back(each.lifted());
  }
  for (const BallModel& each : of_place.shape) {
    result.shape.push_back(each.lifted());
  }
  return result;
}

/// The tube after the step; with a slew, `stretch` times as long, at all frequencies to which it may move.
TubeHere tube_after(const Tube& tube, const FilterPlace& place, double slew, double stretch, int of_noise) {
  if (!(slew > 0.0)) {
    return lifted_tube(place.frame.there);
  }
  Tube estimate = tube;
  estimate.covariance_low.clear();
  estimate.covariance_high.clear();
  const rigor::UpwardRounding upward;
  return tube_at(estimate, place.frame.next_phase.lifted(),
                 place.frame.z.lifted() +
                     BallModel(slew * stretch / tube.half_width) * BallModel::disturbance(of_noise));
}

/// factor' innovation: the displacement of the estimate by the range of gains.
std::vector<BallModel> reach_of(const BallMatrix& factor, const std::vector<BallModel>& innovation) {
  std::vector<BallModel> reach;
  for (std::size_t d = 0; d < innovation.size(); ++d) {
    BallModel sum;
    for (std::size_t c = d; c < innovation.size(); ++c) {
      sum += factor(c, d) * innovation[c];
    }
    reach.push_back(sum);
  }
  return reach;
}

/// L with L L' = I - spread/mu.
BallMatrix root_without(const BallMatrix& spread, double mu) {
  const rigor::BallModelScope inner(0, 0);
  const std::size_t n = spread.rows();
  BallMatrix rest(n, n);
  const BallModel inverse(Interval(1.0) / Interval(mu));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      rest(i, j) = BallModel(i == j ? 1.0 : 0.0) - spread(i, j) * inverse;
    }
  }
  return cholesky(rest);
}

}  // namespace

FilterStepOver filter_step_over(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                                const FilterStepQuestion& question, double of_gaussian, PlaceStore* store) {
  require_sizes(model, tube);
  const double radius = question.radius;
  const bool is_noisy = is_disturbed(model, question.noise);
  const bool is_moving = question.slew > 0.0;
  const auto kept = kept_at<FilterPlace>(store, model, tube, cell, question.slew, [&] {
    const rigor::BallModelScope plane(0, 0);
    return place_of_filter(model, tube, cell, question.slew);
  });
  const FilterPlace& place = *kept;
  const std::size_t n = tube.curve.size();
  const std::size_t channels = static_cast<std::size_t>(model.filter->samples);
  const int of_noise = is_noisy ? model.filter->samples : 0;
  // Noise and slew are in the unit ball together when the squared length of each is at most 1/2.
  constexpr double kRootOfTwo = 0x1.6a09e667f3bcdp0;
  const double stretch = is_noisy && is_moving ? kRootOfTwo : 1.0;
  const TubeHere here = lifted_tube(place.frame.here);
  const TubeHere there = tube_after(tube, place, question.slew, stretch, of_noise);
  const std::vector<BallModel> state = state_in(here, radius);
  std::vector<BallModel> clean;
  clean.reserve(channels);
  for (const BallModel& sample : place.frame.next) {
    clean.push_back(sample.lifted());
  }
  const std::vector<BallModel> samples = noisy_samples(model, clean, question.noise, stretch);
  const trackers::FilterValues<BallModel> values = parts_at(model, state, samples);
  const BallMatrix gain = lifted(place.gain);
  std::vector<BallModel> next = values.predicted;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      next[i] += gain(i, c) * values.innovation[c];
    }
    next[i] -= there.curve[i];
  }
  const std::vector<BallModel> deviation = in_units_of(there, next);
  const std::vector<BallModel> reach = reach_of(lifted(place.factor), values.innovation);
  FilterStepOver step;
  const bool is_known = is_shape(here) && is_shape(there);
  step.frequency_error =
      is_known ? (frequency_of(model, state) - place.frame.frequency.lifted()).range() : Interval::empty();
  const double mu = best_multiplier(place.spread, deviation, reach, is_noisy || is_moving, of_gaussian);
  if (!is_known || !(mu > 0.0) || !std::isfinite(mu)) {
    return step;
  }
  step.vector = solved(lifted(root_without(place.spread, mu)), deviation);
  const BallModel root_of_mu(sqrt(Interval(mu)));
  for (const BallModel& each : reach) {
    step.vector.push_back(root_of_mu * each);
  }
  step.is_known = !question.with_covariance || [&] {
    const rigor::BallModelScope inner(0, 0);
    // A little more, for a checker whose bounds are cruder.
    constexpr double kRoom = 1.01;
    return keeps_covariance(model, place, {kRoom * radius, question.margin, 1.0});
  }();
  return step;
}

StepBounds bound_filter_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                             const FilterStepQuestion& question, const std::vector<double>& scales,
                             PlaceStore* store) {
  require_sizes(model, tube);
  const bool is_noisy = is_disturbed(model, question.noise);
  const bool is_moving = question.slew > 0.0;
  StepBounds bounds;
  bounds.steps.assign(scales.size(), std::numeric_limits<double>::quiet_NaN());
  const int of_noise = is_noisy ? model.filter->samples : 0;
  const rigor::BallModelScope scope(static_cast<int>(tube.curve.size()), is_moving ? of_noise + 1 : of_noise);
  const FilterStepOver step = filter_step_over(model, tube, cell, question, 0.0, store);
  bounds.frequency_error = step.frequency_error;
  if (step.vector.empty()) {
    return bounds;
  }
  const WidthShares shares = width_shares(step.vector);
  // These do not include the shortfall of the covariance bounds.
  bounds.by_phase = step.is_known ? shares.by_phase : std::numeric_limits<double>::quiet_NaN();
  bounds.by_frequency = step.is_known ? shares.by_frequency : std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> lengths = length_bounds(step.vector, scales, is_noisy && is_moving);
  if (step.is_known) {
    bounds.steps = lengths;
  }
  return bounds;
}

bool keeps_range(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                 const RangeQuestion& question) {
  require_sizes(model, tube);
  const rigor::BallModelScope plane(0, 0);
  return keeps_covariance(model, place_of_filter(model, tube, cell, 0.0), question);
}

}  // namespace veritrack::model

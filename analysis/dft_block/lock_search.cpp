#include "analysis/dft_block/lock_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::dft_block {

namespace {

using PointMatrix = rigor::Matrix<3>;
using PointVector = rigor::Vector<3>;
constexpr double kPi = std::numbers::pi;

struct PointTap {
  double value, slope;
};

PointTap tap(double offset, int m) {
  const double d = offset + m;
  const auto sinc = trackers::detail::sinc_with_slope(d, std::sin(kPi * d), std::cos(kPi * d));
  const double sign = m % 2 == 0 ? 1.0 : -1.0;
  return {sign * sinc.value, sign * sinc.slope};
}

/// One more block: P is that of the prediction, before and after.
PointMatrix next_covariance(const PointMatrix& p, const PointMatrix& information, const PointMatrix& turn,
                            const PointMatrix& noise) {
  return turn * (p.inverse() + information).inverse() * turn.transpose() + noise;
}

/// L with L L' = a; not a number where there is none.
PointMatrix root_of(const PointMatrix& a) {
  return rigor::cholesky(a).value_or(
      rigor::SmallMatrix::Constant(3, 3, std::numeric_limits<double>::quiet_NaN()));
}

/// Directions on the sphere, well spread.
std::vector<PointVector> directions(int count) {
  std::vector<PointVector> result;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double turn = 2.0 * kPi * i * (std::numbers::phi - 1.0);
    const double across = std::sqrt(1.0 - z * z);
    result.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
  }
  return result;
}

/// Room that a proposal leaves for its proof.
constexpr double kDriftRoom = 1.1;

/// A block with Gaussian noise of a tilt.
struct DriftSample {
  PointMatrix step, secant, factor, gain, spread, turned;
};

/// I - tilt F X N N'X F', at least.
PointMatrix left_over(const DriftSample& one, double weight) {
  const PointMatrix unit = PointMatrix::Identity();
  const PointMatrix inner = unit - weight * one.factor.transpose() * one.spread * one.factor;
  return unit - one.turned / weight - one.gain * inner.inverse() * one.gain.transpose();
}

/// An upper bound on the growth of the tilted expectation of the squared error from these errors.
double growth_of(const std::vector<DriftSample>& samples, double weight) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const PointMatrix unit = PointMatrix::Identity();
  double most = 0.0;
  for (const DriftSample& one : samples) {
    const PointMatrix seen = one.factor.transpose() * one.spread;
    Matrix6 right;
    right << unit - one.turned / weight, one.gain, one.gain.transpose(), unit - weight * seen * one.factor;
    const auto root = rigor::cholesky(right);
    if (!root) {
      return std::numeric_limits<double>::infinity();
    }
    const PointMatrix carried = seen * one.secant;
    const rigor::SmallMatrix below =
        rigor::lower_solution(*root, rigor::stacked(one.step, PointMatrix(weight * carried)));
    const PointMatrix all =
        rigor::combination(weight, PointMatrix(one.secant.transpose() * one.spread * one.secant), 1.0,
                           rigor::product(rigor::transposed(below), below));
    most = std::max(most, -smallest_eigenvalue(-all));
  }
  return most;
}

/// The same with the weight for which it is least.
void choose_growth(const std::vector<DriftSample>& samples, LockDrift& drift) {
  drift.growth = std::numeric_limits<double>::infinity();
  for (double weight = 0.3; weight < 8.0; weight *= 1.35) {
    const double found = growth_of(samples, weight);
    if (found < drift.growth) {
      drift.growth = found;
      drift.weight = weight;
    }
  }
  drift.growth *= kDriftRoom;
}

/// The largest one of the shape that `middle` has; false when there is none.
bool choose_floor(const std::vector<DriftSample>& samples, const DriftSample& middle, LockDrift& drift) {
  double best = 0.0;
  for (double weight = 0.1; weight < 8.0; weight *= 1.5) {
    const PointMatrix shape = left_over(middle, weight);
    double below = 0.0;
    for (const DriftSample& one : samples) {
      below = std::max(below, -smallest_eigenvalue(left_over(one, weight) - shape));
    }
    constexpr double kMargin = 0.03;
    const PointMatrix floor = shape - (below * kDriftRoom + kMargin) * PointMatrix::Identity();
    if (smallest_eigenvalue(floor) > 0.0 && floor.determinant() > best) {
      best = floor.determinant();
      drift.floor = 0.5 * (floor + floor.transpose());
      drift.floor_weight = weight;
    }
  }
  return best > 0.0;
}

}  // namespace

double smallest_eigenvalue(const PointMatrix& a) {
  return rigor::least_eigenvalue(PointMatrix(0.5 * (a + a.transpose())));
}

LockSearch::LockSearch(const LockProblem& problem)
    : model_{midpoint(problem.q1),      midpoint(problem.q2),   midpoint(problem.q3),
             midpoint(problem.r),       problem.half_width,     problem.amplitude.lower(),
             problem.amplitude.upper(), problem.offset.lower(), problem.offset.upper()} {
  const rigor::NearestRounding nearest;
  turn_.setIdentity();
  turn_(1, 2) = 2.0 * kPi;
  const double amplitude = 0.5 * (model_.amplitude_low + model_.amplitude_high);
  const double offset = 0.5 * (model_.offset_low + model_.offset_high);
  const PointMatrix noise = process_noise(amplitude);
  const PointMatrix information = jacobian(amplitude, 1.0, offset);
  steady_ = noise + 0.01 * PointMatrix::Identity();
  constexpr int kMostSteps = 20'000;
  for (int k = 0; k < kMostSteps; ++k) {
    const PointMatrix next = next_covariance(steady_, information, turn_, noise);
    const double change = (next - steady_).norm();
    steady_ = next;
    if (!(change > 1e-13 * steady_.norm())) {
      break;
    }
  }
  frame_ = root_of(steady_);
}

PointMatrix LockSearch::process_noise(double amplitude) const {
  PointMatrix q;
  q << model_.q1 * 4.0 * kPi / amplitude, 0.0, 0.0, 0.0, model_.q2 + kPi * kPi * model_.q3, kPi * model_.q3,
      0.0, kPi * model_.q3, model_.q3;
  return q;
}

PointMatrix LockSearch::jacobian(double amplitude, double x1, double offset) const {
  double value = 0.0;
  double mixed = 0.0;
  double slope = 0.0;
  for (int m = -model_.half_width; m <= model_.half_width; ++m) {
    const PointTap one = tap(offset, m);
    value += one.value * one.value;
    mixed += one.value * one.slope;
    slope += one.slope * one.slope;
  }
  const double scale = amplitude * amplitude / (4.0 * model_.r) * x1 * x1;
  PointMatrix j;
  j << 4.0 * scale * value, 0.0, 2.0 * x1 * scale * mixed, 0.0, x1 * x1 * scale * value, 0.0,
      2.0 * x1 * scale * mixed, 0.0, x1 * x1 * scale * slope;
  return j;
}

PointMatrix LockSearch::secant(double amplitude, const PointVector& error, double offset) const {
  const double x1 = 1.0 + error(0);
  const double estimate = offset + error(2);
  double value = 0.0;
  double mixed = 0.0;
  double value_true = 0.0;
  double slope_true = 0.0;
  double value_secant = 0.0;
  double slope_secant = 0.0;
  for (int m = -model_.half_width; m <= model_.half_width; ++m) {
    const PointTap x = tap(estimate, m);
    const PointTap d = tap(offset, m);
    const double between =
        std::fabs(error(2)) > 1e-5 ? (x.value - d.value) / error(2) : tap(offset + 0.5 * error(2), m).slope;
    value += x.value * x.value;
    mixed += x.value * x.slope;
    value_true += x.value * d.value;
    slope_true += x.slope * d.value;
    value_secant += x.value * between;
    slope_secant += x.slope * between;
  }
  const double turn = error(1);
  const bool is_small = std::fabs(turn) < 1e-6;
  const double sine_ratio = is_small ? 1.0 : std::sin(turn) / turn;
  const double cosine_ratio = is_small ? 0.5 * turn : (1.0 - std::cos(turn)) / turn;
  const double weight = amplitude * amplitude / (4.0 * model_.r);
  const double scale = weight * x1 * x1;
  PointMatrix s;
  s << 2.0 * weight * x1 * value * (1.0 + x1), 2.0 * weight * x1 * value_true * cosine_ratio,
      2.0 * weight * x1 * value_secant, 0.0, scale * value_true * sine_ratio, 0.0, scale * mixed * (1.0 + x1),
      scale * slope_true * cosine_ratio, scale * slope_secant;
  return s;
}

std::optional<LockBounds> LockSearch::set_for(const ErrorSet& errors, double room) const {
  const rigor::NearestRounding nearest;
  const auto reach = [&](int i) {
    return std::min(errors.radius * frame_.row(i).norm(), frame_.row(i).cwiseAbs().dot(errors.limits));
  };
  const double first = reach(0);
  const double third = reach(2);
  constexpr double kMostFirst = 0.9;
  if (!(first < kMostFirst)) {
    return std::nullopt;
  }
  constexpr int kOffsets = 16;
  const double grow = 1.0 + (room - 1.0) / 3.0;
  constexpr double kMost = 20.0;
  double above = 1.0;
  double below = 1.0;
  for (const double amplitude : {model_.amplitude_low, model_.amplitude_high}) {
    const PointMatrix noise = process_noise(amplitude);
    for (const double x1 : {1.0 - first, 1.0 + first}) {
      for (int i = 0; i <= kOffsets; ++i) {
        const double low = model_.offset_low - third;
        const double high = model_.offset_high + third;
        const PointMatrix j = jacobian(amplitude, x1, low + (high - low) * i / kOffsets);
        const auto is_above = [&] {
          const PointMatrix p = above * steady_;
          return smallest_eigenvalue(frame_.inverse() * (p - next_covariance(p, j, turn_, noise)) *
                                     frame_.inverse().transpose()) > 0.0;
        };
        const auto is_below = [&] {
          const PointMatrix p = steady_ / below;
          return smallest_eigenvalue(frame_.inverse() * (next_covariance(p, j, turn_, noise) - p) *
                                     frame_.inverse().transpose()) > 0.0;
        };
        while (!is_above() && above < kMost) {
          above *= grow;
        }
        while (!is_below() && below < kMost) {
          below *= grow;
        }
      }
    }
  }
  if (!(above < kMost) || !(below < kMost)) {
    return std::nullopt;
  }
  double floor = 1.0;
  const PointMatrix inverse = frame_.inverse();
  for (const double amplitude : {model_.amplitude_low, model_.amplitude_high}) {
    floor = std::min(floor, smallest_eigenvalue(inverse * process_noise(amplitude) * inverse.transpose()));
  }
  return LockBounds{frame_, above * room, below * room, std::max(0.0, floor / room)};
}

PointMatrix LockSearch::turn_in_frame() const {
  return frame_.inverse() * turn_ * frame_;
}

std::vector<PointMatrix> LockSearch::process_noises_in_frame() const {
  const PointMatrix inverse = frame_.inverse();
  std::vector<PointMatrix> result;
  for (const double amplitude : {model_.amplitude_low, model_.amplitude_high}) {
    result.emplace_back(inverse * process_noise(amplitude) * inverse.transpose());
  }
  return result;
}

BlockSample LockSearch::sample_at(const LockBounds& set, double amplitude, const PointVector& direction,
                                  double offset) const {
  const PointMatrix unit = PointMatrix::Identity();
  const PointMatrix turn = turn_in_frame();
  const PointVector error = frame_ * direction;
  const PointMatrix j = frame_.transpose() * jacobian(amplitude, 1.0 + error(0), offset + error(2)) * frame_;
  const PointMatrix s = frame_.transpose() * secant(amplitude, error, offset) * frame_;
  const PointMatrix high = (j + unit / set.above).inverse();
  const PointMatrix low = (j + unit * set.below).inverse();
  const PointMatrix centre = 0.5 * (high + low);
  const PointMatrix spread = 0.5 * (high - low);
  return {turn * (unit - centre * s), s, j, centre, spread, turn * spread * turn.transpose()};
}

std::vector<BlockSample> LockSearch::samples(const LockBounds& set, const ErrorSet& errors, double inner,
                                             int directions_of_each, int offsets) const {
  std::vector<BlockSample> result;
  for (const double amplitude : {model_.amplitude_low, model_.amplitude_high}) {
    for (const double share : {1.0, inner}) {
      for (const PointVector& direction : directions(share > 0.0 ? directions_of_each : 0)) {
        const PointVector e =
            (share * errors.radius * direction).cwiseMin(errors.limits).cwiseMax(-errors.limits);
        for (int i = 0; i <= offsets; ++i) {
          const double offset = model_.offset_low + (model_.offset_high - model_.offset_low) * i / offsets;
          result.push_back(sample_at(set, amplitude, e, offset));
        }
      }
    }
    if (!(model_.amplitude_high > model_.amplitude_low)) {
      break;
    }
  }
  return result;
}

std::optional<LockRate> LockSearch::rate_for(const LockBounds& set, double radius) const {
  const rigor::NearestRounding nearest;
  constexpr double kInner = 0.6;
  constexpr int kDirections = 120;
  constexpr int kOffsets = 6;
  const std::vector<BlockSample> found_samples =
      samples(set, ErrorSet::ball(radius), kInner, kDirections, kOffsets);
  // rate^2 is the largest eigenvalue of weight s'Ds + A'(I - FDF'/weight)^-1 A.
  const auto squared_rate = [&](double weight) {
    double most = 0.0;
    for (const BlockSample& sample : found_samples) {
      const PointMatrix left = PointMatrix::Identity() - sample.turned / weight;
      if (!(smallest_eigenvalue(left) > 1e-3)) {
        return std::numeric_limits<double>::infinity();
      }
      const PointMatrix all = weight * sample.secant.transpose() * sample.spread * sample.secant +
                              sample.step.transpose() * left.inverse() * sample.step;
      most = std::max(most, -smallest_eigenvalue(-all));
    }
    return most;
  };
  double best = std::numeric_limits<double>::infinity();
  double best_weight = 1.0;
  for (double weight = 0.02; weight < 20.0; weight *= 1.3) {
    const double found = squared_rate(weight);
    if (found < best) {
      best = found;
      best_weight = weight;
    }
  }
  constexpr double kRoom = 1.05;
  const double rate = std::sqrt(best) * kRoom;
  if (!(rate < 1.0)) {
    return std::nullopt;
  }
  return LockRate{radius, rate, best_weight};
}

std::optional<LockDrift> LockSearch::drift_for(const LockBounds& set, double radius, double tilt) const {
  const rigor::NearestRounding nearest;
  const PointMatrix turn = turn_in_frame();
  const auto drifting = [&](const BlockSample& one) {
    const PointMatrix factor = std::sqrt(tilt) * root_of(one.information);
    return DriftSample{one.step, one.secant, factor, turn * one.centre * factor, one.spread, one.turned};
  };
  constexpr int kDirections = 40;
  constexpr int kOffsets = 4;
  std::vector<DriftSample> found_samples;
  for (const BlockSample& one : samples(set, ErrorSet::ball(radius), 0.0, kDirections, kOffsets)) {
    found_samples.push_back(drifting(one));
  }
  LockDrift drift;
  drift.radius = radius;
  drift.tilt = tilt;
  choose_growth(found_samples, drift);
  // The floor has the shape of that of the exact lock in the middle.
  const DriftSample middle =
      drifting(sample_at(set, 0.5 * (model_.amplitude_low + model_.amplitude_high), PointVector::Zero(),
                         0.5 * (model_.offset_low + model_.offset_high)));
  return drift.growth < 1.0 && choose_floor(found_samples, middle, drift) ? std::optional(drift)
                                                                          : std::nullopt;
}

}  // namespace veritrack::dft_block

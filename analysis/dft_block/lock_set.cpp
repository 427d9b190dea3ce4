#include "analysis/dft_block/lock_set.hpp"

#include <array>
#include <cmath>

#include "analysis/dft_block/lock_matrices.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using Matrix3 = rigor::IntervalMatrix<3>;
using Vector3 = rigor::IntervalVector<3>;
using OffsetCell = rigor::IntervalVector<5>;  ///< errors, offset and amplitude

/// Divided where the information changes most; empty when no double lies between the ends.
std::optional<std::array<OffsetCell, 2>> halves_of(const OffsetCell& cell) {
  const std::array weights{2.0, 0.15, 1.3, 1.3, 2.0 / cell(4).lower()};
  int widest = 0;
  for (int i = 1; i < 5; ++i) {
    if (weights[static_cast<std::size_t>(i)] * width(cell(i)) >
        weights[static_cast<std::size_t>(widest)] * width(cell(widest))) {
      widest = i;
    }
  }
  const Interval& side = cell(widest);
  const double middle = midpoint(side);
  if (!(side.lower() < middle && middle < side.upper())) {
    return std::nullopt;
  }
  std::array<OffsetCell, 2> halves{cell, cell};
  halves[0](widest) = Interval::from_bounds(side.lower(), middle);
  halves[1](widest) = Interval::from_bounds(middle, side.upper());
  return halves;
}

}  // namespace

Interval squared_root_amplitude(const Interval& amplitude) {
  return amplitude / (Interval(4.0) * rigor::pi());
}

std::optional<LockFrame> LockFrame::make(const LockProblem& problem, const LockBounds& set) {
  LockFrame result;
  result.problem_ = problem;
  result.set_ = set;
  if (!set.frame.allFinite() || !(set.above >= 1.0) || !(set.below >= 1.0) || !std::isfinite(set.above) ||
      !std::isfinite(set.below)) {
    return std::nullopt;
  }
  result.frame_ = rigor::to_interval(set.frame);
  const auto inverse = rigor::inverse(result.frame_);
  if (!inverse) {
    return std::nullopt;
  }
  result.inverse_ = *inverse;
  Matrix3 turn = scaled_identity(Interval(1.0));
  turn(1, 2) = Interval(2.0) * rigor::pi();
  result.turn_ = result.inverse_ * turn * result.frame_;
  return result;
}

Matrix3 LockFrame::process_noise(const Interval& amplitude) const {
  const Interval zero(0.0);
  const Interval pi = rigor::pi();
  Matrix3 q;
  q << problem_.q1 / squared_root_amplitude(amplitude), zero, zero, zero,
      problem_.q2 + square(pi) * problem_.q3, pi * problem_.q3, zero, pi * problem_.q3, problem_.q3;
  return inverse_ * q * inverse_.transpose();
}

Interval LockFrame::reach(int i) const {
  Interval sum(0.0);
  for (int j = 0; j < 3; ++j) {
    sum += square(frame_(i, j));
  }
  return sqrt(sum);
}

Interval LockFrame::length_of(const Vector3& bounds) const {
  Interval sum(0.0);
  for (int i = 0; i < 3; ++i) {
    Interval part(0.0);
    for (int j = 0; j < 3; ++j) {
      part += abs(inverse_(i, j)) * bounds(j);
    }
    sum += square(part);
  }
  return sqrt(sum);
}

Interval LockFrame::disturbance() const {
  // C^-1 F P H'R^-1 n with P H'R^-1 H P <= P and F P F' <= above - Q: docs/block-tracker.md, section 3.
  const Matrix3 q = process_noise(problem_.amplitude);
  if (!(set_.floor >= 0.0) || !(set_.floor < set_.above) ||
      !is_definite(Matrix3(q - scaled_identity(Interval(set_.floor))))) {
    return Interval::empty();
  }
  const Interval gain = sqrt(Interval(set_.above) - Interval(set_.floor));
  Interval moved(0.0);
  for (const Interval& part : slew_direction()) {
    moved += square(part);
  }
  return gain * problem_.noise / sqrt(problem_.r) + sqrt(moved) * problem_.slew;
}

Vector3 LockFrame::slew_direction() const {
  return rigor::pi() * inverse_.col(1) + inverse_.col(2);
}

bool LockFrame::holds(const Matrix3& covariance) const {
  const Interval root = sqrt(squared_root_amplitude(problem_.amplitude));
  Matrix3 to_middle = scaled_identity(Interval(1.0));
  to_middle(0, 0) = Interval(1.0) / root;
  to_middle(1, 2) = rigor::pi();
  const Matrix3 change = inverse_ * to_middle;
  const Matrix3 inside = change * covariance * change.transpose();
  return is_definite(Matrix3(scaled_identity(Interval(set_.above)) - inside)) &&
         is_definite(Matrix3(inside - scaled_identity(Interval(1.0) / Interval(set_.below))));
}

bool LockFrame::is_outside(const Cell& cell, const ErrorSet& errors) const {
  const Vector3 e = inverse_ * cell.head<3>();
  Interval sum(0.0);
  for (int i = 0; i < 3; ++i) {
    if (rigor::certainly_less(Interval(errors.limits(i)), abs(e(i)))) {
      return true;
    }
    sum += square(e(i));
  }
  return rigor::certainly_less(square(Interval(errors.radius)), sum);
}

std::optional<LockFrame::BlockOverCell> LockFrame::block_over(const Cell& cell,
                                                              const NextBounds& next) const {
  const Interval& amplitude = cell(4);
  const Interval weight = square(amplitude) / (Interval(4.0) * problem_.r);
  const BlockInformation information =
      information_over(cell(0), cell(1), cell(2), cell(3), weight, problem_.half_width);
  const Matrix3 jacobian = frame_.transpose() * information.jacobian * frame_;
  const Interval above(set_.above);
  const Interval below(set_.below);
  const auto highest = inverse_of(jacobian + scaled_identity(Interval(1.0) / above));
  const auto lowest = inverse_of(jacobian + scaled_identity(below));
  if (!highest || !lowest) {
    return std::nullopt;
  }
  const Matrix3 noise = process_noise(amplitude);
  if (!is_definite(Matrix3(scaled_identity(Interval(next.above)) - moved(*highest) - noise)) ||
      !is_definite(Matrix3(moved(*lowest) + noise - scaled_identity(Interval(1.0) / Interval(next.below))))) {
    return std::nullopt;
  }
  // With A = J + I/above, B = J + below I: I - (A^-1 + B^-1) J/2 = (A^-1/above + below B^-1)/2 and A^-1 -
  // B^-1 = A^-1 (B - A) B^-1.
  const Interval half(0.5);
  BlockOverCell block;
  block.centre = half * (*highest + *lowest);
  const Matrix3 product = *highest * *lowest;
  block.spread = half * (below - Interval(1.0) / above) * rigor::intersection(product, product.transpose());
  block.secant = frame_.transpose() * information.secant * frame_;
  block.factor = frame_.transpose() * information.factor;
  const Matrix3 more = frame_.transpose() * information.more * frame_;
  block.step = turn_ * (half * ((Interval(1.0) / above) * *highest + below * *lowest) - block.centre * more);
  return block;
}

bool LockFrame::falls_over(const Cell& cell, const LockRate& rate) const {
  const auto block = block_over(cell);
  if (!block) {
    return false;
  }
  const Interval petersen(rate.weight);
  const Matrix3 first = scaled_identity(square(Interval(rate.rate))) -
                        petersen * Matrix3(block->secant.transpose() * block->spread * block->secant);
  const Matrix3 second = scaled_identity(Interval(1.0)) - (Interval(1.0) / petersen) * moved(block->spread);
  return is_definite(first, block->step, second);
}

bool LockFrame::is_late_over(const Cell& cell, const LateStage& stage) const {
  const auto block = block_over(cell, {stage.next_above, stage.next_below});
  if (!block) {
    return false;
  }
  // F (I - X secant) is `step`, and F D secant more or less; |u'Dv| <= sqrt(u'Du v'Dv).
  const Matrix3 turned = moved(block->spread);
  const Matrix3 seen = block->secant.transpose() * block->spread * block->secant;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Interval middle = abs(block->step(i, j) - Interval(stage.reference(i, j)));
      const Interval away = sqrt(max(Interval(0.0), turned(i, i)) * max(Interval(0.0), seen(j, j)));
      if (!rigor::certainly_less_equal(middle + away, Interval(stage.excess(i, j)))) {
        return false;
      }
    }
  }
  const Matrix3 gain = turn_ * block->centre * block->factor;
  const Interval lost = (block->factor.transpose() * block->spread * block->factor).trace();
  const Interval weight(stage.noise_weight);
  const Interval one(1.0);
  return is_definite(Matrix3(rigor::to_interval(stage.noise) -
                             (one + weight) * Matrix3(gain * gain.transpose()) -
                             (one + one / weight) * lost * turned));
}

bool LockFrame::drifts_over(const Cell& cell, const LockDrift& drift) const {
  const auto block = block_over(cell);
  if (!block) {
    return false;
  }
  const Interval root = sqrt(Interval(drift.tilt));
  const Matrix3 factor = root * block->factor;
  const Matrix3 gain = turn_ * block->centre * factor;
  const Matrix3 unit = scaled_identity(Interval(1.0));
  const Matrix3 turned = moved(block->spread);
  const Matrix3 seen = factor.transpose() * block->spread;
  const Matrix3 lost = seen * factor;
  const Interval floor_weight(drift.floor_weight);
  if (!is_definite(Matrix3(unit - rigor::to_interval(drift.floor) - (Interval(1.0) / floor_weight) * turned),
                   Matrix3(gain.transpose()), Matrix3(unit - floor_weight * lost))) {
    return false;
  }
  const Interval petersen(drift.weight);
  return is_definite(Matrix3(scaled_identity(Interval(drift.growth)) -
                             petersen * Matrix3(block->secant.transpose() * block->spread * block->secant)),
                     block->step, Matrix3(unit - (Interval(1.0) / petersen) * turned),
                     Matrix3(petersen * (seen * block->secant)), Matrix3(gain.transpose()),
                     Matrix3(unit - petersen * lost));
}

bool LockFrame::verify(const LockRate& rate, std::int64_t most_cells) const {
  if (!(rate.radius > 0.0) || !(rate.rate > 0.0) || !(rate.rate < 1.0) || !(rate.weight > 0.0) ||
      !std::isfinite(rate.radius) || !std::isfinite(rate.weight)) {
    return false;
  }
  return verify_cells(ErrorSet::ball(rate.radius), most_cells,
                      [&](const Cell& cell) { return falls_over(cell, rate); });
}

bool LockFrame::verify(const LateStage& stage, std::int64_t most_cells) const {
  const auto is_number = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!is_number(stage.errors.radius) || !stage.errors.limits.allFinite() ||
      !(stage.errors.limits.array() > 0.0).all() || stage.above != set_.above || stage.below != set_.below ||
      !(stage.next_above >= 1.0 && stage.next_above < stage.above) ||
      !(stage.next_below >= 1.0 && stage.next_below < stage.below) || !is_number(stage.noise_weight) ||
      !stage.reference.allFinite() || !stage.excess.allFinite() || !stage.noise.allFinite() ||
      stage.noise != stage.noise.transpose()) {
    return false;
  }
  return verify_cells(stage.errors, most_cells, [&](const Cell& cell) { return is_late_over(cell, stage); });
}

bool LockFrame::verify(const LockDrift& drift, std::int64_t most_cells) const {
  if (!(drift.radius > 0.0) || !std::isfinite(drift.radius) || !(drift.tilt > 0.0) ||
      !std::isfinite(drift.tilt) || !(drift.growth > 0.0) || !(drift.growth < 1.0) || !(drift.weight > 0.0) ||
      !std::isfinite(drift.weight) || !(drift.floor_weight > 0.0) || !std::isfinite(drift.floor_weight) ||
      !drift.floor.allFinite() || drift.floor != drift.floor.transpose() ||
      !is_definite(rigor::to_interval(drift.floor))) {
    return false;
  }
  return verify_cells(ErrorSet::ball(drift.radius), most_cells,
                      [&](const Cell& cell) { return drifts_over(cell, drift); });
}

bool LockFrame::verify_cells(const ErrorSet& errors, std::int64_t most_cells,
                             const std::function<bool(const Cell&)>& is_verified) const {
  Cell whole;
  for (int i = 0; i < 3; ++i) {
    Interval within_limits(0.0);
    for (int j = 0; j < 3; ++j) {
      within_limits += abs(frame_(i, j)) * Interval(errors.limits(j));
    }
    whole(i) = min(Interval(errors.radius) * reach(i), within_limits) * rigor::symmetric(1.0);
  }
  whole(3) = problem_.offset;
  whole(4) = problem_.amplitude;
  if (!rigor::is_finite(whole) || !rigor::certainly_positive(problem_.amplitude)) {
    return false;
  }
  const auto look = [&](const Cell& cell) -> search::CellDecision<Cell> {
    if (is_outside(cell, errors) || is_verified(cell)) {
      return {true};
    }
    return {false, halves_of(cell)};
  };
  return search::cover_by_bisection(whole, most_cells, look).is_proved;
}

}  // namespace veritrack::dft_block

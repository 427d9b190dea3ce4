#include "analysis/dft_block/lock_set.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using Matrix3 = rigor::IntervalMatrix<3>;
using Vector3 = rigor::IntervalVector<3>;

/// The inverse of every symmetric matrix in `a`, to second order: with X near it and G = I - A X, A^-1 = X (I
/// + G + G^2 (I - G)^-1). None when |G| may be 1.
std::optional<Matrix3> inverse_of(const Matrix3& a) {
  const rigor::Matrix<3> near = rigor::midpoint(a).inverse();
  if (!near.allFinite()) {
    return std::nullopt;
  }
  const Matrix3 x = rigor::to_interval(near);
  const Matrix3 g = Matrix3(rigor::to_interval(rigor::Matrix<3>(rigor::Matrix<3>::Identity()))) - a * x;
  Interval squares(0.0);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      squares += square(g(i, j));
    }
  }
  const Interval size(squares.upper());
  const Interval length = sqrt(size);
  if (!rigor::certainly_less(length, Interval(1.0))) {
    return std::nullopt;
  }
  const double rest = (size / (Interval(1.0) - length)).upper();
  Matrix3 correction = g;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      correction(i, j) += rigor::symmetric(rest);
    }
  }
  const Matrix3 result = x + x * correction;
  // A^-1 is symmetric.
  return rigor::intersection(result, result.transpose());
}

Matrix3 scaled_identity(const Interval& scale) {
  Matrix3 result = rigor::to_interval(rigor::Matrix<3>(rigor::Matrix<3>::Zero()));
  for (int i = 0; i < 3; ++i) {
    result(i, i) = scale;
  }
  return result;
}

bool is_definite(const Matrix3& a) {
  rigor::LowerTriangle<3> lower;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      lower[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = a(i, j);
    }
  }
  return rigor::certainly_positive_definite(lower);
}

/// Is [a, b'; b, c] positive definite?
bool is_definite(const Matrix3& a, const Matrix3& b, const Matrix3& c) {
  rigor::LowerTriangle<6> lower;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (int j = 0; j < 3; ++j) {
      const auto column = static_cast<std::size_t>(j);
      lower[row][column] = a(i, j);
      lower[row + 3][column] = b(i, j);
      lower[row + 3][column + 3] = c(i, j);
    }
  }
  return rigor::certainly_positive_definite(lower);
}

/// sin(x)/x and (1 - cos x)/x.
std::pair<Interval, Interval> turned_ratios(const Interval& x) {
  // Derivatives: of the first at most |x|/3, of the second at most 1/2.
  const Interval middle(midpoint(x));
  const Interval from_middle = x - middle;
  const Interval around = rigor::symmetric(magnitude(from_middle * Interval(magnitude(x)) / Interval(3.0)));
  const Interval turned = rigor::symmetric(magnitude(from_middle / Interval(2.0)));
  constexpr double kNear = 1e-3;
  if (magnitude(middle) < kNear) {
    const Interval square_of = square(middle);
    return {Interval(1.0) - square_of / Interval(6.0) + square(square_of) * Interval::from_bounds(0.0, 0.01) +
                around,
            middle / Interval(2.0) - middle * square_of * Interval::from_bounds(0.0, 0.05) + turned};
  }
  const auto [sine, cosine] = sin_cos(middle);
  return {sine / middle + around, (Interval(1.0) - cosine) / middle + turned};
}

/// H'R^-1 H at the estimate; H'R^-1 of the secants of h between truth and estimate, v = -secant z; and by how
/// much that is more than the first.
struct Information {
  Matrix3 jacobian, secant, more;
};

Information information_over(const Interval& first, const Interval& turn, const Interval& error,
                             const Interval& offset, const Interval& weight, int half_width) {
  const ToneSums sums = enclose_tone_sums(offset, error, half_width);
  const auto [sine_ratio, cosine_ratio] = turned_ratios(turn);
  const Interval x = Interval(1.0) + first;
  const Interval power = square(x);
  const Interval scale = weight * power;
  const Interval twice = Interval(2.0) * x;
  const Interval growth = Interval(2.0) + first;  // (x^2 - 1)/(x - 1)
  const Interval zero(0.0);
  Information result;
  result.jacobian << Interval(4.0) * scale * sums.value_value, zero, scale * twice * sums.value_slope, zero,
      scale * power * sums.value_value, zero, scale * twice * sums.value_slope, zero,
      scale * power * sums.slope_slope;
  result.secant << weight * twice * sums.value_value * growth,
      weight * twice * sums.value_true * cosine_ratio, weight * twice * sums.value_secant, zero,
      scale * sums.value_true * sine_ratio, zero, scale * sums.value_slope * growth,
      scale * sums.slope_true * cosine_ratio, scale * sums.slope_secant;
  result.more = result.secant;
  result.more(0, 0) = -(weight * twice * sums.value_value * first);
  result.more(0, 2) = weight * twice * (sums.value_secant - power * sums.value_slope);
  result.more(1, 1) = scale * (sums.value_true * sine_ratio - power * sums.value_value);
  result.more(2, 0) = -(scale * sums.value_slope * first);
  result.more(2, 2) = scale * (sums.slope_secant - power * sums.slope_slope);
  return result;
}

}  // namespace

Interval squared_root_amplitude(const Interval& amplitude) {
  return amplitude / (Interval(4.0) * rigor::pi());
}

std::optional<LockFrame> LockFrame::make(const LockProblem& problem, const LockSet& set) {
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
  for (int i = 0; i < 3; ++i) {
    moved += square(rigor::pi() * inverse_(i, 1) + inverse_(i, 2));
  }
  return gain * problem_.noise / sqrt(problem_.r) + sqrt(moved) * problem_.slew;
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

bool LockFrame::is_outside(const Cell& cell, double radius) const {
  const Vector3 e = inverse_ * cell.head<3>();
  Interval sum(0.0);
  for (int i = 0; i < 3; ++i) {
    sum += square(e(i));
  }
  return rigor::certainly_less(square(Interval(radius)), sum);
}

bool LockFrame::verify_cell(const Cell& cell, const LockRate& rate) const {
  const Interval amplitude = cell(4);
  const Interval weight = square(amplitude) / (Interval(4.0) * problem_.r);
  const Information information =
      information_over(cell(0), cell(1), cell(2), cell(3), weight, problem_.half_width);
  const Matrix3 jacobian = frame_.transpose() * information.jacobian * frame_;
  const Interval above(set_.above);
  const Interval below(set_.below);
  const auto highest = inverse_of(jacobian + scaled_identity(Interval(1.0) / above));
  const auto lowest = inverse_of(jacobian + scaled_identity(below));
  if (!highest || !lowest) {
    return false;
  }
  const Matrix3 noise = process_noise(amplitude);
  const auto moved = [&](const Matrix3& p) { return Matrix3(turn_ * p * turn_.transpose()); };
  if (!is_definite(Matrix3(scaled_identity(above) - moved(*highest) - noise)) ||
      !is_definite(Matrix3(moved(*lowest) + noise - scaled_identity(Interval(1.0) / below)))) {
    return false;
  }
  // With A = J + I/above, B = J + below I: I - (A^-1 + B^-1) J/2 = (A^-1/above + below B^-1)/2 and A^-1 -
  // B^-1 = A^-1 (B - A) B^-1.
  const Interval half(0.5);
  const Matrix3 centre = half * (*highest + *lowest);
  const Matrix3 product = *highest * *lowest;
  const Matrix3 spread =
      half * (below - Interval(1.0) / above) * rigor::intersection(product, product.transpose());
  const Matrix3 secant = frame_.transpose() * information.secant * frame_;
  const Matrix3 more = frame_.transpose() * information.more * frame_;
  const Interval petersen(rate.weight);
  const Matrix3 step =
      turn_ * (half * ((Interval(1.0) / above) * *highest + below * *lowest) - centre * more);
  const Matrix3 first =
      scaled_identity(square(Interval(rate.rate))) - petersen * Matrix3(secant.transpose() * spread * secant);
  const Matrix3 second = scaled_identity(Interval(1.0)) - (Interval(1.0) / petersen) * moved(spread);
  return is_definite(first, step, second);
}

bool LockFrame::verify(const LockRate& rate, std::int64_t most_cells) const {
  if (!(rate.radius > 0.0) || !(rate.rate > 0.0) || !(rate.rate < 1.0) || !(rate.weight > 0.0) ||
      !std::isfinite(rate.radius) || !std::isfinite(rate.weight)) {
    return false;
  }
  Cell whole;
  for (int i = 0; i < 3; ++i) {
    whole(i) = Interval(rate.radius) * reach(i) * rigor::symmetric(1.0);
  }
  whole(3) = problem_.offset;
  whole(4) = problem_.amplitude;
  if (!rigor::is_finite(whole) || !rigor::certainly_positive(problem_.amplitude)) {
    return false;
  }
  std::vector<Cell> open{whole};
  std::int64_t cells = 0;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    if (++cells > most_cells) {
      return false;
    }
    if (is_outside(cell, rate.radius) || verify_cell(cell, rate)) {
      continue;
    }
    // The direction along which the information changes most.
    const std::array weights{4.0, 0.5, 1.3, 1.3, 2.0 / cell(4).lower()};
    int widest = 0;
    for (int i = 1; i < 5; ++i) {
      if (weights[static_cast<std::size_t>(i)] * width(cell(i)) >
          weights[static_cast<std::size_t>(widest)] * width(cell(widest))) {
        widest = i;
      }
    }
    const Interval side = cell(widest);
    const double middle = midpoint(side);
    if (!(side.lower() < middle && middle < side.upper())) {
      return false;
    }
    for (const Interval& part :
         {Interval::from_bounds(side.lower(), middle), Interval::from_bounds(middle, side.upper())}) {
      open.push_back(cell);
      open.back()(widest) = part;
    }
  }
  return true;
}

}  // namespace veritrack::dft_block

#include "analysis/dft_block/lock_matrices.hpp"

#include <Eigen/LU>
#include <array>
#include <utility>

#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using Matrix3 = rigor::IntervalMatrix<3>;

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

}  // namespace

// To second order: with X near it and G = I - A X, A^-1 = X (I + G + G^2 (I - G)^-1).
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

bool is_definite(const Matrix3& a, const Matrix3& b, const Matrix3& c, const Matrix3& d, const Matrix3& e,
                 const Matrix3& f) {
  const std::array<std::array<const Matrix3*, 3>, 3> parts{
      {{&a, nullptr, nullptr}, {&b, &c, nullptr}, {&d, &e, &f}}};
  rigor::LowerTriangle<9> lower;
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      lower[i][j] = (*parts[i / 3][j / 3])(static_cast<int>(i % 3), static_cast<int>(j % 3));
    }
  }
  return rigor::certainly_positive_definite(lower);
}

BlockInformation information_over(const Interval& first, const Interval& turn, const Interval& error,
                                  const Interval& offset, const Interval& weight, int half_width) {
  const ToneSums sums = enclose_tone_sums(offset, error, half_width);
  const auto [sine_ratio, cosine_ratio] = turned_ratios(turn);
  const Interval x = Interval(1.0) + first;
  const Interval power = square(x);
  const Interval scale = weight * power;
  const Interval twice = Interval(2.0) * x;
  const Interval growth = Interval(2.0) + first;  // (x^2 - 1)/(x - 1)
  const Interval zero(0.0);
  BlockInformation result;
  result.jacobian << Interval(4.0) * scale * sums.value_value, zero, scale * twice * sums.value_slope, zero,
      scale * power * sums.value_value, zero, scale * twice * sums.value_slope, zero,
      scale * power * sums.slope_slope;
  result.secant << weight * twice * sums.value_value * growth,
      weight * twice * sums.value_true * cosine_ratio, weight * twice * sums.value_secant, zero,
      scale * sums.value_true * sine_ratio, zero, scale * sums.value_slope * growth,
      scale * sums.slope_true * cosine_ratio, scale * sums.slope_secant;
  const Interval mixed = sums.value_slope / sqrt(sums.value_value);
  const Interval root = sqrt(weight) * x;
  const Interval two(2.0);
  result.factor << two * root * sqrt(sums.value_value), zero, zero, zero, root * x * sqrt(sums.value_value),
      zero, root * x * mixed, zero, root * x * sqrt(sums.slope_slope - square(mixed));
  result.more = result.secant;
  result.more(0, 0) = -(weight * twice * sums.value_value * first);
  result.more(0, 2) = weight * twice * (sums.value_secant - power * sums.value_slope);
  result.more(1, 1) = scale * (sums.value_true * sine_ratio - power * sums.value_value);
  result.more(2, 0) = -(scale * sums.value_slope * first);
  result.more(2, 2) = scale * (sums.slope_secant - power * sums.slope_slope);
  return result;
}

}  // namespace veritrack::dft_block

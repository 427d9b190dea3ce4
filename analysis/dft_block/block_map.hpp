// The block tracker on a tone of constant offset and amplitude, without noise and leak: one block is a map of
// nine numbers into themselves, the same at every phase.
//
// In the coordinates of docs/block-tracker.md, section 2: errors and covariance of the prediction of a block,
// x1 relative to the tone's, the phase at the middle of the block. With the estimate x = delta + z_3 the next
// prediction is F(z + X v), F X F' + Q with X = (P^-1 + J)^-1, J = H'R^-1 H and v = H'R^-1 (h(tone) -
// h(estimate)). A test compares it with the tracker's own program.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/dft_block/tone_sums.hpp"
#include "analysis/rigor/dual.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::dft_block {

inline constexpr int kStates = 9;

/// (x1 / x1 of the tone - 1, phase error at the middle of the block in rad, offset error in bins, P_11, P_12,
/// P_13, P_22, P_23, P_33) of the prediction.
template <typename Scalar>
using BlockState = Eigen::Matrix<Scalar, kStates, 1>;

/// The design relative to the tone, and the tone.
template <typename Scalar>
struct BlockProblem {
  Scalar q1;       ///< of x1 relative to the tone's: 4 pi / amplitude times that of the design
  Scalar q2, q3;   ///< of the phase at the start of the block, rad^2, and of the offset, bins^2
  Scalar weight;   ///< amplitude^2 / (4 r)
  Scalar offset;   ///< delta of the tone, bins
  Scalar pi;       ///< an enclosure of it, or the double nearest to it
  int half_width;  ///< L of the 2L + 1 bins
};

/// s_m(x) = (-1)^m sinc(m + x) and its derivative, for m = -L ... L.
template <typename Scalar>
struct BlockTaps {
  std::vector<Scalar> value, slope;
};

[[nodiscard]] inline BlockTaps<double> block_taps(double x, int half_width) {
  using trackers::detail::kPi;
  BlockTaps<double> taps;
  for (int m = -half_width; m <= half_width; ++m) {
    const double d = x + m;
    const auto sinc = trackers::detail::sinc_with_slope(d, std::sin(kPi * d), std::cos(kPi * d));
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    taps.value.push_back(sign * sinc.value);
    taps.slope.push_back(sign * sinc.slope);
  }
  return taps;
}

/// Enclosed with their derivatives. Needs the upward mode.
template <int N>
[[nodiscard]] BlockTaps<rigor::Dual<rigor::Interval, N>> block_taps(const rigor::Dual<rigor::Interval, N>& x,
                                                                    int half_width) {
  const Taps enclosed = enclose_taps(x.value(), half_width);
  BlockTaps<rigor::Dual<rigor::Interval, N>> taps;
  for (std::size_t i = 0; i <= 2 * static_cast<std::size_t>(half_width); ++i) {
    taps.value.push_back(x.chain(enclosed.value[i], enclosed.slope[i]));
    taps.slope.push_back(x.chain(enclosed.slope[i], enclosed.bend[i]));
  }
  return taps;
}

/// The state after one more block. The phase error is not wrapped.
template <typename Scalar>
[[nodiscard]] BlockState<Scalar> block_map(const BlockState<Scalar>& state,
                                           const BlockProblem<Scalar>& problem) {
  using trackers::detail::sin_cos;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
  const Scalar x1 = Scalar(1.0) + state(0);
  const BlockTaps<Scalar> seen = block_taps(Scalar(problem.offset + state(2)), problem.half_width);
  const BlockTaps<Scalar> tone = block_taps(problem.offset, problem.half_width);
  const auto [sine, cosine] = sin_cos(Scalar(state(1)));
  Scalar values(0.0);  // sums of s(x) s(x), s(x) s'(x), s'(x) s'(x), s(x) s(delta), s'(x) s(delta)
  Scalar products(0.0);
  Scalar slopes(0.0);
  Scalar value_tone(0.0);
  Scalar slope_tone(0.0);
  for (std::size_t i = 0; i < seen.value.size(); ++i) {
    values = values + seen.value[i] * seen.value[i];
    products = products + seen.value[i] * seen.slope[i];
    slopes = slopes + seen.slope[i] * seen.slope[i];
    value_tone = value_tone + seen.value[i] * tone.value[i];
    slope_tone = slope_tone + seen.slope[i] * tone.value[i];
  }
  const Scalar power = x1 * x1;
  const Scalar twice = problem.weight * (x1 + x1);
  const Scalar scale = problem.weight * power;
  const Scalar zero(0.0);
  Matrix3 j;
  j << twice * (x1 + x1) * values, zero, twice * power * products, zero, scale * power * values, zero,
      twice * power * products, zero, scale * power * slopes;
  Eigen::Matrix<Scalar, 3, 1> v;
  v << twice * (cosine * value_tone - power * values), -(scale * sine * value_tone),
      scale * (cosine * slope_tone - power * products);
  Matrix3 p;
  p << state(3), state(4), state(5), state(4), state(6), state(7), state(5), state(7), state(8);
  const Matrix3 x = trackers::information_update(p, j);
  Eigen::Matrix<Scalar, 3, 1> z;
  for (int i = 0; i < 3; ++i) {
    z(i) = state(i) + (x(i, 0) * v(0) + x(i, 1) * v(1) + x(i, 2) * v(2));
  }
  const Scalar turn = problem.pi + problem.pi;
  const Scalar cross = x(1, 2) + turn * x(2, 2);
  const Scalar moved = problem.pi * problem.q3;
  BlockState<Scalar> next;
  next << z(0), z(1) + turn * z(2), z(2), x(0, 0) + problem.q1, x(0, 1) + turn * x(0, 2), x(0, 2),
      x(1, 1) + turn * (x(1, 2) + cross) + problem.q2 + problem.pi * moved, cross + moved,
      x(2, 2) + problem.q3;
  return next;
}

}  // namespace veritrack::dft_block

// The block tracker on a tone of constant offset and amplitude, without noise and leak: one block is a map of
// nine numbers into themselves, the same at every phase.
//
// trackers/dft_block/dft_block_ekf.hpp, with the symmetry x1 -> c x1, q1 -> c^2 q1, r -> c^4 r to a tone of
// x1 = 1. The tracker's part is its program's formulas over the reals, where pi is the double nearest to it;
// the tone's has pi itself.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "analysis/rigor/dual.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::rigor {

/// sinc d and its derivative for the tracker, from d and the sine and cosine of pi d: where d is certainly at
/// least a tenth away from zero; unknown elsewhere.
template <int N>
[[nodiscard]] trackers::detail::SincWithSlope<Dual<Interval, N>> sinc_with_slope(
    const Dual<Interval, N>& d, const Dual<Interval, N>& sine, const Dual<Interval, N>& cosine) {
  using Number = Dual<Interval, N>;
  constexpr double kLeast = 0.1;
  if (!(mignitude(d.value()) >= kLeast)) {
    Number unknown(Interval(0.0));
    unknown.make_unknown();
    return {unknown, unknown};
  }
  const Number value = sine / (Number(Interval(trackers::detail::kPi)) * d);
  return {value, (cosine - value) / d};
}

}  // namespace veritrack::rigor

namespace veritrack::dft_block {

inline constexpr int kStates = 9;

/// (x1, phase error, offset error, P_11, P_12, P_13, P_22, P_23, P_33) of the filtered estimate, x1 and P
/// relative to a tone of x1 = 1; rad and bins.
template <typename Scalar>
using BlockState = Eigen::Matrix<Scalar, kStates, 1>;

/// The design relative to a tone of x1 = 1, and the tone.
template <typename Scalar>
struct BlockProblem {
  Scalar q1, q2, q3, r;
  Scalar offset;  ///< delta of the tone, bins; no integer
  Scalar pi;      ///< an enclosure of it, or the double nearest to it
  int half;       ///< L of the 2L + 1 bins
};

/// The state after one more block.
template <typename Scalar>
[[nodiscard]] BlockState<Scalar> block_map(const BlockState<Scalar>& state,
                                           const BlockProblem<Scalar>& problem) {
  using trackers::detail::sin_cos;
  const trackers::DftBlockDesign<Scalar> design{problem.q1, problem.q2,  problem.q3,
                                                problem.r,  Scalar(0.0), Scalar(0.0)};
  trackers::DftBlockEstimate<Scalar> estimate;
  estimate.root_amplitude = state(0);
  // The true phase at the start of this block is counted as -2 pi delta, so that it is 0 at the start of the
  // next.
  const Scalar half_turn = problem.pi * problem.offset;
  estimate.phase = state(1) - (half_turn + half_turn);
  estimate.offset = state(2) + problem.offset;
  estimate.covariance << state(3), state(4), state(5), state(4), state(6), state(7), state(5), state(7),
      state(8);
  const auto [sine, cosine] = sin_cos(half_turn);
  std::vector<trackers::DftBin<Scalar>> bins;
  for (int i = 0; i <= 2 * problem.half; ++i) {
    const Scalar d = problem.offset + Scalar(static_cast<double>(problem.half - i));
    // 2 pi sinc(d) e^{j pi d} = 2 sin(pi delta) e^{j pi delta} / d
    bins.push_back({Scalar(2.0) * sine * cosine / d, Scalar(2.0) * sine * sine / d});
  }
  const std::span<const trackers::DftBin<Scalar>> seen(bins);
  const auto next = measurement_update(time_update(estimate, design), seen, design);
  BlockState<Scalar> result;
  result << next.root_amplitude, next.phase, next.offset - problem.offset, next.covariance(0, 0),
      next.covariance(0, 1), next.covariance(0, 2), next.covariance(1, 1), next.covariance(1, 2),
      next.covariance(2, 2);
  return result;
}

}  // namespace veritrack::dft_block

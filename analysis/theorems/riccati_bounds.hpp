// Bounds on the covariance P(k|k) of the Kalman filter of a linear time-varying system, from a window of N
// steps only:
//     x(i+1) = F(i) x(i) + w(i),   y(i) = H(i) x(i) + v(i),   cov w(i) = Q(i) >= 0,   cov v(i) = R(i) > 0.
//
// With Phi(k,i) = F(k-1) ... F(i), Phi(i,k) its inverse, and
//     M_i = Phi(i,k)' H(i)' R(i)^-1 H(i) Phi(i,k),   i = k-N, ..., k,      O = sum M_i   (thesis, (2.22))
//     W_j = Phi(k,j+1) Q(j) Phi(k,j+1)',             j = k-N, ..., k-1,    C = sum W_j   (thesis, (2.23))
// the thesis (section 2.4.3, after Deyst and Price 1968) uses P(k|k) <= O^-1 + C and P(k|k)^-1 <= C^-1 + O.
// The first is false for two states or more, the second for windows N >= 2. The following bounds are proved
// in docs/riccati-bounds.md:
//     P(k|k)    <= O^-1 + sum_j B_j W_j B_j',          B_j = O^-1 sum_{i<=j} M_i,
//     P(k|k)^-1 <= C^-1 + sum_i C^-1 D_i M_i D_i C^-1,  D_i = sum_{j<i} W_j.
// The first is the error covariance of an unbiased estimator that ignores everything before the window: it is
// valid for every prior on x(k-N), once the filter has processed the N + 1 measurements y(k-N), ..., y(k). A
// filter that starts with P(0|0) has done so from k = N + 1 on; one that starts with P(0|-1), from k = N. The
// second is valid for every covariance P(k-N|k-N) >= 0.
//
// All functions need the upward rounding mode. Entries that are not finite give no result.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/rigor/matrix.hpp"

namespace veritrack::theorems {

/// The largest number of states, and of outputs.
inline constexpr int kMaxStates = 4;

/// At most kMaxStates rows and columns; no allocation.
using SmallMatrix = Eigen::Matrix<rigor::Interval, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;

/// The same, known to be symmetric: both enclosures of an entry contain it.
[[nodiscard]] SmallMatrix symmetrized(const SmallMatrix& matrix);

/// A window of N >= 0 steps: N transitions with their process noise, N + 1 measurements.
struct LinearWindow {
  std::vector<SmallMatrix> transitions;         ///< F(k-N), ..., F(k-1), n x n, invertible
  std::vector<SmallMatrix> process_noises;      ///< Q(k-N), ..., Q(k-1), n x n, symmetric, >= 0
  std::vector<SmallMatrix> outputs;             ///< H(k-N), ..., H(k), m x n
  std::vector<SmallMatrix> measurement_noises;  ///< R(k-N), ..., R(k), m x m, symmetric, > 0
};

/// The terms of the two Gramians and their sums.
struct WindowGramians {
  std::vector<SmallMatrix> information;  ///< M_i, oldest first, N + 1 of them
  std::vector<SmallMatrix> noise;        ///< W_j, oldest first, N of them
  SmallMatrix observability;             ///< O
  SmallMatrix controllability;           ///< C, zero for N = 0
};

/// The Gramians of a window; nothing when a transition or a measurement noise could not be verified to be
/// invertible. Throws std::invalid_argument when the shapes or the numbers of the matrices do not fit.
[[nodiscard]] std::optional<WindowGramians> window_gramians(const LinearWindow& window);

/// O^-1 + sum_j B_j W_j B_j' >= P(k|k); nothing when O could not be verified to be invertible.
[[nodiscard]] std::optional<SmallMatrix> covariance_bound(const WindowGramians& gramians);
/// C^-1 + sum_i C^-1 D_i M_i D_i C^-1 >= P(k|k)^-1; nothing when C could not be verified to be invertible.
[[nodiscard]] std::optional<SmallMatrix> information_bound(const WindowGramians& gramians);

/// O^-1 + C, which does not bound P(k|k).
[[nodiscard]] std::optional<SmallMatrix> naive_covariance_bound(const WindowGramians& gramians);
/// C^-1 + O, which bounds P(k|k)^-1 for N = 1 only.
[[nodiscard]] std::optional<SmallMatrix> naive_information_bound(const WindowGramians& gramians);

/// An enclosure of the largest eigenvalue of the symmetric matrices in `matrix`; empty when there is none.
[[nodiscard]] rigor::Interval largest_eigenvalue(const SmallMatrix& matrix);
/// The same for the smallest.
[[nodiscard]] rigor::Interval smallest_eigenvalue(const SmallMatrix& matrix);

}  // namespace veritrack::theorems

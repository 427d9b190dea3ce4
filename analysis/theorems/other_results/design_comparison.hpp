// Theorem 3.2 of the thesis: the performance of a Kalman filter that is designed for more, or less, noise
// than the actual noise.
#pragma once

#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/riccati_bounds.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// The prediction covariances (k|k-1) of one step.
struct DesignedCovariances {
  SmallMatrix designed;   ///< P^d: what the filter computes, with Q^d and R^d
  SmallMatrix optimal;    ///< P^o: of the filter with the actual noise
  SmallMatrix performed;  ///< P^p: the error covariance of the first filter in the actual noise
};

/// k = 1, ..., N for the window's system, whose noises are the actual ones (k - N is called 0, and its
/// outputs are the first that are used); `design` contains the designed noises, in the same shape. All three
/// start from `prior` at k = 0. Empty when an innovation covariance could not be verified to be invertible.
/// Needs the upward rounding mode. Throws std::invalid_argument when the shapes do not fit.
[[nodiscard]] std::vector<DesignedCovariances> compare_designs(const LinearWindow& actual,
                                                               const LinearWindow& design,
                                                               const SmallMatrix& prior);

/// id "theorem-3.2": the orders P^o <= P^p <= P^d and P^d <= P^o <= P^p over the first steps of the tracker's
/// linearisation at |z| = 1, with the design compared with half and with twice its noise. Opens its own
/// UpwardRounding scope.
[[nodiscard]] Derivation evaluate_theorem_3_2(const TrackerInput& input);

/// id "theorem-3.2/any-start": the theorem as printed does not require an order of the starts, and fails
/// without one. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_theorem_3_2_any_start();

}  // namespace veritrack::theorems

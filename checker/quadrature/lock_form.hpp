// The matrix of docs/gaussian.md, (6), and the bound that a matrix of this form gives.
//
// Rows: T e+ (3), the noise (2), the rest (1). With N the matrix at a point, for one multiplier mu,
//     left over = pivot of the last row + log(product of the noise's two pivots) + log(1 - w^2 |T e3|^2),
// pivots of elimination from the first row on. If the first five are positive, this is at most
//     l - m'(M^-1 - Sigma)^-1 m + log det(I - Sigma M)
// for every covariance between the two images: by Petersen's lemma the matrix of such a covariance is at
// least N in the Loewner order, Schur complements grow with their matrix, and
//     log det(I - Sigma M) = log(1 - w^2 |T e3|^2) + log det(Schur complement of the noise's rows).
//
// It is concave in N: Schur complements are concave in the Loewner order, and log det is concave and grows
// with its matrix. So where N is affine over a box, plus something concave in its last entry, the corners of
// the box decide.
#pragma once

#include <cstddef>

#include "checker/quadrature/lock_step.hpp"
#include "checker/quadrature/over_box.hpp"

namespace veritrack::checker::lock_form {

constexpr std::size_t kSize = 6;
enum Row : std::size_t { kError = 0, kNoise = 3, kRest = 5 };

/// The entries without their constants and without the multiplier: T Delta T', sigma (T Psi Z)'/r, Z'Delta Z,
/// (T m)', (Z'Delta Z p)', p'Z'Delta Z p. `step` at the level s_0, and how that changes with s.
struct Parts {
  ChordMatrix<kSize> value, slope;
};
Parts parts_of(const LockStep& step, const Metric& next, const Ball& deviation, const Ball& r);

/// The factor of each entry, for a multiplier mu.
template <typename S>
struct Factors {
  S error, noise, pulled, rest;
};
template <typename S>
Factors<S> factors_of(const S& multiplier, const S& deviation, const S& r) {
  const S by_rest = multiplier / (r * r);
  return {S(-1.0) / multiplier, S(-1.0) * by_rest * deviation * deviation, by_rest * deviation,
          S(-1.0) * by_rest};
}
/// The factor of the entry (i, j), j <= i; null when it is 1.
template <typename S>
const S* factor_at(const Factors<S>& factors, std::size_t i, std::size_t j) {
  if (i < kNoise) {
    return &factors.error;
  }
  if (i < kRest) {
    return j < kNoise ? nullptr : &factors.noise;
  }
  return j < kNoise ? nullptr : j < kRest ? &factors.pulled : &factors.rest;
}

/// "left over" without the constant log(1 - w^2 |T e3|^2), at a point. A ball of everything when a pivot is
/// not certainly positive.
Ball left_over(SquareMatrix<kSize> n);

}  // namespace veritrack::checker::lock_form

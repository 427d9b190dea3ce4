// The certificate for Gaussian noise, continued: the mean square of the frequency error while in lock.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

namespace veritrack::quadrature {

/// The quantity of the derivation: what its root mean square falls to as the samples become more.
inline constexpr const char* kRmsWithoutStart = "rms_frequency_error_without_start";

struct MeanSquareCertificate {
  /// "mean-square": the conditions, and what follows from them.
  theorems::Derivation derivation;
  /// One for each set of the LockCertificate when all are proved; otherwise empty.
  std::vector<LockMeanSquare> mean_squares;
  std::int64_t cells = 0;
};

/// Searches and verifies, for the sets that were proved. Sets its own rounding mode.
[[nodiscard]] MeanSquareCertificate certify_mean_square(const LockQuestion& question,
                                                        const LockCertificate& lock);

/// An upper bound on the root of sum E[nu^2; lock]/N over any N successive samples, rad/sample, for starts of
/// a level of at most `start_level`: docs/gaussian.md, (8). The mean square must have been verified. Needs
/// the upward mode.
[[nodiscard]] rigor::Interval root_mean_square(const LockSet& set, const LockMeanSquare& mean_square,
                                               const rigor::Interval& start_level,
                                               const rigor::Interval& samples);

}  // namespace veritrack::quadrature

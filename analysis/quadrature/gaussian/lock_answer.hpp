// The answer to a question about Gaussian noise: with sets for the assumed noise, or for more.
#pragma once

#include <optional>

#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "analysis/quadrature/gaussian/mean_square_certificate.hpp"

namespace veritrack::quadrature {

struct LockAnswer {
  LockCertificate lock;
  std::optional<MeanSquareCertificate> mean_square;  ///< where it was asked for
};

/// Of sets for the question the first that do all that is required (`probability`, `required_rms`): those for
/// its own noise, and those for more, whose starts lie nearer to the middle. A set for more noise is one for
/// less, so that what is proved at a lower signal-to-noise ratio is proved at a higher one; the ratios that
/// are tried, and with a leak the borders of the pieces, do not depend on the question. Where none does all,
/// the sets for its own noise. Deterministic. Sets its own rounding mode.
[[nodiscard]] LockAnswer answer_lock(const LockQuestion& question, bool with_mean_square);

}  // namespace veritrack::quadrature

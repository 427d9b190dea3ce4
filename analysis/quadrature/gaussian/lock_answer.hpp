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

/// The first sets that meet all requirements of the question (`probability`, `required_rms`): sets for its
/// own noise are tried, then sets for more, in which the starts lie nearer to the middle. A set for more
/// noise is also one for less, so a proof at a lower signal-to-noise ratio is valid at a higher one; the
/// ratios that are tried, and with a leak the borders of the pieces, do not depend on the question. Where no
/// sets meet all requirements, the sets for its own noise. Deterministic. Sets its own rounding mode.
[[nodiscard]] LockAnswer answer_lock(const LockQuestion& question, bool with_mean_square);

}  // namespace veritrack::quadrature

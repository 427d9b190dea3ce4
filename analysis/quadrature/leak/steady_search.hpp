// Sets around the steady state: proposed and verified, the largest first. With a leak.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/leak/steady_pieces.hpp"
#include "analysis/quadrature/leak/steady_verification.hpp"
#include "analysis/sets/contraction_question.hpp"

namespace veritrack::quadrature {

/// The result for a question.
struct SteadySearch {
  bool shaped = false;                    ///< sampling found a shape to try at all
  std::optional<SteadyVerification> set;  ///< PROVED for the assumed noise and slew, or the last attempt
  /// Certified for more noise than `set`, without slew, of one level: over pieces of the band, or one set.
  std::vector<SteadyPiece> noise_sets;
  std::optional<SteadySet> slew_set;  ///< certified for more slew than `set`, without noise, of one level
  /// Certified for the assumed noise and no slew over pieces of the band, each with larger frequency errors
  /// than `set`.
  std::vector<SteadyPiece> radius_sets;
  [[nodiscard]] bool found() const;  ///< `set` is PROVED
  /// Certified without slew, relative to the amplitude; zero when none is.
  [[nodiscard]] double largest_noise() const;
  /// Certified without noise, rad/sample per sample; zero when none is.
  [[nodiscard]] double largest_slew() const;
};

/// Tries sets from the largest that sampling can imagine down. The branch must be PROVED. Opens its own
/// rounding scopes; deterministic.
[[nodiscard]] SteadySearch search_steady_sets(const sets::ContractionQuestion& question,
                                              const sets::LockBranch& branch);

}  // namespace veritrack::quadrature

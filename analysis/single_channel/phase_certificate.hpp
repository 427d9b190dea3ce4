// The contraction certificate of the single-channel tracker without a leak: over all phases and a band of
// frequencies. docs/single-channel.md, section 4.
#pragma once

#include <optional>

#include "analysis/sets/kalman_filter_result.hpp"
#include "analysis/single_channel/phase_sets.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::single_channel {

/// Whether the assumed starts lie in a certified set.
struct StartFinding {
  enum class Kind {
    in_set,
    covariance_is_given,  ///< a given P(0) is not covered
    outside
  };
  Kind kind = Kind::outside;
  double level_seen = 0.0;  ///< of the assumed starts, approximately
};

struct PhaseCertificate {
  /// id "contraction"; the quantities of `result`; conditions leak, controllable-amplitude, invariant-set,
  /// and start-in-set, which is without words.
  theorems::Derivation derivation;
  sets::KalmanFilterResult result;
  std::optional<StartFinding> start;  ///< the reason of start-in-set, where there is a set
  std::optional<PhaseSet> set;        ///< the largest start error under the assumed noise and slew
  std::optional<PhaseSet> bound_set;  ///< the least bound from the assumed starts on
  std::optional<PhaseSet> noise_set;  ///< the largest noise, without slew
  std::optional<PhaseSet> slew_set;   ///< the largest slew, without noise
};

/// Proposes, verifies and reports. Never throws for invalid numbers: a number that is not finite proves
/// nothing. Opens its own UpwardRounding scope.
[[nodiscard]] PhaseCertificate certify_over_phases(const PhaseQuestion& question);

}  // namespace veritrack::single_channel

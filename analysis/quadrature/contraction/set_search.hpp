// From a question to a certified set: proposals on a ladder, and the first that verifies.
#pragma once

#include <optional>

#include "analysis/quadrature/contraction/proposal.hpp"
#include "analysis/quadrature/contraction/verification.hpp"
#include "analysis/sets/contraction_question.hpp"

namespace veritrack::quadrature {

/// The set for an objective: the best proposal on a ladder of fractions that verifies, and that tolerates the
/// assumed noise and slew where the objective does not set them; nothing when none does. `settled_error`
/// (rad/sample) is that of Objective::settling. Proposes in the rounding mode of the filter; the verification
/// opens its own.
[[nodiscard]] std::optional<Verification> find_set(const sets::ContractionQuestion& question,
                                                   Objective objective, double settled_error = 0.0);

/// A set that by itself proves all of `question.required`, with as few cells as sampling promises; nothing
/// when none is found, or nothing is required.
[[nodiscard]] std::optional<Verification> find_sufficient_set(const sets::ContractionQuestion& question);

/// `noisy`, which tolerates the assumed noise without slew, as a set for the assumed noise and slew: the
/// margin that the noise leaves goes to the slew. Nothing when it does not verify.
[[nodiscard]] std::optional<Verification> with_slew(const sets::ContractionQuestion& question,
                                                    const CertifiedSet& noisy);

/// A set with a small ultimate frequency error into which `outer` is mapped (certainly_maps_into): the
/// second part of a guarantee for starts that are far from zero. Nothing when none is found.
[[nodiscard]] std::optional<Verification> find_inner_set(const sets::ContractionQuestion& question,
                                                         const CertifiedSet& outer);

}  // namespace veritrack::quadrature

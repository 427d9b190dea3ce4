// The member "gains" of a certificate for a loop whose errors depend on the phase, and what it establishes
// (docs/gain-proof.md, section 10).
#pragma once

#include <memory>

#include "checker/document/statement.hpp"
#include "checker/model/gain/phase_bounds.hpp"
#include "checker/model/model_design.hpp"

namespace veritrack::checker {

/// Objects where nothing can be said by such gains, and returns nothing then. `rounding`: of the design's
/// code; or empty.
std::unique_ptr<PhaseBounds> read_phase_gains(const Tree& gains, const TrackedModel& model,
                                              const ModelDesign& design, const RoundingOfStep& rounding,
                                              Objections& objections);

}  // namespace veritrack::checker

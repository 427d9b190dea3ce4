// What both extended Kalman filters do when they are tuned, around what each certifies by itself.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "analysis/sets/contraction_result.hpp"
#include "certificates/tuning/design_text.hpp"
#include "certificates/tuning/value_search.hpp"

namespace veritrack::certificates {

/// What a contraction certificate says, as the search judges it.
[[nodiscard]] CertifiedValues values_of(const sets::ContractionResult& result, const Requirements& require);

/// Simulates the design when that is needed.
void add_simulated(const Design& design, const Assumptions& assume, const std::set<Objective>& needed,
                   CertifiedValues& found);

/// Searches, and writes the result into the text of the design file; `edits` says how values stand there.
[[nodiscard]] TuningResult tuned_file(
    const TuningProblem& problem, const TuningRequest& request,
    const std::function<std::vector<DesignEdit>(const DesignValues&)>& edits);

}  // namespace veritrack::certificates

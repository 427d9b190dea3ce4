// The assertions of chapter 5 of the thesis about the loop that it regulates: the disturbance, the
// polynomials, the ideal controller, and least squares in the long run, lemma 5.3 and corollary 5.2.1.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Sections 5.2.2 to 5.2.4 and 5.4, with ids "chapter-5/...". No design enters. Needs the upward mode.
[[nodiscard]] std::vector<Statement> vibration_model_claims();

/// Sections 5.2.5 and 5.3, with ids "chapter-5/...". No design enters. Needs the upward mode.
[[nodiscard]] std::vector<Statement> parameter_convergence_claims();

}  // namespace veritrack::theorems

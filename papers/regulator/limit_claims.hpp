// The assertions of sections 5.3 and 5.4 of the thesis about the limiting controllers of the self-tuning
// regulator, decided for the printed ones (Tables 5.1 and 5.2), as statements with verdicts.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::regulator {

/// The loops that they close: stability, gains, sensitivity, beside the ideal one. Ids
/// "chapter-5/limits/...". Needs the upward mode.
[[nodiscard]] std::vector<theorems::Statement> limit_loop_claims();

/// Their polynomials: multiples of the ideal ones, poles, and the requirement of the internal model
/// principle. Ids "chapter-5/limits/..." and "chapter-5/internal-model/...". Needs the upward mode.
[[nodiscard]] std::vector<theorems::Statement> limit_polynomial_claims();

}  // namespace veritrack::regulator

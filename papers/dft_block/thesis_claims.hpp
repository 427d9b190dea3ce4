// The assertions of chapter 4 of the thesis about its filter bank, its noise, observability, tuning and
// initial estimates, as statements with verdicts, beside papers/claims/block_transform_claims.hpp. They do
// not depend on a design.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::dft_block {

/// Section 4.2: the filter bank, the second term of (4.5), (4.10) and (4.32). Ids "chapter-4/...". Needs the
/// upward mode, as all of these do.
[[nodiscard]] std::vector<theorems::Statement> filter_bank_claims();

/// Sections 4.2.1 to 4.3.1: the rows that are not zero, the ambiguity of the outputs, and the square root of
/// (4.12).
[[nodiscard]] std::vector<theorems::Statement> model_output_claims();

/// Section 4.3.1: (4.26) and its rank, and the information in one pair of outputs.
[[nodiscard]] std::vector<theorems::Statement> observability_claims();

/// Sections 4.4 and 4.5.1: (4.33) and (4.34), the size of T, Tables 4.1 and 4.2.
[[nodiscard]] std::vector<theorems::Statement> tuning_claims();

/// Section 4.5.2: the estimator (4.35), its bias and its variance.
[[nodiscard]] std::vector<theorems::Statement> initial_estimate_claims();

}  // namespace veritrack::dft_block

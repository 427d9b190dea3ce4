// The statements of theorem_2_9_gaps.hpp by subject, and their shared helpers. All need the upward rounding
// mode.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/statements/statement.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems::gaps {

/// One reading of the theorem, evaluated.
struct Reading {
  std::string name;  ///< "printed" or "errata"
  Theorem29Constants constants;
};

/// The design in both readings.
struct Readings {
  Theorem29Input input;  ///< with finite members only
  std::array<Reading, 2> each;

  [[nodiscard]] const Theorem29Constants& printed() const { return each[0].constants; }
};

/// The range of |z|, z = x1 + i x2 of an estimate.
struct EstimateRange {
  rigor::Interval smallest, largest;
};

/// The estimates that the errata sheet admits (to pages 67 and 68: eps_r in (0, 1), sigma "arbitrarily
/// small"). Our reading: sigma is small against (1 - eps_r)^2, that is 2 sigma <= (1 - eps_r)^2. So a claim
/// of the sheet about every error with |e| <= eps_r is about every estimate with |z| in [sqrt(2 sigma), 2 -
/// sqrt(2 sigma)]. Empty unless it is certain that 0 < 2 sigma < 1.
[[nodiscard]] EstimateRange admitted_estimates(const Theorem29Input& input);

/// "theorem-2.9/<place>", followed by "/<reading>" unless that is empty.
[[nodiscard]] std::string gap_id(const std::string& place, const std::string& reading = "");

/// A quantity of the evidence.
[[nodiscard]] Quantity evidence(std::string name, std::string symbol, std::string formula,
                                const rigor::Interval& value);

/// Sections 2.4.1 and 3.5: the Gramians, the range of w_3, R_x.
[[nodiscard]] std::vector<Statement> gramian_gaps(const Readings& readings);
/// Section 2.4.3: the derivatives of f, the remainders, the sign of kappa_f.
[[nodiscard]] std::vector<Statement> derivative_gaps(const Readings& readings);
/// Section 2.4.3 and Theorem 2.8: covariances, the Lyapunov recursion, Lemma 3.1.
[[nodiscard]] std::vector<Statement> covariance_gaps(const Readings& readings);
/// Theorem 2.7, Lemmas 2.3 to 2.5 and the conclusion of Theorem 2.9.
[[nodiscard]] std::vector<Statement> perturbation_gaps(const Readings& readings);

}  // namespace veritrack::theorems::gaps

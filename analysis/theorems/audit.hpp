// The constants of Theorem 2.9 compared with a simulated trajectory.
//
// A simulation proves nothing about other trajectories, but one violated inequality refutes the claim that
// the constant is a bound. Every inequality is evaluated in intervals at every step: it
// counts as satisfied or as violated only when that is certain for the numbers recorded, and as undecided
// otherwise (NaN, say).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/rigor/verdict.hpp"
#include "analysis/statements/trajectory.hpp"
#include "analysis/theorems/theorem_2_9.hpp"

namespace veritrack::theorems {

/// One inequality at one step.
struct AuditPoint {
  std::size_t step = 0;
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< of this inequality at this step only
  rigor::Interval margin;           ///< bound - value for an upper bound, value - bound for a lower one
  rigor::Interval relative_margin;  ///< the margin over |bound|; empty when the bound may be 0
};

/// Whether the source assumes the inequality or claims it.
enum class AuditKind { assumption, claim };

/// One inequality along the trajectory.
struct AuditedInequality {
  std::string id;         ///< mostly the constant's name in certificate.json, e.g. "rho_1"
  std::string statement;  ///< LaTeX, e.g. "P(k|k) \\le p I" with \\mid for the bar
  std::string source;
  AuditKind kind = AuditKind::claim;
  /// The first step for which the source claims it: 0, or 1 for bounds that need the window N = 1.
  std::size_t first_step = 0;
  std::size_t satisfied = 0;  ///< number of steps, from first_step on; so are the next two
  std::size_t violated = 0;
  std::size_t undecided = 0;
  /// The step with the least lower end of the margin, among the steps with a finite one.
  std::optional<AuditPoint> worst;
  std::optional<std::size_t> first_violation;
  /// Step 0, if first_step is 1 although the proof uses the bound at step 0.
  std::optional<AuditPoint> before_first_step;
  /// Set when the bound does not exist for the design; nothing is then counted.
  std::optional<std::string> not_applicable;

  [[nodiscard]] std::size_t steps_checked() const noexcept { return satisfied + violated + undecided; }
};

struct Audit {
  std::vector<AuditedInequality> inequalities;
  /// Up to this step, exclusively, every assumption is certainly satisfied at every step.
  std::size_t steps_within_assumptions = 0;

  /// True when a claim is violated at a step up to which all assumptions are satisfied: the constant is not
  /// the bound that the source claims.
  [[nodiscard]] bool refutes(const AuditedInequality& inequality) const noexcept {
    return inequality.kind == AuditKind::claim && inequality.first_violation.has_value() &&
           *inequality.first_violation < steps_within_assumptions;
  }
};

/// Audits every constant that is a bound along a trajectory. `theorem` is what evaluate_theorem_2_9
/// returned for `input`. The inequalities on z are along the trajectory of (2.34) that starts within (2.45),
/// in the direction of e(0|0); it is recomputed in double, and each of its steps is evaluated in intervals
/// from the doubles it starts from. Opens its own UpwardRounding scope. About 0.1 ms a step.
[[nodiscard]] Audit audit_theorem_2_9(const Theorem29& theorem, const Theorem29Input& input,
                                      const Trajectory& trajectory);

/// The inequality of that id. Throws std::out_of_range when there is none.
[[nodiscard]] const AuditedInequality& find_inequality(const Audit& audit, const std::string& id);

}  // namespace veritrack::theorems

// The search for q1, q2, r and the leak of an extended Kalman filter: NLopt over what a column certifies.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "certificates/document/tuning.hpp"
#include "certificates/tuning/design_values.hpp"
#include "certificates/tuning/objective.hpp"

namespace veritrack::certificates {

/// The data of a column on its tracker.
struct TuningProblem {
  const Assumptions* assume = nullptr;
  const Requirements* require = nullptr;
  DesignValues given;
  Objective objective = Objective::long_run;
  bool free_leak = false;
  /// The requested numbers of these values, under assumptions that need not be those of the design. Opens its
  /// own rounding scopes.
  std::function<CertifiedValues(const DesignValues&, const Assumptions&, const std::set<Objective>&)> certify;
  /// The design with these values, whatever the text of its file.
  std::function<Design(const DesignValues&)> design_with;
};

/// The result of the search.
struct TuningOutcome {
  DesignValues chosen;
  CertifiedValues before;    ///< of the given values
  CertifiedValues after;     ///< of the chosen ones
  bool is_met = false;       ///< everything required and the assumed starts, as far as they are examined here
  bool was_stopped = false;  ///< by the deadline
  int looked_at = 0;
  std::vector<std::string> changes;  ///< TuningResult::changes
  TradeOff trade_off;
};

/// From the given values and from the Kalman filter of the assumed noise and slew or walk: the best values
/// that a local search (Sbplx) finds, required things first. r becomes the variance of the assumed noise in a
/// channel, which changes no estimate when q1, q2 and P(0|0) go with it; where P(0|0) is given in numbers, r
/// is searched for, too. Deterministic unless the deadline ends it.
[[nodiscard]] TuningOutcome search_values(const TuningProblem& problem, const TuningRequest& request);

/// The objective of that name, or the first that fits the noise when the name is empty. Throws RequestError
/// for one that does not fit the assumed noise.
[[nodiscard]] Objective chosen_objective(const std::string& name, const Assumptions& assume);

/// The sentences of the outcome: the gain, and the necessary remarks.
[[nodiscard]] std::vector<std::string> notes_of(const TuningProblem& problem, const TuningOutcome& outcome);

}  // namespace veritrack::certificates

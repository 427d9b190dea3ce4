// The common steps of tuning both extended Kalman filters, around what each certifies by itself.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "analysis/sets/kalman_filter_result.hpp"
#include "certificates/tuning/design_text.hpp"
#include "certificates/tuning/value_search.hpp"

namespace veritrack::certificates {

/// The numbers of a contraction certificate by which the search judges it.
[[nodiscard]] CertifiedValues values_of(const sets::KalmanFilterResult& result, const Requirements& require);

/// Simulates the design when that is needed.
void add_simulated(const Design& design, const Assumptions& assume, const std::set<Objective>& needed,
                   CertifiedValues& found);

/// The form of values in the text of a design file.
using DesignEdits = std::function<std::vector<DesignEdit>(const DesignValues&)>;

/// Searches, and writes the result into the text of the design file.
[[nodiscard]] TuningResult tuned_file(const TuningProblem& problem, const TuningRequest& request,
                                      const DesignEdits& edits);

/// The data of a column on its tracker; `Tables` are those of its design file.
template <typename Tables>
struct TunedColumn {
  DesignValues given;
  /// Writes values into [design].
  std::function<void(const DesignValues&, Tables&)> put;
  /// The requested numbers of a design, except simulations. Opens its own rounding scopes.
  std::function<CertifiedValues(const Design&, const std::set<Objective>&)> certify;
  DesignEdits edits;
};

/// The design that is best in the requested objective, whatever its tracker.
template <typename Tables>
[[nodiscard]] TuningResult tuned(const Design& design, const TuningRequest& request,
                                 const TunedColumn<Tables>& column) {
  const Tables& tables = tables_of<Tables>(design);
  const auto design_with = [&](const DesignValues& values, const Assumptions& assume) {
    Design changed = design;
    Tables other = tables;
    column.put(values, other);
    other.assume = assume;
    changed.tables = other;
    return changed;
  };
  TuningProblem problem;
  problem.assume = &tables.assume;
  problem.require = &tables.require;
  problem.given = column.given;
  problem.objective = chosen_objective(request.objective, tables.assume);
  problem.free_leak = request.free_leak;
  const bool with_proofs = asks_for_proofs(problem.objective, tables.require);
  problem.design_with = [&](const DesignValues& values) { return design_with(values, tables.assume); };
  problem.certify = [&](const DesignValues& values, const Assumptions& assume,
                        const std::set<Objective>& needed) {
    const Design changed = design_with(values, assume);
    CertifiedValues found = with_proofs ? column.certify(changed, needed) : CertifiedValues();
    add_simulated(changed, assume, needed, found);
    return found;
  };
  return tuned_file(problem, request, column.edits);
}

}  // namespace veritrack::certificates

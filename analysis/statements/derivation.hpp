// A published theorem evaluated for a design: named quantities with enclosures, and conditions with verdicts.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::theorems {

/// In which way the value of a quantity is to be read.
enum class Sense {
  enclosure,  ///< the quantity lies in it
  equal,      ///< the quantity is it: a count, or a chosen number
  at_most,    ///< the quantity is a bound from above, at most the upper end
  at_least,   ///< the quantity is a bound from below, at least the lower end
  sampled     ///< a search, a solver or a simulation gave it: no enclosure of anything
};

/// One constant of a theorem, evaluated for a design.
struct Quantity {
  std::string name;     ///< as in certificate.json, e.g. "rho_1"
  std::string symbol;   ///< LaTeX, as the source writes it, e.g. "\\rho_1"
  std::string formula;  ///< LaTeX, the right-hand side, e.g. "2(R_x + \\epsilon_r)"
  std::string source;   ///< the place of the formula, e.g. "thesis, section 3.5"
  rigor::Interval value;
  /// Set when the quantity does not exist for this design (a division by q1 = 0, say): the reason, as a
  /// sentence. The value is then empty.
  std::optional<std::string> not_applicable;
  Sense sense = Sense::enclosure;
  /// A description for a reader, with the unit; empty where only the source's symbol describes it.
  std::string words = {};

  [[nodiscard]] bool applies() const { return !not_applicable; }
  [[nodiscard]] bool is_proved() const { return sense != Sense::sampled; }
};

/// One hypothesis of a theorem, lhs < rhs, decided for a design.
struct Condition {
  std::string id;         ///< the source's equation number, e.g. "2.43"
  std::string statement;  ///< LaTeX, e.g. "\\beta(\\zeta + \\eta) + \\alpha < 1"
  rigor::Verdict verdict = rigor::Verdict::undecided;
  rigor::Interval lhs;
  rigor::Interval rhs;
  std::string reason;  ///< one sentence: the reason for the verdict, or why there is none
  Sense lhs_sense = Sense::enclosure;
};

/// Is there any admissible choice of the theorem's free parameters that satisfies its stability conditions?
struct Feasibility {
  /// PROVED: yes, with the point as witness. REFUTED: no, by the argument and the lower bound.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string argument;       ///< plain sentences
  bool every_design = false;  ///< REFUTED for every design, not only for this one
  /// A lower bound on the left-hand side of the condition over all admissible points.
  std::optional<rigor::Interval> lower_bound;
  std::vector<Quantity> witness;     ///< a point that satisfies the conditions
  std::vector<Quantity> best_found;  ///< the least left-hand side that a search found, and its point
};

/// Exact numbers from which a part of a derivation can be verified without the search that found it: the
/// names are explained in docs/certificate-format.md.
struct Evidence {
  std::string name;  ///< its purpose, e.g. "start"
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::pair<std::string, rigor::DynamicMatrix>> matrices;
  std::vector<std::pair<std::string, std::string>> decimals = {};  ///< as a sentence says them
};

/// A theorem, in one reading of its text, evaluated for a design.
struct Derivation {
  std::string id;     ///< e.g. "theorem-2.9/printed"
  std::string title;  ///< one line
  std::vector<Quantity> quantities;
  std::vector<Condition> conditions;
  std::vector<std::string> notes;  ///< further sentences, e.g. which of our choices were used
  /// The conjunction of all conditions.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  /// Only for a theorem with free parameters.
  std::optional<Feasibility> feasibility;
  std::vector<Evidence> evidence;
};

/// The quantity of that name. Throws std::out_of_range when there is none.
[[nodiscard]] const Quantity& find_quantity(const Derivation& derivation, const std::string& name);

/// The quantity of that name if it exists and applies; otherwise null.
[[nodiscard]] const Quantity* applicable_quantity(const Derivation& derivation, std::string_view name);

}  // namespace veritrack::theorems

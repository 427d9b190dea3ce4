#include "analysis/theorems/theorem_2_9_gaps.hpp"

#include <iterator>
#include <utility>

#include "analysis/statements/paper_findings.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"

namespace veritrack::theorems {

namespace gaps {

std::string gap_id(const std::string& place, const std::string& reading) {
  return "theorem-2.9/" + place + (reading.empty() ? "" : "/" + reading);
}

Quantity evidence(std::string name, std::string symbol, std::string formula, const rigor::Interval& value) {
  return {std::move(name), std::move(symbol), std::move(formula), "our own evaluation", value, std::nullopt};
}

}  // namespace gaps

std::vector<Statement> theorem_2_9_gaps(const Theorem29Input& input) {
  const rigor::UpwardRounding upward;
  const gaps::Readings readings{with_finite_members(input),
                                {{{"printed", theorem_2_9_constants(Theorem29Variant::printed, input)},
                                  {"errata", theorem_2_9_constants(Theorem29Variant::errata, input)}}}};
  std::vector<Statement> statements;
  for (auto* part :
       {gaps::gramian_gaps, gaps::derivative_gaps, gaps::covariance_gaps, gaps::perturbation_gaps}) {
    std::vector<Statement> found = part(readings);
    statements.insert(statements.end(), std::make_move_iterator(found.begin()),
                      std::make_move_iterator(found.end()));
  }
  cite_findings(statements);
  return statements;
}

}  // namespace veritrack::theorems

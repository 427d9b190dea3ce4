#include "certificates/single_channel/phase_words.hpp"

#include <fmt/format.h>

#include <string>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates {

namespace {

std::string reason_of(const single_channel::StartFinding& start, const rigor::Interval& set_level) {
  using Kind = single_channel::StartFinding::Kind;
  switch (start.kind) {
    case Kind::in_set:
      return "every assumed start lies in a certified set.";
    case Kind::covariance_is_given:
      return "a given P(0) is not covered; omit initial_covariance to start with the steady state.";
    case Kind::outside:
      break;
  }
  return fmt::format(
      "the assumed starts have level about {}; the certified set of starts has level {}. Smaller start "
      "errors or a narrower [assume] frequency would help.",
      rigor::to_decimal(start.level_seen, 3, rigor::Direction::up), rigor::lower_decimal(set_level));
}

}  // namespace

void add_words(single_channel::PhaseCertificate& found) {
  if (!found.start) {
    return;
  }
  for (theorems::Condition& condition : found.derivation.conditions) {
    if (condition.id == "start-in-set") {
      condition.statement = "e(0)' P(0)^{-1} e(0) \\le R_0^2";
      condition.reason = reason_of(*found.start, condition.rhs);
    }
  }
  found.result.starts.conditions = found.derivation.conditions;
}

}  // namespace veritrack::certificates

#include "certificates/quadrature/coq_quadrature.hpp"

#include "certificates/document/coq_parts.hpp"
// Theorem 2.9 of the quadrature tracker in Coq: its constants, and the conditions that fail.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "certificates/document/coq_numbers.hpp"
#include "certificates/quadrature/coq_ekf.hpp"
#include "certificates/quadrature/coq_ekf_numbers.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates::coq {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The quantities of the derivation that the Coq text defines under the same name.
constexpr std::array<const char*, 21> kConstants{"epsilon_r",
                                                 "rho_1",
                                                 "rho_2",
                                                 "b_1",
                                                 "b_2",
                                                 "p",
                                                 "q",
                                                 "s",
                                                 "gamma",
                                                 "beta",
                                                 "one_minus_alpha",
                                                 "epsilon_z",
                                                 "delta_p",
                                                 "delta_k",
                                                 "delta_k2",
                                                 "zeta_z",
                                                 "eta",
                                                 "zeta",
                                                 "lhs_2_43",
                                                 "lhs_2_44",
                                                 "initial_error_bound"};

/// The design at unit amplitude, in Coq.
std::string design_term(const QuadratureEkfTables& tables) {
  const std::string amplitude = decimal(tables.assume.amplitude.text);
  const auto at_unit_amplitude = [&](const Number& variance) {
    return amplitude == "1" ? decimal(variance.text)
                            : fmt::format("{} / {} ^ 2", decimal(variance.text), amplitude);
  };
  const Theorem29Parameters& free = tables.theorem_2_9;
  return fmt::format(
      "\n(* The design. *)\nDefinition here : design := {{|\n  q1 := {}; q2 := {}; r := {};\n  state_bound "
      ":= {}; sigma := {}; gamma_fraction := {}; c1 := {}; c2 := {} |}}.\n",
      at_unit_amplitude(tables.design.q1), decimal(tables.design.q2.text), at_unit_amplitude(tables.design.r),
      decimal(free.state_bound.text), decimal(free.sigma.text), decimal(free.gamma_fraction.text),
      decimal(free.c1.text), decimal(free.c2.text));
}

/// |e_0| for the largest assumed errors: see theorems::largest_initial_error. Empty when the phase error is
/// not certainly below half a turn.
std::string initial_error_term(const Assumptions& assume) {
  if (!rigor::certainly_less(assume.initial_phase_error.value, Interval(3.0))) {
    return "";
  }
  const std::string amplitude_error =
      fmt::format("({} / {})", decimal(assume.initial_amplitude_error.text), decimal(assume.amplitude.text));
  const Number& frequency_error = assume.initial_frequency_error;
  const std::string frequency =
      !frequency_error.in_hertz
          ? decimal(frequency_error.text)
          : fmt::format("(2 * PI * {} / {})",
                        decimal(frequency_error.text.substr(0, frequency_error.text.find(' '))),
                        decimal(assume.sample_rate.value().text));
  return fmt::format("sqrt ({0} ^ 2 + 4 * (1 + {0}) * sin ({1} / 2) ^ 2 + {2} ^ 2)", amplitude_error,
                     decimal(assume.initial_phase_error.text), frequency);
}

void prove_constants(Proofs& proofs, const theorems::Derivation& derivation, const std::string& reading) {
  for (const char* name : kConstants) {
    const theorems::Quantity* quantity = applicable_quantity(derivation, name);
    if (quantity == nullptr || !rigor::is_finite(quantity->value)) {
      continue;
    }
    proofs.prove(fmt::format("{}_{}_enclosed", reading, name),
                 encloses(quantity->value, fmt::format("{} {} here", name, reading)), "evaluate here.",
                 derivation.id, "The constants lie in the enclosures that are printed.");
  }
}

/// The condition of that number as it was decided: constant < other, or the other way round.
struct ConditionTerms {
  std::string id;
  std::string constant;  ///< one of kConstants
  std::string other;
  bool constant_is_left = true;
};

void prove_condition(Proofs& proofs, const theorems::Derivation& derivation, const std::string& reading,
                     const ConditionTerms& terms) {
  const auto condition = std::find_if(derivation.conditions.begin(), derivation.conditions.end(),
                                      [&](const theorems::Condition& one) { return one.id == terms.id; });
  if (condition == derivation.conditions.end() || condition->verdict == Verdict::undecided) {
    return;
  }
  const bool holds = condition->verdict == Verdict::proved;
  const std::string constant = fmt::format("{} {} here", terms.constant, reading);
  const std::string& lhs = terms.constant_is_left ? constant : terms.other;
  const std::string& rhs = terms.constant_is_left ? terms.other : constant;
  std::string number = terms.id;
  std::replace(number.begin(), number.end(), '.', '_');
  proofs.prove(fmt::format("{}_condition_{}_{}", reading, number, holds ? "holds" : "fails"),
               holds ? lhs + " < " + rhs : rhs + " <= " + lhs,
               fmt::format("generalize {}_{}_enclosed. generalize ({}). intros constant enclosed.\n"
                           "interval with (i_prec 180).",
                           reading, terms.constant, constant),
               derivation.id + "/" + terms.id,
               fmt::format("Condition ({}) {} for this design.", terms.id, holds ? "holds" : "fails"));
}

}  // namespace

FormalProofs quadrature_proofs(const Certificate& certificate) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  Proofs guarantee;
  if (certificate.particulars.has_value()) {
    guarantee = guarantee_proofs(tables, quadrature_particulars(certificate).start_covariance);
  }
  Proofs proofs((guarantee.empty() ? "" : ekf_parts()) + std::string(text_for_all_designs("theorem_2_9")));
  proofs.append(guarantee);
  for (const char* reading : {"printed", "errata"}) {
    proofs.cite("condition_2_43_fails_for_every_design", fmt::format("theorem-2.9/{}/feasibility", reading),
                "Condition (2.43) fails for every design and every admissible choice of the free parameters, "
                "in both readings.");
  }
  proofs.write(design_term(tables));
  const std::string initial_error = initial_error_term(tables.assume);
  for (const std::string reading : {"printed", "errata"}) {
    const theorems::Derivation* derivation = find_derivation(certificate, "theorem-2.9/" + reading);
    if (derivation == nullptr) {
      continue;
    }
    prove_constants(proofs, *derivation, reading);
    prove_condition(proofs, *derivation, reading, {"2.43", "lhs_2_43", "1"});
    prove_condition(proofs, *derivation, reading, {"2.44", "lhs_2_44", "1"});
    if (!initial_error.empty()) {
      prove_condition(proofs, *derivation, reading, {"2.45", "initial_error_bound", initial_error, false});
    }
  }
  return proofs.finished();
}

}  // namespace veritrack::certificates::coq

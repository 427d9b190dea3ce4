#include "certificates/kkl_observer/coq_kkl_observer.hpp"

#include "certificates/document/coq_parts.hpp"
// The KKL observer in Coq: its identities, the lower bound on ell over the frequency range, and whether gamma
// inverts T there.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/kkl_observer/kkl_claims.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/coq_numbers.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::certificates::coq {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr std::size_t kFilters = 4;
constexpr const char* kRates = "l1 l2 l3 l4";

/// "let u1 := transform l1 x1 x2 s in ..., " the filters' states for the signal (x1, x2, s).
std::string filters() {
  std::string text;
  for (std::size_t i = 1; i <= kFilters; ++i) {
    text += fmt::format("let u{0} := transform l{0} x1 x2 s in{1}", i, i % 2 == 0 ? "\n  " : " ");
  }
  return text;
}

/// "y solves (15) with the regularization of the ell in use": gamma(T(x)) = y.
std::string gamma_is_y() {
  return fmt::format("solves (regularization ell_in_use {0} u1 u2 u3 u4) {0} u1 u2 u3 u4 y1 y2 y3", kRates);
}

Verdict verdict_of(const Certificate& certificate, const std::string& derivation, const std::string& id) {
  const theorems::Derivation* found = find_derivation(certificate, derivation);
  if (found == nullptr) {
    return Verdict::undecided;
  }
  const auto condition = std::find_if(found->conditions.begin(), found->conditions.end(),
                                      [&](const theorems::Condition& one) { return one.id == id; });
  return condition == found->conditions.end() ? Verdict::undecided : condition->verdict;
}

void cite_identities(Proofs& proofs, bool four_filters) {
  proofs.cite("invariance", "kkl-paper/invariance",
              "T solves (3): along every solution of the oscillator T satisfies each filter's equation, for "
              "all rates.");
  proofs.cite("determinant", "kkl-paper/determinant", "det(L'L) = |M xi|², for all rates and all xi.");
  if (four_filters) {
    proofs.cite("inverse_where_regularization_vanishes", "kkl-paper/left-inverse",
                "Where mu vanishes and M T(x) does not, gamma(T(x)) = x, for all rates.");
  }
}

/// The rates, the range of s = x3, the proved bound and the ell in use.
void define_design(Proofs& proofs, const Certificate& certificate, const std::string& lower_bound) {
  const KklObserverTables& tables = kkl_observer_tables(certificate.design);
  proofs.write("\n(* The design: rates in 1/s, s = x3 = omega^2 in (rad/s)^2. *)\n");
  for (std::size_t i = 0; i < kFilters; ++i) {
    proofs.write(fmt::format("Definition l{} : R := {}.\n", i + 1, decimal(tables.design.lambda[i].text)));
  }
  proofs.write(fmt::format("Definition in_range (s : R) : Prop := {} ^ 2 <= s <= {} ^ 2.\n",
                           decimal(tables.assume.frequency[0].text),
                           decimal(tables.assume.frequency[1].text)));
  const KklEll ell = kkl_ell_in_use(certificate);
  proofs.write(fmt::format("Definition ell_lower : R := {}.\nDefinition ell_in_use : R := {}.\n", lower_bound,
                           ell.decimal ? decimal(*ell.decimal) : exactly(ell.nearest)));
  proofs.write(
      "Ltac unfold_design := unfold in_range, ell_lower, ell_in_use, l1, l2, l3, l4 in *.\n"
      "Lemma range_is_positive : forall s : R, in_range s -> 0 < s.\n"
      "Proof. intros s range. unfold_design. nra. Qed.\n"
      "Lemma rates_differ : l1 <> l2.\nProof. unfold_design. lra. Qed.\n");
}

void prove_lower_bound(Proofs& proofs) {
  for (const auto& [name, term] :
       {std::pair{"first_entry_is_positive", "entry_a l1 l2 l3 l4 ell_lower s"},
        std::pair{"discriminant_is_positive",
                  "entry_a l1 l2 l3 l4 ell_lower s * entry_c l1 l2 l3 l4 ell_lower s - entry_b l1 l2 l3 l4 "
                  "ell_lower s ^ 2"}}) {
    proofs.write(fmt::format(
        "\nLemma {} : forall s : R, in_range s ->\n  0 < {}.\nProof.\nintros s range. unfold_form. "
        "unfold_design.\ninterval with (i_bisect s, i_autodiff s, i_prec 90).\nQed.\n",
        name, term));
  }
  proofs.prove(
      "ell_is_at_least",
      fmt::format("forall x1 x2 s : R, in_range s ->\n  {}ell_lower * g33 u1 u2 u3 u4 <= "
                  "excitation {} u1 u2 u3 u4",
                  filters(), kRates),
      "intros x1 x2 s range. apply excitation_is_at_least; [ apply range_is_positive | apply "
      "first_entry_is_positive |\n  apply discriminant_is_positive ]; assumption.",
      "kkl-ell/ell",
      "The infimum (10) over the frequency range is at least the lower end of its enclosure, rounded "
      "down to 9 digits.");
}

/// A signal whose ratio is at most `bound`, a decimal: at the frequency where branch and bound found the
/// least one.
void prove_upper_bound(Proofs& proofs, const KklObserverTables& tables, double argmin,
                       const std::string& bound) {
  const kkl_observer::KklRange range = kkl_range(tables);
  const kkl_observer::SignalWitness witness =
      kkl_observer::propose_least_excited(rigor::midpoint(range.lambda), argmin);
  // At an end of the range the decimal of the design, next to which the double lies.
  Interval frequency(argmin);
  std::string term = exactly(argmin);
  for (const Number& end : tables.assume.frequency) {
    if (rigor::is_subset(Interval(argmin), end.value)) {
      frequency = end.value;
      term = decimal(end.text);
    }
  }
  const rigor::IntervalVector<4> xi = trackers::kkl_transform<Interval, 4>(
      {Interval(witness.x1), Interval(witness.x2), square(frequency)}, range.lambda);
  Interval squares(0.0);
  for (const Interval& filter : xi) {
    squares += square(filter);
  }
  const bool holds = rigor::certainly_less(trackers::kkl_excitation<Interval, 4>(xi, range.lambda),
                                           rigor::parse_decimal(bound) * squares);
  if (!holds) {
    return;  // the proposal is not good enough
  }
  proofs.write(fmt::format("\nDefinition ell_upper : R := {}.\n", decimal(bound)));
  proofs.prove(
      "ell_is_at_most",
      fmt::format("exists x1 x2 s : R, in_range s /\\ (x1 <> 0 \\/ x2 <> 0) /\\\n  ({}excitation {} u1 u2 "
                  "u3 u4 <= ell_upper * g33 u1 u2 u3 u4)",
                  filters(), kRates),
      fmt::format("exists {}, {}, ({} ^ 2). split; [ | split ].\n- unfold_design. lra.\n- {}; lra.\n"
                  "- cbv zeta. unfold g33, excitation, transform, ell_upper. unfold_design. interval with "
                  "(i_prec 90).",
                  exactly(witness.x1), exactly(witness.x2), term, witness.x1 != 0.0 ? "left" : "right"),
      "kkl-ell/ell",
      "The infimum (10) over the frequency range is at most the upper end of its enclosure, rounded up to 9 "
      "digits: some signal has a ratio that small.");
}

void prove_inverse(Proofs& proofs) {
  proofs.prove(
      "gamma_inverts_T",
      fmt::format("forall x1 x2 s y1 y2 y3 : R, in_range s -> x1 <> 0 \\/ x2 <> 0 ->\n  {}{} ->\n  y1 = x1 "
                  "/\\ y2 = x2 /\\ y3 = s",
                  filters(), gamma_is_y()),
      "intros x1 x2 s y1 y2 y3 range nonzero. apply (inverse_where_excited ell_lower).\n"
      "- apply range_is_positive; assumption.\n- apply rates_differ.\n- assumption.\n"
      "- unfold_design; lra.\n- unfold_design; lra.\n- apply ell_is_at_least; assumption.",
      "kkl-paper/left-inverse",
      "gamma(T(x)) = x for every signal of the frequency range, with the ell in use.");
}

void prove_no_inverse(Proofs& proofs, const kkl_observer::SignalWitness& witness) {
  const std::string frequency = exactly(witness.frequency);
  proofs.write(
      fmt::format("\n(* A signal of the range. *)\nDefinition x1 : R := {}.\nDefinition x2 : R := "
                  "{}.\nDefinition s : R := {} ^ 2.\n",
                  exactly(witness.x1), exactly(witness.x2), frequency));
  proofs.prove(
      "gamma_does_not_invert_T",
      fmt::format("forall y1 y2 y3 : R,\n  {}{} ->\n  ~ (y1 = x1 /\\ y2 = x2 /\\ y3 = s)", filters(),
                  gamma_is_y()),
      "intros y1 y2 y3. apply no_inverse_where_regularized.\n- unfold s. interval with (i_prec 90).\n"
      "- unfold g33, excitation, transform, x1, x2, s. unfold_design. interval with (i_prec 90).",
      "kkl-paper/left-inverse",
      fmt::format("gamma(T(x)) is not x for a signal of {} rad/s, with the ell in use.",
                  rigor::to_decimal(Interval(witness.frequency), 4)));
}

}  // namespace

FormalProofs kkl_observer_proofs(const Certificate& certificate) {
  Proofs proofs(text_for_all_designs("kkl_observer"));
  const KklObserverTables& tables = kkl_observer_tables(certificate.design);
  const bool four_filters = tables.design.lambda.size() == kFilters;  // the theorems are about four
  cite_identities(proofs, four_filters);
  const bool bounded = verdict_of(certificate, "kkl-ell", "positive") == Verdict::proved;
  if (!four_filters || !bounded) {
    return proofs.finished();
  }
  // Nine digits leave the branch and bound of the tactic some room.
  constexpr int kDigits = 9;
  const theorems::Derivation& enclosed = *find_derivation(certificate, "kkl-ell");
  const Interval ell = find_quantity(enclosed, "ell").value;
  define_design(proofs, certificate, decimal(rigor::lower_decimal(ell, kDigits)));
  prove_lower_bound(proofs);
  prove_upper_bound(proofs, tables, find_quantity(enclosed, "argmin_omega").value.lower(),
                    rigor::upper_decimal(ell, kDigits));
  const Verdict inverse = verdict_of(certificate, "kkl-paper", "left-inverse");
  if (inverse == Verdict::proved) {
    prove_inverse(proofs);
  } else if (inverse == Verdict::refuted) {
    if (const auto witness =
            kkl_observer::find_inverse_witness(kkl_range(tables), kkl_ell_in_use(certificate).value)) {
      prove_no_inverse(proofs, *witness);
    }
  }
  return proofs.finished();
}

}  // namespace veritrack::certificates::coq

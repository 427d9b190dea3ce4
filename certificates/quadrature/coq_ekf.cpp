#include "certificates/quadrature/coq_ekf.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "certificates/document/coq_numbers.hpp"
#include "certificates/quadrature/coq_ekf_numbers.hpp"

namespace veritrack::certificates::coq {

namespace {

using quadrature::EllipsoidAim;
using quadrature::EllipsoidQuestion;
using rigor::Interval;

/// The decimals as they stand in a statement.
struct Statement {
  std::string amplitude_error, phase_error, frequency_error, noise, slew, from, to;

  explicit Statement(const EkfTexts& texts)
      : amplitude_error(literal(texts.amplitude_error)),
        phase_error(literal(texts.phase_error)),
        frequency_error(literal(texts.frequency_error)),
        noise(literal(texts.noise)),
        slew(literal(texts.slew)),
        from(literal(texts.multiples[0])),
        to(literal(texts.multiples[1])) {}

  /// The assumption on P(0|0).
  [[nodiscard]] std::string between() const {
    return fmt::format("below (multiple {} lowest_start) m -> below m (multiple {} highest_start)", from, to);
  }

  /// For those P(0|0), and the samples that `condition` selects.
  [[nodiscard]] std::string proposition(const std::string& covariance, const std::string& condition,
                                        const std::string& bound) const {
    return fmt::format(
        "forall (phi omega v1 v2 : nat -> R) (a psi nu : R) (m : symmetric),\n"
        "  (* the tone, (3.1): phase and frequency, amplitude 1 *) (forall k, phi (S k) = phi k + omega k) "
        "->\n"
        "  (* the measurement noise v of (3.2) *) (forall k, v1 k ^ 2 + v2 k ^ 2 <= {} ^ 2) ->\n"
        "  (* the slew, w3 of (3.1), rad/sample per sample *) (forall k, Rabs (omega (S k) - omega k) <= {}) "
        "->\n"
        "  (* the errors of x(0|0): amplitude, phase in rad, frequency in rad/sample *)\n"
        "  Rabs a <= {} -> Rabs psi <= {} -> Rabs nu <= {} ->\n"
        "  (* P(0|0), in the frame of the estimated phase *)\n"
        "  {} ->\n"
        "  (* x3(k|k) of the recursion (2.3)-(2.9), and how far it is from the frequency *)\n"
        "  forall k, {}Rabs (x (run tracker (start_estimate (phi 0%nat) (omega 0%nat) a psi nu m)\n"
        "    (measurement phi v1 v2) k) 3%nat 1%nat - omega k) <= {}",
        noise, slew, amplitude_error, phase_error, frequency_error, covariance, condition, literal(bound));
  }
};

/// Design and start covariance as real numbers, for the statements.
std::string definitions(const EkfTexts& texts) {
  return fmt::format(
      "\n(* The design, Q = diag(q1, q1, q2) and R = r I, and the matrices between whose multiples the "
      "covariance at the\n   start lies. *)\n"
      "Definition tracker : noise_model := {{| q1 := {}; q2 := {}; r := {} |}}.\n"
      "Definition lowest_start : symmetric := Symmetric {}.\nDefinition highest_start : symmetric := "
      "Symmetric {}.\n",
      literal(texts.q1), literal(texts.q2), literal(texts.r), upper_triangle(texts.lowest, literal),
      upper_triangle(texts.highest, literal));
}

std::string proof(const std::string& certificate, const char* which) {
  return fmt::format(
      "  intros phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 H7 H8.\n"
      "  exact ({0} (check_sound {1} {1}_is_checked phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 H7 H8)).",
      which, certificate);
}

/// The same for P(0|0) = P*, by the convergence of the Riccati iteration.
void prove_steady_state(Proofs& proofs, const EllipsoidQuestion& question, const Statement& statement,
                        const EkfPromises& promises) {
  const auto bounds =
      quadrature::steady_bounds(question.design, question.start_lowest, question.start_highest);
  if (!bounds) {
    proofs.leave_out(
        "The theorem for a start at the filter's steady state is not in this file: a step at zero errors "
        "does "
        "not make the largest P(0|0) smaller and the smallest one larger.");
    return;
  }
  proofs.write(steady_text("bounds_of_the_steady_state", "set_for_ever", *bounds));
  proofs.prove(
      "steady_state_is_covered",
      fmt::format("forall m : symmetric, is_steady tracker m ->\n"
                  "  below (multiple {} lowest_start) m /\\ below m (multiple {} highest_start)",
                  statement.from, statement.to),
      "  exact (steady_is_between set_for_ever bounds_of_the_steady_state set_for_ever_is_checked\n"
      "    bounds_of_the_steady_state_are_checked).",
      "ekf/frequency-error-bound",
      "The steady state P*, the covariance that a step at zero errors keeps, lies between these two.");
  proofs.prove(
      "frequency_error_from_the_steady_state",
      statement.proposition("is_steady tracker m", "", promises.error_bound),
      "  intros phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 S.\n"
      "  destruct (steady_state_is_covered m S) as [H7 H8].\n"
      "  exact (frequency_error_for_ever phi omega v1 v2 a psi nu m H1 H2 H3 H4 H5 H6 H7 H8).",
      "ekf/frequency-error-bound",
      fmt::format("From P(0|0) = P* the frequency error never exceeds {} rad/sample.", promises.error_bound));
}

constexpr const char* kNotHere = "The theorem about the filter's recursion is not in this file: ";

/// The reason why a design is not asked about; empty when it is.
std::string what_is_not_covered(const QuadratureEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  if (!tables.design.without_leak()) {
    return "it is for designs without a leak (epsilon = 0).";
  }
  if (assume.gaussian) {
    return "it is for bounded noise, not for Gaussian noise.";
  }
  if (!(assume.amplitude.value == Interval(1.0))) {
    return "it is for tones of amplitude 1 (with amplitude A, divide q1, r and the noise by A^2, A^2 and A).";
  }
  if (assume.initial_frequency_error.in_hertz || assume.slew.in_hertz) {
    return "it is for an initial frequency error and a slew in rad/sample, not in Hz.";
  }
  return "";
}

/// A remedy where no set is found.
std::string why_none_is_found(const EkfTexts& texts, const EllipsoidQuestion& question) {
  constexpr int kHalvings = 6;
  std::string help = fmt::format("one was not found with a {}th of them either.", 1 << kHalvings);
  EllipsoidQuestion smaller = question;
  for (int k = 1; k <= kHalvings; ++k) {
    for (double* size : {&smaller.noise, &smaller.slew, &smaller.amplitude_error, &smaller.phase_error,
                         &smaller.frequency_error}) {
      *size *= 0.5;
    }
    if (search_ellipsoid(smaller, EllipsoidAim::for_ever)) {
      help = fmt::format("one is found when noise, slew and errors of the start are divided by {}.", 1 << k);
      break;
    }
  }
  return fmt::format(
      "no ellipsoid of errors was found that the filter never leaves with noise {}, slew {} rad/sample per "
      "sample and starts off by {} in amplitude, {} rad and {} rad/sample; {}",
      texts.noise, texts.slew, texts.amplitude_error, texts.phase_error, texts.frequency_error, help);
}

}  // namespace

Proofs guarantee_proofs(const QuadratureEkfTables& tables, const StartCovarianceText& start) {
  Proofs proofs;
  if (const std::string reason = what_is_not_covered(tables); !reason.empty()) {
    proofs.leave_out(kNotHere + reason);
    return proofs;
  }
  const EkfTexts texts = ekf_texts(tables, start);
  const EllipsoidQuestion question = question_of(texts);
  const auto for_ever = search_ellipsoid(question, EllipsoidAim::for_ever);
  const auto long_run = search_ellipsoid(question, EllipsoidAim::in_the_long_run);
  if (!for_ever || !long_run) {
    proofs.leave_out(kNotHere + why_none_is_found(texts, question));
    return proofs;
  }
  const EkfPromises always = promises_of(question, for_ever->set);
  const EkfPromises settled = promises_of(question, long_run->set);
  proofs.write(
      "\nModule ekf.\nImport Reals QArith filter positive leaf cover guarantee steady.\n"
      "Local Open Scope Q_scope.\n");
  proofs.write(certificate_text("set_for_ever", texts, *for_ever, always));
  proofs.write(certificate_text("set_for_the_long_run", texts, *long_run, settled));
  proofs.write("Local Open Scope R_scope.\n" + definitions(texts));
  const Statement statement(texts);
  proofs.prove(
      "frequency_error_for_ever", statement.proposition(statement.between(), "", always.error_bound),
      proof("set_for_ever", "proj1"), "ekf/frequency-error-bound",
      fmt::format(
          "The recursion (2.3)-(2.9) over the real numbers, for every tone of amplitude 1, every noise of at "
          "most {} and every change of the frequency of at most {} rad/sample per sample, from every start "
          "off by at most {} in amplitude, {} rad in phase and {} rad/sample in frequency, and every P(0|0) "
          "from {} to {} of the matrices `lowest_start` and `highest_start`: the frequency error never "
          "exceeds {} rad/sample.",
          texts.noise, texts.slew, texts.amplitude_error, texts.phase_error, texts.frequency_error,
          texts.multiples[0], texts.multiples[1], always.error_bound));
  proofs.prove(
      "frequency_error_in_the_long_run",
      statement.proposition(statement.between(), fmt::format("({} <= k)%nat -> ", settled.settled_after),
                            settled.settled_bound),
      proof("set_for_the_long_run", "proj2"), "ekf/settling-time",
      fmt::format("With these hypotheses it never exceeds {1} rad/sample from sample {0} on.",
                  settled.settled_after, settled.settled_bound));
  if (!start.is_given) {
    prove_steady_state(proofs, question, statement, always);
  }
  proofs.write("End ekf.\nImport ekf.\n\n");
  return proofs;
}

}  // namespace veritrack::certificates::coq

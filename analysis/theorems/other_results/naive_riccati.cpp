#include "analysis/theorems/other_results/naive_riccati.hpp"

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/covariance_range.hpp"
#include "analysis/theorems/signal_model.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;

const std::string kBounds = "docs/riccati-bounds.md, window N = 1";

/// The naive bounds with the exact Gramians at |z| = 1.
void add_exact_gramians(Derivation& derivation, const Theorem29Input& input) {
  const Interval one(1.0);
  const auto eigenvalues = observability_eigenvalues(one, input.r, input.epsilon);
  const Interval naive = one / eigenvalues.smallest + largest_process_noise(input);
  const Interval attained = attained_covariance(input, one);
  add_quantity(derivation,
               {"b_1_exact", "b_1", R"(\lambda_{\min}(\mathcal{O}(k, 1)) \text{ at } |z| = 1)",
                "thesis, section 3.5, eigenvalues with w_3 = (|z|/(1 - epsilon))^2"},
               eigenvalues.smallest);
  add_quantity(derivation, {"a_1_exact", "a_1", R"(\max(q_1, q_2))", "thesis, (2.23) with N = 1"},
               largest_process_noise(input));
  add_quantity(derivation,
               {"p_naive_exact", R"(\frac{1}{b_1} + a_1)", R"(\frac{1}{b_1} + a_1 \text{ at } |z| = 1)",
                "thesis, section 2.4.3"},
               naive);
  add_quantity(derivation,
               {"p_attained", R"(\sup \lVert P(k \mid k) \rVert)",
                R"(\lambda_{\max} \begin{pmatrix} r & r/\mu \\ r/\mu & (2r + q_1)/\mu^2 + q_2 \end{pmatrix})",
                kBounds},
               attained);

  // In the direction of the frequency: the variance for an infinite prior, and that of O^-1 + C.
  const Interval a_squared = square(one - input.epsilon);
  const Interval gramian = Interval(2.0) * input.r * a_squared + input.q2;
  derivation.conditions.push_back(compare(
      "naive-matrix", R"(P(k \mid k) \le \mathcal{O}(k, 1)^{-1} + \mathcal{C}(k, 1) \text{ at } |z| = 1)",
      {"the frequency variance for an infinite prior, (2r + q_1)(1 - epsilon)^2 + q_2,",
       gramian + input.q1 * a_squared},
      {"the entry of O^-1 + C, 2r (1 - epsilon)^2 + q_2,", gramian}, Strictness::weak));
  derivation.conditions.push_back(
      compare("naive-number", R"(\lVert P(k \mid k) \rVert \le \frac{1}{b_1} + a_1 \text{ at } |z| = 1)",
              {"the largest eigenvalue of P(k|k) for an infinite prior", attained},
              {"1/b_1 + a_1 with the exact eigenvalues", naive}, Strictness::weak));
}

/// p and q of one reading, over the band of |z| that its epsilon_r allows: 1 - epsilon_r <= |z| <= 1 +
/// epsilon_r. The errata sheet admits every epsilon_r that leaves sigma small against (1 - epsilon_r)^2.
void add_reading(Derivation& derivation, Theorem29Variant variant, const Theorem29Input& input) {
  const std::string name = variant == Theorem29Variant::printed ? "printed" : "errata";
  const bool printed = variant == Theorem29Variant::printed;
  const Theorem29Constants constants = theorem_2_9_constants(variant, input);
  const Interval smallest =
      printed ? Interval(1.0) - constants.epsilon_r : gaps::admitted_estimates(input).smallest;
  const Interval attained = attained_covariance(input, smallest);
  const Interval sound = largest_covariance(input, smallest);
  add_quantity(derivation, {"p_" + name, "p", R"(\frac{1}{b_1} + a_1)", "thesis, section 2.4.3, " + name},
               constants.p);
  add_quantity(derivation,
               {"p_sound_" + name, R"(\sup \lVert P(k \mid k) \rVert)",
                printed ? R"(\sup_{1 - \epsilon_r \le |z| \le 1 + \epsilon_r} \lVert P(k \mid k) \rVert)"
                        : R"(\sup_{\sqrt{2\sigma} \le |z| \le 2 - \sqrt{2\sigma}} \lVert P(k \mid k) \rVert)",
                kBounds, "", Sense::at_most},
               sound);
  add_quantity(derivation, {"q_" + name, "q", R"(\frac{1}{a_2} + b_2)", "thesis, section 2.4.3, " + name},
               constants.q);

  Condition covariance = compare(
      "p-" + name,
      printed ? R"(\lVert P(k \mid k) \rVert \le p \text{ for } \bigl||z| - 1\bigr| \le \epsilon_r)"
              : R"(\lVert P(k \mid k) \rVert \le p \text{ for } \bigl||z| - 1\bigr| \le 1 - \sqrt{2\sigma})",
      {"the sound bound on |P(k|k)|", sound}, {"p", constants.p}, Strictness::weak);
  if (covariance.verdict == Verdict::refuted && !printed) {
    covariance.verdict = Verdict::undecided;
    covariance.reason =
        "The sound bound is larger than p, which decides nothing: the errata sheet leaves sigma arbitrarily "
        "small, "
        "and p grows as sigma falls.";
  } else if (covariance.verdict != Verdict::proved && printed) {
    // Only a variance that a filter attains refutes p; a bound on the amplitude variance that exceeds p does
    // not.
    covariance = compare(covariance.id, covariance.statement,
                         {"the largest |P(k|k)| for an infinite prior, at |z| = 1 - epsilon_r,", attained},
                         {"p", constants.p}, Strictness::weak);
    if (covariance.verdict == Verdict::proved) {
      covariance.verdict = Verdict::undecided;
    }
  }
  if (covariance.verdict == Verdict::proved) {
    covariance.lhs_sense = Sense::at_most;
  }
  derivation.conditions.push_back(covariance);
  Condition information = compare("q-" + name, R"(\lVert P(k \mid k)^{-1} \rVert \le q)",
                                  {"the sound bound on |P(k|k)^-1|", largest_information(input)},
                                  {"q", constants.q}, Strictness::weak);
  if (information.verdict == Verdict::refuted) {
    information.verdict = Verdict::undecided;
    information.reason = "The sound bound is larger than q, which decides nothing.";
  }
  derivation.conditions.push_back(information);
}

}  // namespace

Derivation evaluate_riccati_bounds(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  Derivation derivation;
  derivation.id = "riccati-bounds";
  derivation.title = "The bounds on P(k|k) that the thesis takes from Deyst and Price";
  add_exact_gramians(derivation, input);
  for (const auto variant : {Theorem29Variant::printed, Theorem29Variant::errata}) {
    add_reading(derivation, variant, input);
  }
  add_quantity(derivation,
               {"q_sound", R"(\sup \lVert P(k \mid k)^{-1} \rVert)",
                R"(\max\left(\frac{1}{q_1} + \frac{1}{r}, \frac{1}{q_2}\right))", kBounds},
               largest_information(input), "It divides by q_1, which may be 0 in this design.");
  derivation.notes = {
      "P(k|k) <= O^-1 + C is false for two states or more; P(k|k)^-1 <= C^-1 + O is true for N = 1. Where p "
      "of a reading is a bound, the reason is that its b_1 is far below the smallest eigenvalue of the "
      "Gramian.",
      "The bounds are valid once the window's two measurements are processed: from k = 1 on for a start "
      "P(0|-1), from k = 2 on for a start P(0|0). The thesis uses them from k = 0 on."};
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

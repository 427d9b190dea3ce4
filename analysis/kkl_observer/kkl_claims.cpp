#include "analysis/kkl_observer/kkl_claims.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/kkl_observer/kkl_claim_parts.hpp"
#include "analysis/kkl_observer/kkl_excitation_ratio.hpp"
#include "analysis/kkl_observer/kkl_identities.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/statements/paper_findings.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

namespace {

using detail::add_inverse;
using detail::bounded;
using detail::condition;
using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using theorems::Sense;

/// The claims that are true, or false, for every design.
std::vector<Condition> claims_of_every_design() {
  std::vector<Condition> claims;
  claims.push_back(condition(
      "invariance", "\\tfrac{\\partial T}{\\partial x} f = F T + G h", transform_is_invariant(),
      "an identity in all rates and states with x1' = -x2, x2' = x3 x1, the signs of the paper's proof: its "
      "residual is the zero polynomial, by exact evaluation on a grid."));
  claims.push_back(condition(
      "phase-formula",
      "\\Phi = \\tan^{-1}(\\sqrt{x_{30}}\\, x_{10} / x_{20}) \\text{ where } T \\text{ of (6) solves (3)}",
      transform_is_invariant_with_other_sign(),
      "Witness x(0) = (1, 1, 1): the formula gives y(t) = sqrt(2) sin(t + pi/4), "
      "which increases at 0, but T of (6) solves (3) only with x1' = -x2, under which "
      "x1 decreases. With (6) the phase is atan2(w x1, -x2)."));
  claims.push_back(
      condition("determinant", "\\det(L^T L) = |M\\xi|^2", determinant_is_excitation(),
                "an identity in all rates and all xi, by exact evaluation on a grid of 6561 points."));
  claims.push_back(condition("null-space", "M\\lambda = 0,\\ M 1 = 0", null_space_holds_lambda_and_one(),
                             "an identity in all rates, by exact evaluation on a grid; with distinct rates M "
                             "has rank 2, so that these two vectors span its null space."));
  // L has a column for each component of the state.
  const Interval columns(static_cast<int>(trackers::OscillatorState<double>::RowsAtCompileTime));
  const Interval printed(4.0);
  claims.push_back(condition("dimensions",
                             "\\Phi = L^T L + \\mu I,\\ I \\in R^{4 \\times 4}: \\dim I \\le \\dim L^T L",
                             rigor::decide_less_equal(printed, columns),
                             "Witness: L has three columns, so that L'L is 3 x 3, and so must I be; 4 x 4 is "
                             "printed. For the same reason gamma_0, \"a real number\" in print, must have "
                             "three components. With these corrections (8) is well formed.",
                             printed, columns));
  return claims;
}

/// Section V: lambda = (1, 2, 3, 4), w = 3, and an ell of 5 "to satisfy (10)".
Condition section_v_claim() {
  const rigor::IntervalVector<4> lambda = rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  const Interval largest = Interval(2.0) * ExcitationRatio<Interval>(lambda).at(Interval(3.0));
  const Interval printed(5.0);
  const Verdict verdict = rigor::decide_less_equal(printed, largest);
  return condition("section-v-ell",
                   "5 \\le 2 \\inf |MT|^2 / |T|^2 \\text{ at } \\omega = 3,\\ \\lambda = (1, 2, 3, 4)",
                   verdict,
                   "the largest ell for which mu vanishes along the signal of section V is " +
                       rigor::upper_decimal(largest) +
                       " (with the factor 2 of (9)), in every range that contains 3 rad/s.",
                   printed, largest);
}

/// Distinct rates, and with them the Vandermonde matrix's smallest singular value.
void add_injectivity(const KklClaimsQuestion& question, theorems::Derivation& derivation) {
  const auto size = static_cast<Eigen::Index>(question.lambda.size());
  rigor::IntervalMatrix<Eigen::Dynamic, 4> vandermonde(size, 4);
  Interval largest_rate = question.lambda.front();
  for (Eigen::Index i = 0; i < size; ++i) {
    const Interval& rate = question.lambda[static_cast<std::size_t>(i)];
    largest_rate = max(largest_rate, rate);
    for (int j = 0; j < 4; ++j) {
      vandermonde(i, j) = pow(rate, 3 - j);
    }
  }
  const rigor::IntervalMatrix<4> gram = vandermonde.transpose() * vandermonde;
  const auto eigenvalues = rigor::symmetric_eigenvalues(gram);
  Interval smallest;
  if (eigenvalues) {
    smallest = (*eigenvalues)(0);
    for (int i = 1; i < 4; ++i) {
      smallest = min(smallest, (*eigenvalues)(i));
    }
  }
  const Verdict verdict = rigor::decide_less(Interval(0.0), smallest);
  const Interval root = sqrt(smallest);
  const Interval s = square(Interval(question.frequency.upper()));
  const Interval constant = sqrt(Interval(2.0) * square(Interval(1.0) + s) + Interval(2.0)) *
                            square(square(largest_rate) + s) / root;
  derivation.quantities.push_back(
      bounded({"vandermonde_singular_value", "\\sigma_{min}(V)", "", "paper, section IV", root, std::nullopt,
               Sense::enclosure, "smallest singular value of the Vandermonde matrix"}));
  derivation.quantities.push_back(bounded(
      {"injectivity_constant", "d",
       "\\sqrt{2(1 + \\bar x_3)^2 + 2}\\,(\\max \\lambda^2 + \\bar x_3)^2 / \\sigma_{min}(V)",
       "docs/kkl-observer.md", constant, std::nullopt, Sense::at_most, "constant of the injectivity of T"}));
  derivation.conditions.push_back(condition(
      "injectivity", "|\\Delta x_1| + |\\Delta x_2| + c |\\Delta x_3| \\le d\\, |\\Delta T|", verdict,
      verdict == Verdict::proved
          ? "the Vandermonde matrix of the rates has full rank, with a verified smallest singular value; d "
            "contains a factor that the paper's last step omits (from the sum of four terms to their norm)."
          : "the Vandermonde matrix of the rates is too close to a singular matrix for its rank to be "
            "verified.",
      smallest));
}

}  // namespace

theorems::Derivation derive_kkl_claims(const KklClaimsQuestion& question) {
  constexpr std::size_t kPrinted = 4;  // filters of the paper
  if (question.lambda.size() < kPrinted) {
    throw std::invalid_argument("a KKL observer needs at least four filters");
  }
  const rigor::UpwardRounding upward;
  theorems::Derivation derivation;
  derivation.id = "kkl-paper";
  derivation.title = "The claims of the paper";
  derivation.conditions = claims_of_every_design();
  derivation.conditions.push_back(section_v_claim());
  add_injectivity(question, derivation);
  add_inverse(question, derivation);
  if (question.lambda.size() > kPrinted) {
    derivation.notes.emplace_back(
        "The paper prints M for four filters. For more, |M xi|^2 is the sum over triples of filters of the "
        "squared determinant of (lambda, 1, xi), which is det(L'L), as for four.");
  }
  // A REFUTED claim is a slip of the paper's, not a fault of the design; together they have no verdict.
  derivation.verdict = Verdict::undecided;
  theorems::cite_findings(derivation);
  derivation.notes.emplace_back(
      "A claim that is not satisfied here is refuted as the paper prints it, as far as the scan shows that. "
      "These "
      "verdicts concern the paper, not "
      "this design.");
  return derivation;
}

}  // namespace veritrack::kkl_observer

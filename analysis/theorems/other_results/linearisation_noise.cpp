#include "analysis/theorems/other_results/linearisation_noise.hpp"

#include <array>

#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/covariance_range.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::IntervalMatrix;

SecondOrderTerms second_order_terms(const IntervalMatrix<3>& p, const Interval& m) {
  const Interval zero_entry(0.0);
  const Interval one(1.0);
  std::array<IntervalMatrix<3>, 2> hessians;
  hessians[0] = hessians[1] = IntervalMatrix<3>::Constant(zero_entry);
  hessians[0](1, 2) = hessians[0](2, 1) = -one;  // -nu d_2 - m nu^2 / 2
  hessians[0](2, 2) = -m;
  hessians[1](0, 2) = hessians[1](2, 0) = one;  // nu d_1
  SecondOrderTerms terms;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const IntervalMatrix<3> first = hessians.at(static_cast<std::size_t>(i)) * p;
      const IntervalMatrix<3> second = hessians.at(static_cast<std::size_t>(j)) * p;
      const IntervalMatrix<3> product = first * second;
      terms.printed(i, j) = first.trace() * second.trace() / Interval(4.0);
      terms.covariance(i, j) = product.trace() / Interval(2.0);
    }
  }
  return terms;
}

Derivation evaluate_lemma_3_1(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  // In the steady state amplitude and (phase, frequency) separate, and every variance lies in the range.
  const Interval smallest = Interval(1.0) / largest_information(input);
  const Interval variance = hull(smallest, largest_covariance(input, Interval(1.0)));
  const Interval correlation = variance * rigor::symmetric(1.0);
  IntervalMatrix<3> p = IntervalMatrix<3>::Constant(Interval(0.0));
  p(0, 0) = p(1, 1) = p(2, 2) = variance;
  p(1, 2) = p(2, 1) = correlation;
  const SecondOrderTerms terms = second_order_terms(p, Interval(1.0));

  Derivation derivation;
  derivation.id = "lemma-3.1";
  derivation.title = "Second-order terms of the prediction covariance (thesis, lemma 3.1)";
  add_quantity(derivation,
               {"phase_term_printed", R"(\frac{1}{4}(P\partial^2 f)_2^2)", R"(P_{13}^2)",
                "thesis, lemma 3.1, |z| = 1"},
               terms.printed(1, 1));
  add_quantity(derivation,
               {"phase_term", R"(\frac{1}{2}\mathrm{tr}(\mathcal{H}_2 P \mathcal{H}_2 P))",
                R"(P_{11}P_{33} + P_{13}^2)", "Gaussian error, |z| = 1, P(k|k) in its range"},
               terms.covariance(1, 1),
               "The range of the covariance divides by q_1, which may be 0 in this design.");
  // Frequency error alone, of variance 1: the phase error is sin nu, of variance (1 - e^-2)/2.
  const Interval one(1.0);
  const Interval exact = (one - rigor::exp(Interval(-2.0))) / Interval(2.0);
  derivation.conditions = {
      compare("exact-to-second-order",
              R"(\frac{1}{2}\mathrm{tr}(\mathcal{H}_2 P \mathcal{H}_2 P) \le \frac{1}{4}(P\partial^2 f)_2^2)",
              {"the second-order term of the phase variance", terms.covariance(1, 1)},
              {"the printed one", terms.printed(1, 1)}, Strictness::weak),
      compare("truncated-under-estimate", R"(0 < \frac{1}{2}\mathrm{tr}(\mathcal{H}_2 P \mathcal{H}_2 P))",
              zero(), {"the second-order term of the phase variance", terms.covariance(1, 1)}),
      compare("under-estimate", R"((F P F')_{22} \le \mathrm{Var}\,f_2 \text{ for every Gaussian error})",
              {"the linearised phase variance for P = diag(0, 0, 1)", one},
              {"the exact one, (1 - e^-2)/2,", exact}, Strictness::weak)};
  derivation.notes = {
      "The printed term is the square of the bias that the second-order terms cause. It is not part of the "
      "covariance about the mean. The second-order terms add (1/2) tr(H_i P H_j P) to the covariance of the "
      "truncated series, and both terms to the mean square about f(x).",
      "Linearisation always under-estimates the covariance only for the series truncated at second order. "
      "First-order times third-order terms are of the same order in P and negative: a frequency error "
      "rotates the signal, which bounds its effect on the phase."};
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

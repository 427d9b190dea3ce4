#include "analysis/theorems/other_results/observability_rank.hpp"

#include <array>
#include <cstddef>

#include "analysis/rigor/dual.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using Number = rigor::Dual<Interval, 3>;

Interval sum_of_products(const std::array<Number, 6>& outputs, int row, int column) {
  Interval sum(0.0);
  for (const Number& output : outputs) {
    sum += output.derivative(row) * output.derivative(column);
  }
  return sum;
}

/// Do the two matrices agree in every entry at every point of a grid with three values of each of x1, x2 and
/// epsilon? At frequency 0 their entries are polynomials of degree two at most in each, and small integers
/// are exact: agreement there is identity. That the frequency does not enter follows from the rotation.
rigor::Verdict grams_agree() {
  constexpr std::array<double, 3> kGrid = {-1.0, 0.0, 2.0};
  for (const double x1 : kGrid) {
    for (const double x2 : kGrid) {
      for (const double epsilon : kGrid) {
        const rigor::IntervalVector<3> state(Interval(x1), Interval(x2), Interval(0.0));
        const auto actual = observability_gram(state, Interval(epsilon));
        const auto printed = printed_gram(state, Interval(epsilon));
        for (Eigen::Index entry = 0; entry < actual.size(); ++entry) {
          if (!(actual(entry) == printed(entry))) {
            return rigor::Verdict::undecided;
          }
        }
      }
    }
  }
  return rigor::Verdict::proved;
}

/// det J'J = 3 m^2 (3 (1 + (2 - epsilon)^2) - (3 - epsilon)^2) = 6 m^2 ((epsilon - 3/2)^2 + 3/4).
Interval determinant(const Interval& m, const Interval& epsilon) {
  return Interval(6.0) * square(m) * (square(epsilon - Interval(1.5)) + Interval(0.75));
}

}  // namespace

rigor::IntervalMatrix<3> observability_gram(const rigor::IntervalVector<3>& state, const Interval& epsilon) {
  const auto variable = [&](Eigen::Index index) {
    std::array<Interval, 3> derivatives = {Interval(0.0), Interval(0.0), Interval(0.0)};
    derivatives.at(static_cast<std::size_t>(index)) = Interval(1.0);
    return Number(state(index), derivatives);
  };
  Number x1 = variable(0);
  Number x2 = variable(1);
  Number x3 = variable(2);
  std::array<Number, 6> outputs;
  for (std::size_t k = 0; k < 3; ++k) {
    outputs.at(2 * k) = x1;
    outputs.at(2 * k + 1) = x2;
    const auto [sine, cosine] = sin_cos(x3);
    const Number turned = cosine * x1 - sine * x2;
    x2 = sine * x1 + cosine * x2;
    x1 = turned;
    x3 = x3 * (Interval(1.0) - epsilon);
  }
  rigor::IntervalMatrix<3> gram;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      gram(row, column) = sum_of_products(outputs, row, column);
    }
  }
  return gram;
}

rigor::IntervalMatrix<3> printed_gram(const rigor::IntervalVector<3>& state, const Interval& epsilon) {
  const Interval two(2.0);
  const Interval retention = Interval(1.0) - epsilon;
  rigor::IntervalMatrix<3> gram = rigor::IntervalMatrix<3>::Constant(Interval(0.0));
  gram(0, 0) = gram(1, 1) = Interval(3.0);
  gram(0, 2) = gram(2, 0) = -(two * state(1)) - retention * state(1);
  gram(1, 2) = gram(2, 1) = two * state(0) + retention * state(0);
  gram(2, 2) = (square(state(0)) + square(state(1))) * (Interval(1.0) + square(two - epsilon));
  return gram;
}

Derivation evaluate_observability_rank(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  Derivation derivation;
  derivation.id = "theorem-3.1";
  derivation.title = "Strong local observability of the signal model (thesis, theorem 3.1 and section 3.2.1)";
  const Interval on_circle = determinant(Interval(1.0), input.epsilon);
  add_quantity(derivation,
               {"gram_determinant", R"(\det J'J)",
                R"(3 |z|^2 \left(3(1 + (2 - \epsilon)^2) - (3 - \epsilon)^2\right))",
                "thesis, section 3.2.1, at |z| = 1"},
               on_circle);
  derivation.conditions.push_back(
      compare("rank", R"(0 < \det J'J \text{ at } |z| = 1)", zero(), {"the determinant", on_circle}));
  derivation.conditions.push_back({"printed-gram",
                                   R"(J'J \text{ is the printed matrix, with } (1 - \epsilon)x_i)",
                                   grams_agree(), Interval::empty(), Interval::empty(),
                                   "The entries are equal on a grid with three values of each variable, and "
                                   "of degree two at most in each."});
  derivation.notes.emplace_back(
      "Full rank at every state but z = 0: the determinant is |z|^2 times a number that is positive for "
      "every "
      "epsilon. Two outputs suffice for that; the thesis takes three.");
  conclude(derivation);
  return derivation;
}

Derivation evaluate_observability_to_the_letter(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Interval epsilon = with_finite_members(unchecked.theorem_2_9).epsilon;
  Derivation derivation;
  derivation.id = "theorem-3.1/to-the-letter";
  derivation.title = "Further statements of section 3.2.1 of the thesis, taken literally";
  derivation.conditions.push_back(compare("rank-everywhere", R"(0 < \det J'J \text{ for every } x)", zero(),
                                          {"the determinant at z = 0", determinant(Interval(0.0), epsilon)}));
  // In the scan the entry reads -2 x2 - 1 - epsilon x2; "printed-gram" has the parentheses. At x = (1, 0, 0):
  const rigor::IntervalVector<3> witness(Interval(1.0), Interval(0.0), Interval(0.0));
  derivation.conditions.push_back(
      compare("gram-entry", R"((J'J)_{13} \le -2x_2 - 1 - \epsilon x_2 \text{, as the scan reads})",
              {"the entry at x = (1, 0, 0)", observability_gram(witness, epsilon)(0, 2)},
              {"the entry as the scan reads, without parentheses,", Interval(-1.0)}, Strictness::weak));
  // Two states that differ in frequency alone have the same output at k = 0.
  derivation.conditions.push_back(
      compare("definition-3.1", R"(h(f^k(x)) \ne h(f^k(\bar x)) \text{ for every } k = 0, \ldots, n-1)",
              zero(), {"the distance of the outputs of (1, 0, 0) and (1, 0, 1) at k = 0", Interval(0.0)}));
  derivation.notes.emplace_back(
      "Corollary 3.1.1 does not apply: the rank is not full at z = 0. Definition 3.1 must require that the "
      "outputs differ at some k.");
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

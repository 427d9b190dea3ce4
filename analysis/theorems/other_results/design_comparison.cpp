#include "analysis/theorems/other_results/design_comparison.hpp"

#include <optional>
#include <stdexcept>

#include "analysis/rigor/linear_solve.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

/// The gain of the filter with prediction covariance p.
std::optional<SmallMatrix> gain(const SmallMatrix& p, const SmallMatrix& h, const SmallMatrix& r) {
  const SmallMatrix seen = h * p;
  const SmallMatrix innovation = symmetrized(seen * h.transpose()) + r;
  const auto weights = rigor::solve(innovation, seen);
  return weights ? std::optional<SmallMatrix>(weights->transpose()) : std::nullopt;
}

/// One step of the error covariance of a filter with that gain: (k|k-1) to (k+1|k).
SmallMatrix propagated(const SmallMatrix& p, const SmallMatrix& k, const LinearWindow& noise, std::size_t i) {
  const Eigen::Index states = p.rows();
  const SmallMatrix correction = SmallMatrix::Identity(states, states) - k * noise.outputs[i];
  const SmallMatrix left = correction * p;
  const SmallMatrix weighted = k * noise.measurement_noises[i];
  const SmallMatrix filtered = symmetrized(left * correction.transpose() + weighted * k.transpose());
  const SmallMatrix moved = noise.transitions[i] * filtered;
  return symmetrized(moved * noise.transitions[i].transpose() + noise.process_noises[i]);
}

/// A lower bound on the smallest eigenvalues of all differences of one order: the order is strict where it is
/// positive.
Interval smallest_gap(const std::vector<DesignedCovariances>& steps, bool over_designed) {
  Interval smallest = Interval::empty();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const DesignedCovariances& step = steps[i];
    const SmallMatrix outer = over_designed ? step.designed - step.performed : step.optimal - step.designed;
    const Interval gap = smallest_eigenvalue(outer);
    smallest = i == 0 ? gap : min(smallest, gap);
  }
  return smallest;
}

/// The tracker's linearisation at |z| = 1 in the frame of the estimate, its noise times the factors.
LinearWindow tracker_window(const Theorem29Input& input, std::size_t steps, double q_factor,
                            double r_factor) {
  const Interval one(1.0);
  SmallMatrix f = SmallMatrix::Identity(3, 3);
  f(1, 2) = one;
  f(2, 2) = one - input.epsilon;
  SmallMatrix q = SmallMatrix::Constant(3, 3, Interval(0.0));
  q(0, 0) = q(1, 1) = Interval(q_factor) * input.q1;
  q(2, 2) = Interval(q_factor) * input.q2;
  LinearWindow window;
  window.transitions.assign(steps, f);
  window.process_noises.assign(steps, q);
  window.outputs.assign(steps + 1, SmallMatrix::Identity(2, 3));
  window.measurement_noises.assign(steps + 1, SmallMatrix::Identity(2, 2) * (Interval(r_factor) * input.r));
  return window;
}

}  // namespace

std::vector<DesignedCovariances> compare_designs(const LinearWindow& actual, const LinearWindow& design,
                                                 const SmallMatrix& prior) {
  const std::size_t count = actual.transitions.size();
  if (actual.outputs.size() != count + 1 || design.transitions.size() != count ||
      design.outputs.size() != count + 1 || prior.rows() != prior.cols()) {
    throw std::invalid_argument("compare_designs: two windows of the same shape are needed");
  }
  std::vector<DesignedCovariances> steps;
  steps.reserve(count);
  DesignedCovariances now{prior, prior, prior};
  for (std::size_t i = 0; i < count; ++i) {
    const auto designed_gain = gain(now.designed, design.outputs[i], design.measurement_noises[i]);
    const auto optimal_gain = gain(now.optimal, actual.outputs[i], actual.measurement_noises[i]);
    if (!designed_gain || !optimal_gain) {
      return {};
    }
    now = {propagated(now.designed, *designed_gain, design, i),
           propagated(now.optimal, *optimal_gain, actual, i),
           propagated(now.performed, *designed_gain, actual, i)};
    steps.push_back(now);
  }
  return steps;
}

Derivation evaluate_theorem_3_2(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  constexpr std::size_t kSteps = 6;
  const LinearWindow design = tracker_window(input, kSteps, 1.0, 1.0);
  const SmallMatrix prior = design.process_noises.front();
  const auto over = compare_designs(tracker_window(input, kSteps, 0.5, 0.5), design, prior);
  const auto under = compare_designs(tracker_window(input, kSteps, 2.0, 2.0), design, prior);

  Derivation derivation;
  derivation.id = "theorem-3.2";
  derivation.title =
      "Over-design and under-design of the filter (thesis, theorem 3.2), linearised at |z| = 1";
  const std::string unknown =
      "The differences could not be distinguished from 0, or q_1 may be 0 in this design.";
  const Interval over_gap = smallest_gap(over, true);
  const Interval under_gap = smallest_gap(under, false);
  add_quantity(derivation,
               {"over_design_gap", R"(\min_k \lambda_{\min}(P^d - P^p))",
                R"(Q^a = \frac{1}{2}Q^d, R^a = \frac{1}{2}R^d)", "six steps from P(0|-1) = Q^d"},
               over_gap, unknown);
  add_quantity(derivation,
               {"under_design_gap", R"(\min_k \lambda_{\min}(P^o - P^d))", R"(Q^a = 2Q^d, R^a = 2R^d)",
                "six steps from P(0|-1) = Q^d"},
               under_gap, unknown);
  derivation.conditions = {
      compare("over-design", R"(P^p(k \mid k-1) \le P^d(k \mid k-1), \quad k = 1, \ldots, 6)", zero(),
              {"the smallest eigenvalue of P^d - P^p", over_gap}),
      compare("under-design", R"(P^d(k \mid k-1) \le P^o(k \mid k-1), \quad k = 1, \ldots, 6)", zero(),
              {"the smallest eigenvalue of P^o - P^d", under_gap})};
  derivation.notes.emplace_back(
      "Proof of the theorem: with the gain of the design both P^p and P^d obey one affine recursion, "
      "monotone in "
      "noise and start; P^o <= P^p since P^o is optimal; P^d <= P^o since the Riccati map is monotone in Q "
      "and R.");
  conclude(derivation);
  return derivation;
}

Derivation evaluate_theorem_3_2_any_start() {
  const rigor::UpwardRounding upward;
  Derivation derivation;
  derivation.id = "theorem-3.2/any-start";
  derivation.title = "Theorem 3.2 of the thesis as printed, without a condition on the start";
  derivation.conditions.push_back(
      compare("any-start", R"(P^p(0 \mid -1) \le P^d(0 \mid -1) \text{ for any two})",
              {"P^p at a start with the variance 1", Interval(1.0)},
              {"P^d of a filter that starts with 0", Interval(0.0)}, Strictness::weak));
  derivation.notes.emplace_back(
      "The theorem also needs the order at the start: a filter that starts over-confident computes a smaller "
      "covariance than it attains, however large its Q and R.");
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

#include "analysis/theorems/theorem_2_9_feasibility.hpp"

#include <cmath>
#include <limits>

#include "analysis/search/maximize.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The least values of r / b_1 and of r b_2 over all admissible sigma.
struct Observability {
  Interval inverse_b_1, b_2;
};
Observability least(Theorem29Variant variant) {
  return variant == Theorem29Variant::printed ? Observability{Interval(8.0) / Interval(3.0), Interval(3.0)}
                                              : Observability{Interval(2.0), Interval(5.0)};
}

/// 4 (b_2/b_1)^(3/2) R_x.
Interval bound_for_every_design(Theorem29Variant variant, const Interval& state_bound) {
  const auto [inverse_b_1, b_2] = least(variant);
  const Interval ratio = inverse_b_1 * b_2;
  return Interval(4.0) * ratio * sqrt(ratio) * state_bound;
}

/// beta (zeta + eta) with p, q, s, rho_1 and rho_2 at their least; empty when q1 may be zero.
Interval bound_for_design(Theorem29Variant variant, const Theorem29Input& input) {
  const auto [inverse_b_1, b_2] = least(variant);
  const Interval one(1.0);
  const Interval two(2.0);
  const Interval p = input.q2 + input.r * inverse_b_1;
  const Interval q = one / input.q1 + b_2 / input.r;
  const Interval rho_1 = two * input.state_bound;
  const Interval rho_2 = sqrt(two) * input.state_bound;
  const Interval s = q + square(rho_1) / input.q1;
  const Interval delta_k = two * rho_1 * rho_2 * p / input.r * (one + s / input.r);
  const Interval zeta = two * rho_1 * delta_k;
  const Interval eta = two * p * q * rho_1;
  return sqrt(p * q) * (zeta + eta);
}

/// sigma, gamma_fraction, c1, c2 as logarithms or shares of their ranges.
Theorem29Input at_point(Theorem29Variant variant, const Theorem29Input& input, const Eigen::VectorXd& x) {
  const double end = variant == Theorem29Variant::printed ? 0.7 : 0.999;
  Theorem29Input point = input;
  point.sigma = Interval(end * std::exp(x[0]));
  point.gamma_fraction = Interval(x[1]);
  point.c1 = Interval(std::exp(x[2]));
  point.c2 = Interval(std::exp(x[3]));
  return point;
}

Eigen::VectorXd search_for_point(Theorem29Variant variant, const Theorem29Input& input) {
  const auto objective = [&](const Eigen::VectorXd& x) {
    const Interval lhs = theorem_2_9_constants(variant, at_point(variant, input, x)).lhs_2_43;
    return is_finite(lhs) ? -std::log(rigor::midpoint(lhs)) : std::numeric_limits<double>::quiet_NaN();
  };
  search::SearchSpace space;
  space.start = Eigen::Vector4d(-1.0, 0.5, -5.0, -5.0);
  space.step = Eigen::Vector4d(0.3, 0.1, 1.0, 1.0);
  space.lower = Eigen::Vector4d(-10.0, 0.01, -30.0, -30.0);
  space.upper = Eigen::Vector4d(0.0, 0.99, 3.0, 3.0);
  space.evaluations = 300;
  space.method = search::SearchMethod::direct;
  space.start = search::maximize(objective, space).point;
  space.method = search::SearchMethod::subplex;
  return search::maximize(objective, space).point;
}

std::vector<Quantity> described(const Theorem29Input& point, const Interval& lhs) {
  const auto quantity = [](const char* name, const char* symbol, const char* formula, const Interval& value) {
    return Quantity{name, symbol, formula, "found by NLopt (DIRECT-L, then Sbplx)", value, std::nullopt};
  };
  return {quantity("sigma", R"(\sigma)", "", point.sigma),
          quantity("gamma_fraction", R"(\gamma s p^2)", "", point.gamma_fraction),
          quantity("c_1", "c_1", "", point.c1), quantity("c_2", "c_2", "", point.c2),
          quantity("lhs_2_43", R"(\beta(\zeta + \eta) + \alpha)", R"(\beta(\zeta + \eta) + \alpha)", lhs)};
}

std::string argument(Theorem29Variant variant, const Interval& lower_bound, const Interval& every_design) {
  const bool printed = variant == Theorem29Variant::printed;
  return std::string("p q >= b_2/b_1 >= ") + (printed ? "8" : "10") +
         " for every sigma, eta >= 2 p q rho_1 by (2.40) and rho_1 >= 2 R_x, so that beta eta >= 4 "
         "(b_2/b_1)^(3/2) R_x, which is at least " +
         at_least(every_design) +
         " for every design, gamma, sigma, c_1 and c_2: (2.43) cannot be satisfied. For this design the left "
         "side is at least " +
         at_least(lower_bound) +
         ". The cause is the term 2 p q rho_1, a bound on the slope of the linearisation error that does not "
         "decrease with the ball.";
}

}  // namespace

Feasibility theorem_2_9_feasibility(Theorem29Variant variant, const Theorem29Input& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked);
  Feasibility feasibility;
  const Interval one(1.0);
  const Interval every_design = bound_for_every_design(variant, one);
  const Interval special = bound_for_design(variant, input);
  const Interval bound = is_finite(special) ? special : every_design;
  feasibility.lower_bound = bound;
  // cannot bind (every_design): a constant of either reading, which exceeds 1 whatever the design.
  if (certainly_less_equal(one, every_design)) {
    feasibility.verdict = Verdict::refuted;
    feasibility.every_design = true;
    feasibility.argument = argument(variant, bound, every_design);
  }
  const Eigen::VectorXd best = search_for_point(variant, input);
  const Theorem29Input point = at_point(variant, input, best);
  const Theorem29Constants constants = theorem_2_9_constants(variant, point);
  if (is_finite(constants.lhs_2_43)) {
    feasibility.best_found = described(point, constants.lhs_2_43);
  }
  return feasibility;
}

}  // namespace veritrack::theorems

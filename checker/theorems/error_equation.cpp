#include "checker/theorems/error_equation.hpp"

#include "checker/document/evidence.hpp"
#include "checker/numbers/matrix3.hpp"
#include "checker/theorems/signal_model.hpp"

namespace veritrack::checker {

ErrorEquation error_equation(const Design& d, const Ball& radius) {
  ErrorEquation e;
  e.radius = radius;
  e.transition = first_derivative_norm(one + radius, d.epsilon);
  e.curvature = second_derivative_norm(one + radius);
  e.smallest = one / max(one / d.q1 + one / d.r, one / d.q2);
  e.largest = largest_covariance(d.q1, d.q2, d.r, d.epsilon, one - radius);
  if (d.covariance) {
    const Ball least = extreme_eigenvalues(*d.covariance).low;
    const Ball most = extreme_eigenvalues(d.highest_covariance.value_or(*d.covariance)).high;
    const Ball first = square(e.transition) * most + max(d.q1, d.q2);
    e.smallest = min(e.smallest, least);
    e.largest = max(e.largest, max(most, first));
  }
  e.process = min(d.q1, d.q2);
  const Ball gain = e.process / (e.largest * square(e.transition));
  e.one_minus_alpha = gain / (one + gain) / (one + one / sqrt(one + gain));
  e.beta = sqrt(e.largest / e.smallest);
  e.correction = sqrt(e.largest / e.process);
  const Ball ratio = e.largest / d.r;
  e.gain = min(ratio, sqrt(ratio));
  return e;
}

Ball claimed_radius(const Tree& derivation, const std::string& name) {
  const Tree* quantity = derivation.at("quantities").find(name);
  if (quantity == nullptr) {
    return Ball::everything();
  }
  Ball radius = low_of(*quantity);
  return certainly_positive(radius) && certainly_at_most(radius, half) ? radius : Ball::everything();
}

std::vector<Quantity> quantities_of(const ErrorEquation& e) {
  return {{"radius", e.radius}, {"a_bar", e.transition}, {"curvature", e.curvature},
          {"p_lo", e.smallest}, {"p_hi", e.largest},     {"one_minus_alpha", e.one_minus_alpha},
          {"beta", e.beta}};
}

Condition start_covariance(const ErrorEquation& e, const Design& d) {
  const bool known = e.smallest.finite() && e.largest.finite();
  const bool is_kept = d.covariance.has_value() || (d.without_leak() && !d.covariance_multiples);
  return {"start-covariance", R"(\underline p I \le P(0 \mid 0) \le \bar p I)", proved_if(known && is_kept),
          e.smallest, e.largest};
}

}  // namespace veritrack::checker

#include "analysis/theorems/error_bound.hpp"

#include <stdexcept>

namespace veritrack::theorems {

using rigor::Interval;

Interval ErrorBound::at(int k) const {
  if (k < 0) {
    throw std::invalid_argument("the error bound of Theorem 2.9 begins at step 0");
  }
  return initial_ * pow(alpha_, k) + initial_ * pow(perturbed_rate_, k) + ultimate_;
}

std::optional<ErrorBound> make_error_bound(const ErrorBoundConstants& c) {
  const rigor::UpwardRounding upward;
  const Interval zero(0.0);
  const Interval one(1.0);
  // cannot bind (c.one_minus_alpha): (2.43) is false without it, as zeta and eta are not negative.
  const bool admissible = certainly_less(zero, c.one_minus_alpha) &&
                          certainly_less_equal(c.one_minus_alpha, one) && certainly_less_equal(one, c.beta) &&
                          certainly_less_equal(zero, c.zeta) && certainly_less_equal(zero, c.eta) &&
                          certainly_less_equal(zero, c.epsilon_z) &&
                          certainly_less_equal(zero, c.initial_error);
  if (!admissible || !certainly_less(c.beta * (c.zeta + c.eta), c.one_minus_alpha)) {
    return std::nullopt;
  }
  ErrorBound bound;
  // 1 - (alpha + zeta beta), formed from 1 - alpha: alpha itself may be 1 to sixteen digits. It is positive
  // because (2.43) is certain and eta >= 0.
  const Interval gap = c.one_minus_alpha - c.zeta * c.beta;
  bound.initial_ = c.beta * c.initial_error;
  bound.alpha_ = one - c.one_minus_alpha;
  bound.perturbed_rate_ = one - gap;
  bound.ultimate_ = c.beta * c.eta * (c.state_bound - c.beta * c.epsilon_z) / gap;
  if (!is_finite(bound.ultimate_) || !certainly_less_equal(zero, bound.ultimate_)) {
    return std::nullopt;
  }
  return bound;
}

}  // namespace veritrack::theorems

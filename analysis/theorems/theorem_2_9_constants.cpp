#include "analysis/theorems/theorem_2_9_constants.hpp"

#include "analysis/rigor/elementary.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

/// The errata sheet changes only epsilon_r, b_1 and b_2.
void set_observability(Theorem29Constants& c, Theorem29Variant variant, const Theorem29Input& input) {
  const Interval one(1.0);
  const Interval two(2.0);
  const Interval sigma = input.sigma;
  if (variant == Theorem29Variant::printed) {
    // Section 3.5: epsilon_r = 1/sqrt2 - sigma, and the formulas of b_1, b_2 in 1 -+ sqrt2 epsilon_r. Since
    // sqrt2 epsilon_r = 1 - sqrt2 sigma, these are sqrt2 sigma and 2 - sqrt2 sigma, without cancellation.
    const Interval root_two_sigma = sqrt(two) * sigma;
    c.epsilon_r = sqrt(Interval(0.5)) - sigma;
    c.b_1 = square(root_two_sigma) * (one - square(root_two_sigma) / Interval(4.0)) / (two * input.r);
    c.b_2 = Interval(3.0) * square(two - root_two_sigma) / input.r;
  } else {
    // Errata to page 68; epsilon_r is free in (0, 1) there, and 1 - sigma is our choice.
    c.epsilon_r = one - sigma;
    c.b_1 = sigma / (two * input.r);
    c.b_2 = Interval(5.0) / input.r;
  }
}

/// Section 3.5, in the order of its list, and p, q, s of section 2.4.3.
void set_signal_model(Theorem29Constants& c, const Theorem29Input& input) {
  c.state_bound = input.state_bound;
  const Interval ball = c.state_bound + c.epsilon_r;
  c.rho_1 = Interval(2.0) * ball;
  c.rho_2 = sqrt(Interval(2.0)) * ball;
  c.rho_3 = c.rho_2;
  c.rho_4 = c.rho_2;
  c.rho_5 = Interval(1.0);
  c.delta_1 = input.q1;
  c.delta_2 = input.r;
  c.a_1 = input.q2;
  c.a_2 = input.q1;
  c.process_noise_bound = input.c1 * sqrt(input.q2);
  c.measurement_noise_bound = input.c2 * sqrt(input.r);

  const Interval one(1.0);
  c.p = c.a_1 + one / c.b_1;
  c.q = one / c.a_2 + c.b_2;
  c.s = c.q + square(c.rho_1) / c.delta_1;
}

/// Theorem 2.8: gamma, (2.35) and (2.36).
void set_decay(Theorem29Constants& c, const Theorem29Input& input) {
  const Interval one(1.0);
  const Interval two(2.0);
  const Interval rate = one / (c.s * square(c.p));
  c.gamma = input.gamma_fraction * rate;
  c.beta = sqrt(c.p * c.q);

  // alpha = sqrt(1 - gamma/q) is 1 to within 1e-17 for the thesis's designs: only 1 - alpha carries
  // information. The root exists for every admissible input. s >= q, and p q >= b_2 / b_1, which is at least
  // 8 in print (with t = sqrt2 sigma < 1 it is 6 (2 - t)^2 / (t^2 (1 - t^2/4)) > 8) and at least 10 with the
  // errata (10 / sigma); hence gamma/q = gamma_fraction / (s q p^2) < 1/(p q)^2 <= 1/64.
  const Interval decay = c.gamma / c.q;
  c.one_minus_alpha = decay / (one + sqrt(one - decay));

  // (2.35) with its bracket, -rho_1 + sqrt(rho_1^2 + D), written as D / (sqrt(rho_1^2 + D) + rho_1).
  const Interval d = (one - input.gamma_fraction) * rate / c.q;
  const Interval bracket = d / (sqrt(square(c.rho_1) + d) + c.rho_1);
  c.epsilon_z = min(c.epsilon_r, sqrt(two) / sqrt(c.rho_4) * sqrt(bracket));
  c.initial_error_bound = c.epsilon_z / c.beta;  // (2.45)
}

/// Lemmas 2.3, 2.4 and 2.5.
void set_perturbations(Theorem29Constants& c) {
  const Interval one(1.0);
  const Interval two(2.0);
  c.delta_p = two * c.rho_1 * c.rho_2 * c.p;
  const Interval gain = c.rho_5 / c.delta_2;
  c.delta_k = c.delta_p * gain * (one + c.s * c.rho_5 * gain);
  c.zeta_z = c.delta_k * c.rho_5 * c.rho_1 * c.epsilon_z;  // (2.39)

  // The thesis does not give delta_k2 explicitly: the three terms of the second derivative of K in the proof
  // of Lemma 2.5, with the bounds of the proofs of Lemmas 2.3 and 2.5 on each factor.
  const Interval delta_p2 = two * c.p * (c.rho_3 * c.rho_1 + square(c.rho_2));
  const Interval inverse_first = square(gain) * c.delta_p;
  const Interval inverse_second = two * square(inverse_first) * c.delta_2 + square(gain) * delta_p2;
  c.delta_k2 = delta_p2 * gain + two * c.delta_p * c.rho_5 * inverse_first + c.s * c.rho_5 * inverse_second;
  c.zeta = two * c.rho_1 * c.rho_5 * c.delta_k + c.rho_1 * c.rho_5 * c.delta_k2 * c.epsilon_r;  // (2.42)

  // (2.40)
  const Interval w = c.process_noise_bound;
  const Interval v = c.measurement_noise_bound;
  const Interval linearisation = c.rho_4 * square(c.epsilon_r) / two;
  const Interval pq = c.p * c.q;
  c.eta_size = pq * (w + linearisation) + c.p * gain * v;
  c.eta_slope = c.delta_k * (c.rho_5 * w + v + c.rho_5 * linearisation) + two * pq * c.rho_1;
  c.eta = max(c.eta_size, c.eta_slope);
}

/// The left-hand sides of (2.43) and (2.44).
void set_conditions(Theorem29Constants& c) {
  const Interval alpha = Interval(1.0) - c.one_minus_alpha;
  c.perturbation_2_43 = c.beta * (c.zeta + c.eta);
  c.perturbation_2_44 = c.beta * c.zeta_z;
  c.lhs_2_43 = c.perturbation_2_43 + alpha;
  c.lhs_2_44 = c.perturbation_2_44 + alpha;
}

}  // namespace

Theorem29Input with_finite_members(const Theorem29Input& input) {
  Theorem29Input result = input;
  for (Interval* member : {&result.q1, &result.q2, &result.r, &result.epsilon, &result.state_bound,
                           &result.sigma, &result.gamma_fraction, &result.c1, &result.c2}) {
    if (!is_finite(*member)) {
      *member = Interval::empty();
    }
  }
  for (std::optional<Interval>* member :
       {&result.largest_state, &result.process_noise, &result.measurement_noise, &result.initial_error}) {
    if (*member && !is_finite(**member)) {
      **member = Interval::empty();
    }
  }
  return result;
}

Theorem29Constants theorem_2_9_constants(Theorem29Variant variant, const Theorem29Input& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked);
  Theorem29Constants constants;
  set_observability(constants, variant, input);
  set_signal_model(constants, input);
  set_decay(constants, input);
  set_perturbations(constants);
  set_conditions(constants);
  return constants;
}

Interval largest_initial_error(const Interval& amplitude, const Interval& amplitude_error,
                               const Interval& phase_error, const Interval& frequency_error) {
  const rigor::UpwardRounding upward;
  const bool non_negative = amplitude.lower() >= 0.0 && amplitude_error.lower() >= 0.0 &&
                            phase_error.lower() >= 0.0 && frequency_error.lower() >= 0.0;
  if (!non_negative) {
    return Interval::empty();
  }
  // A phase error beyond half a turn has no further effect.
  const Interval half_angle = min(phase_error, rigor::pi()) / Interval(2.0);
  const Interval chord = Interval(4.0) * amplitude * (amplitude + amplitude_error) * square(sin(half_angle));
  return sqrt(square(amplitude_error) + chord + square(frequency_error));
}

}  // namespace veritrack::theorems

#include "checker/theorems/theorem_2_9.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

std::vector<Quantity> quantities_of(const Constants29& c, const Design& d) {
  return {{"R_x", d.state_bound},
          {"epsilon_r", c.epsilon_r},
          {"rho_1", c.rho_1},
          {"rho_2", c.rho_2},
          {"rho_3", c.rho_2},
          {"rho_4", c.rho_2},
          {"rho_5", one},
          {"delta_1", d.q1},
          {"delta_2", d.r},
          {"a_1", d.q2},
          {"a_2", d.q1},
          {"b_1", c.b_1},
          {"b_2", c.b_2},
          {"p", c.p},
          {"q", c.q},
          {"s", c.s},
          {"gamma", c.gamma},
          {"beta", c.beta},
          {"one_minus_alpha", c.one_minus_alpha},
          {"epsilon_z", c.epsilon_z},
          {"delta_p", c.delta_p},
          {"delta_k", c.delta_k},
          {"delta_k2", c.delta_k2},
          {"zeta_z", c.zeta_z},
          {"eta", c.eta},
          {"zeta", c.zeta},
          {"lhs_2_43", c.beta * (c.zeta + c.eta) + one - c.one_minus_alpha},
          {"lhs_2_44", c.beta * c.zeta_z + one - c.one_minus_alpha},
          {"initial_error_bound", c.initial_error_bound}};
}

/// One inequality of a condition that has several.
struct Part {
  Range left, right;
  Verdict verdict;
};
Part weak(const Ball& left, const Ball& right) {
  return {left, right, decide_at_most(left, right)};
}
Part strict(const Ball& left, const Ball& right) {
  return {left, right, decide_less(left, right)};
}

bool encloses(const Tree* side, const Range& value) {
  // cannot bind (low_of(*side), value.high): check_derivation compares the sides again with those of the
  // part.
  return side == nullptr ||
         (certainly_at_most(low_of(*side), value.low) && certainly_at_most(value.high, high_of(*side)));
}

/// The condition that all parts make. The certificate shows the two sides of one of them; of a REFUTED
/// condition it must be a part that is refuted.
Condition of_parts(const Tree& claimed, const std::string& id, const std::string& statement,
                   const std::vector<Part>& parts) {
  std::vector<Verdict> verdicts;
  verdicts.reserve(parts.size());
  for (const Part& part : parts) {
    verdicts.push_back(part.verdict);
  }
  Condition condition{id, statement, all_of(verdicts), parts.front().left, parts.front().right};
  for (const Tree& shown : claimed.at("conditions").elements()) {
    if (shown.at("id").text() != id) {
      continue;
    }
    const bool refuted = verdict_from(shown.at("verdict").text()) == Verdict::refuted;
    for (const Part& part : parts) {
      if ((!refuted || part.verdict == Verdict::refuted) && encloses(shown.find("lhs"), part.left) &&
          encloses(shown.find("rhs"), part.right)) {
        condition.lhs = part.left;
        condition.rhs = part.right;
        return condition;
      }
    }
  }
  return condition;
}

std::vector<Condition> conditions_of(const Tree& claimed, const Constants29& c, const Design& d,
                                     Reading reading) {
  const bool printed = reading == Reading::printed;
  const Ball sigma_end = printed ? sqrt(half) : one;
  const Ball leaked = d.epsilon * d.largest_frequency;
  const Ball largest_state = sqrt(one + square(d.largest_frequency));
  const Ball initial_error = largest_initial_error(d);
  const Part q1_positive = strict(zero, d.q1);
  const Part no_more_than_q2{d.q1, d.q2, d.q1_equals_q2 ? Verdict::proved : decide_at_most(d.q1, d.q2)};
  // The largest |w| is anything from the leak's part at constant frequency to that part plus the slew.
  const Verdict process = certainly_at_most(leaked + d.slew, c.process_noise) ? Verdict::proved
                          : certainly_less(c.process_noise, leaked)           ? Verdict::refuted
                                                                              : Verdict::undecided;
  const auto all = [&claimed](const std::string& id, const std::string& statement,
                              const std::vector<Part>& parts) {
    return of_parts(claimed, id, statement, parts);
  };
  return {
      all("sigma", printed ? R"(0 < \sigma < \frac{1}{\sqrt{2}})" : R"(0 < \sigma < 1)",
          {strict(zero, d.sigma), strict(d.sigma, sigma_end)}),
      all("epsilon_r", R"(0 < \epsilon_r < R_x)",
          {strict(zero, c.epsilon_r), strict(c.epsilon_r, d.state_bound)}),
      all("gamma", R"(0 < \gamma s p^2 < 1)",
          {strict(zero, d.gamma_fraction), strict(d.gamma_fraction, one)}),
      all("epsilon", R"(0 \le \epsilon < 1)", {weak(zero, d.epsilon), strict(d.epsilon, one)}),
      all("2.24", R"(0 < a_2 \le a_1)", {q1_positive, no_more_than_q2}),
      all("2.25", R"(0 < b_1 \le b_2)", {strict(zero, c.b_1), weak(c.b_1, c.b_2)}),
      {"2.26", R"(\lvert x(k) \rvert \le R_x)", decide_at_most(largest_state, d.state_bound), largest_state,
       d.state_bound},
      all("2.28",
          R"(0 < \delta_1, \quad \delta_1 I \le Q, \quad \lvert w(k) \rvert \le \lVert w \rVert = c_1 \sqrt{q_2})",
          {q1_positive, no_more_than_q2, {Range(leaked, leaked + d.slew), c.process_noise, process}}),
      all("2.29",
          R"(0 < \delta_2, \quad \delta_2 I \le R, \quad \lvert v(k) \rvert \le \lVert v \rVert = c_2 \sqrt{r})",
          {strict(zero, d.r), weak(d.noise, c.measurement_noise)}),
      {"2.43", R"(\beta(\zeta + \eta) + \alpha < 1)",
       decide_less(c.beta * (c.zeta + c.eta), c.one_minus_alpha),
       c.beta * (c.zeta + c.eta) + one - c.one_minus_alpha, one},
      {"2.44", R"(\beta\zeta_z + \alpha < 1)", decide_less(c.beta * c.zeta_z, c.one_minus_alpha),
       c.beta * c.zeta_z + one - c.one_minus_alpha, one},
      {"2.45", R"(\lvert e_0 \rvert < \epsilon_z (pq)^{-1/2})",
       decide_less(initial_error, c.initial_error_bound), initial_error, c.initial_error_bound}};
}

/// For every sigma in its range r/b_1 and r b_2 exceed these; eta >= 2 p q rho_1, p q >= b_2/b_1, rho_1 >= 2
/// R_x, and R_x >= 1 on the unit circle: so beta eta > 4 (b_2/b_1)^(3/2) >= 1, whatever the design.
void check_feasibility(const Tree& claimed, const Design& d, Reading reading, Objections& objections) {
  const Ball inverse_b_1 = reading == Reading::printed ? Ball(8.0) / Ball(3.0) : two;
  const Ball b_2(reading == Reading::printed ? 3.0 : 5.0);
  const Ball ratio = inverse_b_1 * b_2;
  const bool never = certainly_at_most(one, four * ratio * sqrt(ratio));
  check_verdict(claimed.at("verdict").text(), never ? Verdict::refuted : Verdict::undecided, "feasibility",
                objections);
  if (claimed.at("every_design").truth() && !never) {
    objections.emplace_back("feasibility: not shown for every design");
  }
  // beta (zeta + eta) with every factor at its least over sigma, gamma, c_1, c_2.
  Ball least = four * ratio * sqrt(ratio);
  // cannot bind (d.q1): without it the bound is a ball of everything.
  if (certainly_positive(d.q1)) {
    const Ball p = d.q2 + d.r * inverse_b_1;
    const Ball q = one / d.q1 + b_2 / d.r;
    const Ball rho_1 = two * d.state_bound;
    const Ball s = q + square(rho_1) / d.q1;
    const Ball delta_k = two * rho_1 * sqrt(two) * d.state_bound * p / d.r * (one + s / d.r);
    least = sqrt(p * q) * (two * rho_1 * delta_k + two * p * q * rho_1);
  }
  if (const Tree* bound = claimed.find("lower_bound")) {
    check_enclosure(*bound, {"lower_bound", least}, objections);
  }
}

}  // namespace

Constants29 constants_2_9(const Design& d, Reading reading) {
  Constants29 c;
  if (reading == Reading::printed) {
    // In t = 1 - sqrt2 epsilon_r = sqrt2 sigma: the differences from 1 without cancellation.
    const Ball t = sqrt(two) * d.sigma;
    c.epsilon_r = sqrt(half) - d.sigma;
    c.b_1 = square(t) * (one - square(t) / four) / (two * d.r);
    c.b_2 = Ball(3.0) * square(two - t) / d.r;
  } else {
    c.epsilon_r = one - d.sigma;
    c.b_1 = d.sigma / (two * d.r);
    c.b_2 = Ball(5.0) / d.r;
  }
  c.rho_1 = two * (d.state_bound + c.epsilon_r);
  c.rho_2 = sqrt(two) * (d.state_bound + c.epsilon_r);
  c.p = d.q2 + one / c.b_1;
  c.q = one / d.q1 + c.b_2;
  c.s = c.q + square(c.rho_1) / d.q1;
  const Ball pq = c.p * c.q;
  const Ball whole = one / (c.s * square(c.p));
  c.gamma = d.gamma_fraction * whole;
  c.beta = sqrt(pq);
  c.one_minus_alpha = c.gamma / c.q / (one + sqrt(one - c.gamma / c.q));
  const Ball rest = (whole - c.gamma) / c.q;
  c.epsilon_z = min(c.epsilon_r, sqrt(two / c.rho_2) * sqrt(rest / (c.rho_1 + sqrt(square(c.rho_1) + rest))));
  c.initial_error_bound = c.epsilon_z / c.beta;
  // Lemmas 2.3 and 2.5, rho_3 = rho_4 = rho_2, rho_5 = 1.
  c.delta_p = two * c.rho_1 * c.rho_2 * c.p;
  c.delta_k = c.delta_p / d.r * (one + c.s / d.r);
  const Ball curved = two * c.p * (c.rho_2 * c.rho_1 + square(c.rho_2));
  const Ball r2 = square(d.r);
  c.delta_k2 = curved / d.r + two * square(c.delta_p) / r2 +
               c.s * (two * square(c.delta_p) / (r2 * d.r) + curved / r2);
  c.zeta_z = c.delta_k * c.rho_1 * c.epsilon_z;
  c.zeta = two * c.rho_1 * c.delta_k + c.rho_1 * c.delta_k2 * c.epsilon_r;
  c.process_noise = d.c1 * sqrt(d.q2);
  c.measurement_noise = d.c2 * sqrt(d.r);
  const Ball remainder = c.rho_2 * square(c.epsilon_r) / two;
  c.eta_size = pq * (c.process_noise + remainder) + c.p / d.r * c.measurement_noise;
  c.eta_slope = c.delta_k * (c.process_noise + c.measurement_noise + remainder) + two * pq * c.rho_1;
  c.eta = max(c.eta_size, c.eta_slope);
  return c;
}

Ball smallest_admitted_estimate(const Design& d) {
  const Ball two_sigma = two * d.sigma;
  // cannot bind (two_sigma): a root of what may be negative is a ball of everything.
  return certainly_positive(two_sigma) && certainly_less(two_sigma, one) ? sqrt(two_sigma)
                                                                         : Ball::everything();
}

Ball largest_initial_error(const Design& d) {
  // |e|^2 = a^2 + 4 (1 + a) sin^2(phase/2) + nu^2, largest at the largest of each; half a turn is the most.
  const Ball half_phase = min(d.phase_error, pi()) / two;
  return sqrt(square(d.amplitude_error) + four * (one + d.amplitude_error) * square(sin(half_phase)) +
              square(d.frequency_error));
}

std::string check_theorem_2_9(const Tree& claimed, const Design& design, Reading reading,
                              Objections& objections) {
  const Constants29 c = constants_2_9(design, reading);
  const bool printed = reading == Reading::printed;
  std::string title =
      check_derivation(claimed,
                       {printed ? "Theorem 2.9 (EKF stability) as printed in the 1994 thesis"
                                : "Theorem 2.9 (EKF stability) with the errata sheet of the 1994 thesis",
                        quantities_of(c, design), conditions_of(claimed, c, design, reading)},
                       objections);
  if (const Tree* feasibility = claimed.find("feasibility")) {
    check_feasibility(*feasibility, design, reading, objections);
  }
  return title;
}

}  // namespace veritrack::checker

// The Gramian, the derivatives of the model, and the remainders.
#include "checker/theorems/proof_gaps_parts.hpp"
#include "checker/theorems/signal_model.hpp"

namespace veritrack::checker {

namespace {

const Ball nine_digits(1e-9);

Verdict agree(const Ball& x, const Ball& y) {
  return decide_at_most(abs(x - y), nine_digits * abs(x));
}

}  // namespace

void add_gramian(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const bool printed = reading == "printed";
  const Ball admitted = smallest_admitted_estimate(d);
  const Ball smallest = printed ? square(max(one - c.epsilon_r, zero)) : square(admitted);
  const Ball largest = printed ? square(one + c.epsilon_r) : square(two - admitted);
  const Ball ball = sqrt(two) * c.epsilon_r;
  const Ball low = printed ? square(one - ball) : d.sigma;
  const Ball high = printed ? square(one + ball) : Ball(3.0) + four * d.state_bound;
  const Verdict range = printed ? all_of({decide_at_most(low, smallest), decide_at_most(largest, high)})
                                : all_of({decide_less(low, smallest), decide_less(largest, high)});
  const bool allowed = printed ? certainly_positive(c.epsilon_r) : admitted.finite();
  add(claims, "w_3-range/" + reading,
      printed
          ? "For every error with |e| <= eps_r, (1 - sqrt(2) eps_r)^2 <= w3 <= (1 + sqrt(2) eps_r)^2."
          : "For every eps_r in (0, 1 - sqrt(2 sigma)] and every error with |e| <= eps_r, sigma < w3 < 3 + 4 "
            "R_x.",
      allowed ? range : Verdict::undecided,
      {{"w_3_smallest", smallest}, {"w_3_largest", largest}, {"range_low", low}, {"range_high", high}});
  // The eigenvalues grow with w3.
  const Ball leaked = square(one / (one - d.epsilon));
  const Ball least = gramian_eigenvalues(smallest * leaked).smallest / d.r;
  // Every eps_r below 1 is admitted for b_2, which does not depend on sigma.
  const Ball most = gramian_eigenvalues((printed ? largest : four) * leaked).largest / d.r;
  add(claims, "b_1/" + reading,
      printed
          ? "b_1 I <= O(k,1) for every estimate that |e| <= eps_r allows."
          : "b_1 I <= O(k,1) for every eps_r in (0, 1 - sqrt(2 sigma)] and every estimate that |e| <= eps_r "
            "allows.",
      allowed ? decide_at_most(c.b_1, least) : Verdict::undecided,
      {{"smallest_eigenvalue", least}, {"b_1", c.b_1}});
  add(claims, "b_2/" + reading,
      printed ? "O(k,1) <= b_2 I for every estimate that |e| <= eps_r allows."
              : "O(k,1) <= b_2 I for every eps_r in (0, 1) and every estimate that |e| <= eps_r allows.",
      allowed || !printed ? decide_at_most(most, c.b_2) : Verdict::undecided,
      {{"largest_eigenvalue", most}, {"b_2", c.b_2}});
}

void add_gramian_formula(Claims& claims, const Design& d) {
  const Ball leaked = square(one / (one - d.epsilon));
  // At the estimate (1, 0, 0) and at |z| = 3/4: from the matrix [[2, -mu], [-mu, mu^2]].
  const auto smallest = [&](const Ball& m) {
    const Ball mu2 = square(m) * leaked;
    const Ball trace = two + mu2;
    return two * mu2 / (trace + sqrt(square(two - mu2) + four * mu2));
  };
  const Ball exact = smallest(one);
  const auto formula = [&](const std::string& reading, const std::string& words, const Ball& w3) {
    const Ball value = gramian_eigenvalues(w3).smallest;
    add(claims, "gramian-eigenvalue/" + reading,
        "The smallest eigenvalue of r O(k,1) is (2 + w3 - sqrt(w3^2 + 4))/2 with w3 = " + words +
            ", to nine digits, at the estimate (1, 0, 0).",
        agree(exact, value), {{"smallest_eigenvalue", exact}, {"formula_value", value}});
  };
  formula("printed", "|x1 + i x2|^2", one);
  formula("repaired", "|x1 + i x2|^2 / (1 - epsilon)^2", leaked);
  const Ball before = smallest(Ball(0.75));
  add(claims, "gramian-time-index",
      "The eigenvalues of O(k,1) depend on the trajectory through the estimate (k|k) alone, to nine digits.",
      agree(exact, before), {{"eigenvalue_at_1", exact}, {"eigenvalue_at_three_quarters", before}});
  const Ball largest = sqrt(one + square(two * pi()));
  const Ball printed = Ball(64.0) / Ball(10.0);
  add(claims, "R_x",
      "With |x1 + i x2| = 1 and 0 < x3 < 2 pi rad/sample the state has |x(k)| < 6.4, and that is at most "
      "R_x.",
      all_of({decide_less(largest, printed), decide_at_most(printed, d.state_bound)}),
      {{"largest_state", largest}, {"R_x", d.state_bound}});
}

void add_derivatives(Claims& claims, const Design& d, const Constants29& c, const std::string& reading) {
  const Ball ball = d.state_bound + c.epsilon_r;
  const Ball first = first_derivative_norm(ball, d.epsilon);
  const Ball second = second_derivative_norm(ball);
  const Ball third = third_derivative_norm(ball);
  const auto supremum = [&](const std::string& name, const std::string& derivative, const Ball& exact,
                            const Ball& bound) {
    add(claims, name + "/" + reading, "||" + derivative + "|| <= " + name + " for all |x| <= R_x + eps_r.",
        decide_at_most(exact, bound), {{"supremum", exact}, {name, bound}});
  };
  supremum("rho_1", "df/dx", first, c.rho_1);
  supremum("rho_2", "d^2 f/dx^2", second, c.rho_2);
  supremum("rho_3", "d^3 f/dx^3", third, c.rho_2);
  add(claims, "remainder-constant/" + reading,
      "The rho_4 of section 3.5 is a Lipschitz constant of df/dx (above (2.33)) and of the second derivative "
      "(which (2.33) needs) for all |x| <= R_x + eps_r.",
      all_of({decide_at_most(second, c.rho_2), decide_at_most(third, c.rho_2)}),
      {{"lipschitz_of_first_derivative", second},
       {"lipschitz_of_second_derivative", third},
       {"rho_4", c.rho_2}});
}

void add_remainders(Claims& claims, const Design& d, const Constants29& printed) {
  const Ball remainder = (one - cos(one)) / Ball(8.0);
  const Ball bound = square(Ball(0.125)) / two;
  add(claims, "remainder-constant/general",
      "A Lipschitz constant rho_4 of the first derivative gives (2.33), |f'(x1) - f'(x2) - f''(x2)(x1 - x2)| "
      "<= rho_4 |x1 - x2|^2 / 2.",
      decide_at_most(remainder, bound), {{"remainder", remainder}, {"claimed_bound", bound}});
  const Ball difference = one - cos(half);
  const Ball rest = difference - half * sin(half);
  add(claims, "decomposition/printed",
      "F_x(k) = F_zbar(k) + B(k) with B(k) = F_x - F_zbar - (d^2 f/dx^2)(zbar) z (proof of Theorem 2.8), to "
      "nine digits.",
      decide_at_most(abs(difference - rest), nine_digits),
      {{"difference_entry", difference}, {"remainder_entry", rest}});
  const Ball second = second_derivative_norm(d.state_bound + printed.epsilon_r);
  add(claims, "decomposition/repaired",
      "||F_x(k) - F_zbar(k)|| <= rho_4 |z(k)| for all |x| <= R_x, |z| <= eps_r (the mean value theorem).",
      decide_at_most(second, printed.rho_2), {{"supremum", second}, {"rho_4", printed.rho_2}});
  // f(x) - f(x - e) and kappa_f(x, -e) = f(x - e) - f(x) + F_x e, first components; that of F_x e is 0.
  const Ball kappa = cos(half) - one;
  const auto sign = [&](const std::string& place, const std::string& words, const Ball& claimed) {
    add(claims, "remainder-sign/" + place,
        "f(x) - f(x - e) = F_x e " + words +
            " kappa_f(x, -e), to nine digits, at x = (1, 0, 0), e = (0, 0, 1/2).",
        decide_at_most(abs(difference - claimed), nine_digits), {{"moved", difference}, {"kappa_f", kappa}});
  };
  sign("2.12", "-", -kappa);
  sign("theorem-2.9", "+", kappa);
}

}  // namespace veritrack::checker

// Results that rest on the error equation, within a radius that the certificate chooses.
#include "checker/theorems/published_results_parts.hpp"

#include "checker/theorems/conditions.hpp"
#include "checker/theorems/error_equation.hpp"
#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

/// sup of |g(k)| for the assumed noise: |w| from the leak's part to that part plus the slew.
Range perturbation(const ErrorEquation& e, const Design& d) {
  const Ball least = e.correction * leaked(d) + e.gain * d.noise;
  return {least, least + e.correction * d.slew};
}

/// beta (zeta + eta) < gap, where eta has a range.
Condition with_noise(const std::string& id, const std::string& statement, const ErrorEquation& e,
                     const Ball& zeta, const Range& eta, const Ball& gap) {
  return less(id, statement, Range(e.beta * (zeta + eta.low), e.beta * (zeta + eta.high)), gap);
}

/// |w|/w_scale + |v|/v_scale below what a ball tolerates.
Condition tolerates_noise(const std::string& statement, const Design& d, const Ball& of_process,
                          const Ball& of_measurement, const Ball& tolerated) {
  const Ball least = of_process * leaked(d) + of_measurement * d.noise;
  return less("noise", statement, Range(least, least + of_process * d.slew), tolerated);
}

Derivation total_stability_of(const Design& d, const Tree& claimed, bool noisy) {
  const ErrorEquation e = error_equation(d, claimed_radius(claimed, "radius"));
  const Ball rate = two * e.correction * e.curvature;
  const Ball r = min(e.radius, Ball(noisy ? 0.5 : 0.9375) * e.one_minus_alpha / (e.beta * rate));
  const Ball zeta = rate * r;
  const Ball gap = e.one_minus_alpha - e.beta * zeta;
  const Range g = perturbation(e, d);
  const Range eta(g.low / r, g.high / r);
  const Ball start = r / e.beta;
  Derivation found;
  found.title = noisy ? "Total stability theorem (thesis, theorem 2.6) for the error equation of the tracker"
                      : "Corollary 2.6.1 of the thesis for the error equation of the tracker";
  found.quantities = quantities_of(e);
  const std::vector<Quantity> more{
      {"r", r}, {"zeta", zeta}, {"initial_frequency_error_bound", start}, {"rate", one - gap}};
  found.quantities.insert(found.quantities.end(), more.begin(), more.end());
  found.conditions.push_back(start_covariance(e, d));
  if (noisy) {
    found.quantities.push_back({"eta", eta});
    found.quantities.push_back({"noise_bound", gap / e.beta * r / e.gain});
    found.conditions.push_back(
        with_noise("2.6", R"(\beta(\zeta + \eta) + \alpha < 1)", e, zeta, eta, e.one_minus_alpha));
  } else {
    found.conditions.push_back(less("2.6.1", R"(\beta\zeta + \alpha < 1)", e.beta * zeta, e.one_minus_alpha));
    Condition free = noise_free(R"(w(k) = 0, \quad v(k) = 0)", d);
    free.lhs = g;
    found.conditions.push_back(free);
  }
  found.conditions.push_back(
      less("start", R"(\lvert e_0 \rvert < r / \beta)", largest_initial_error(d), start));
  return found;
}
}  // namespace

Derivation total_stability(const Design& d, const Tree& claimed) {
  return total_stability_of(d, claimed, true);
}
Derivation total_stability_corollary(const Design& d, const Tree& claimed) {
  return total_stability_of(d, claimed, false);
}

Derivation theorem_2_7_corrected(const Design& d, const Tree& claimed) {
  const ErrorEquation e = error_equation(d, claimed_radius(claimed, "radius"));
  const Ball rate = two * e.correction * e.curvature;
  const Ball r_x = min(e.radius, Ball(0.375) * e.one_minus_alpha / (e.beta * rate));
  const Ball r_delta = half * r_x;
  const Ball r_z = r_delta / e.beta;
  const Ball left = e.one_minus_alpha - e.beta * rate * r_x;
  const Ball zeta = half * rate * r_delta;
  const Range g = perturbation(e, d);
  const Range eta(g.low / r_delta, g.high / r_delta);
  const Ball gap = left - e.beta * zeta;
  Derivation found;
  found.title = "Theorem 2.7 of the thesis with its zeta corrected, for the error equation of the tracker";
  found.quantities = quantities_of(e);
  const std::vector<Quantity> more{{"r", r_x},
                                   {"zeta", zeta},
                                   {"one_minus_alpha_2", left},
                                   {"r_z", r_z},
                                   {"eta", eta},
                                   {"initial_frequency_error_bound", r_z},
                                   {"noise_bound", gap / e.beta * r_delta / e.gain},
                                   {"rate", one - gap}};
  found.quantities.insert(found.quantities.end(), more.begin(), more.end());
  found.conditions = {start_covariance(e, d),
                      with_noise("2.7", R"(\beta_2(\zeta + \eta) + \alpha_2 < 1)", e, zeta, eta, left),
                      less("start", R"(\lvert e_0 \rvert < r_z)", largest_initial_error(d), r_z)};
  return found;
}

Derivation song_grizzle_local(const Design& d, const Tree& claimed) {
  const ErrorEquation e = error_equation(d, claimed_radius(claimed, "radius"));
  const Ball a2 = square(e.transition);
  const Ball p = one / e.process;
  const Ball q = a2 * e.largest + max(d.q1, d.q2);
  const Ball r = one / e.smallest + a2 / e.process;
  const Ball phi = half * e.curvature * square(p * q);
  const Ball decrease = one / (r * square(q));
  const Ball b = p * q * e.transition;
  const Ball vanishing = decrease / p / (sqrt(square(b) + decrease / p) + b) / phi;
  const Ball error = min(half * vanishing, e.radius / max(one, e.correction));
  const Ball growth = p * error * phi * (two * b + phi * error);
  const Ball gamma = decrease - growth;
  const Ball start = error / sqrt(p * q) / e.transition;
  Derivation found;
  found.title = "The argument of Song and Grizzle (1993), suprema over the states near the signal";
  found.quantities = quantities_of(e);
  const std::vector<Quantity> more{{"p", p},
                                   {"q", q},
                                   {"r", r},
                                   {"phi", phi},
                                   {"prediction_error", error},
                                   {"gamma", gamma},
                                   {"initial_frequency_error_bound", start},
                                   {"rate", sqrt(one - gamma / p)}};
  found.quantities.insert(found.quantities.end(), more.begin(), more.end());
  found.conditions = {
      start_covariance(e, d),
      less("varphi", R"(\varphi(q^{1/2}V(0, e_0)^{1/2}, \kappa_f, 0) < 0)", growth, decrease),
      noise_free(R"(w(k) = 0, \quad v(k) = 0)", d),
      less("start", R"(\lvert e_0 \rvert < \frac{q^{1/2} V(0, e_0)^{1/2}}{\bar a (pq)^{1/2}})",
           largest_initial_error(d), start)};
  return found;
}

Derivation reif(const Design& d, const Tree& claimed) {
  const ErrorEquation e = error_equation(d, claimed_radius(claimed, "epsilon_prime"));
  const Ball p_hi = square(e.transition) * e.largest + max(d.q1, d.q2);
  const Ball closed = e.transition * (one + p_hi / d.r);
  const Ball ratio = e.process / (p_hi * square(closed));
  const Ball alpha = ratio / (one + ratio);
  const Ball kappa_phi = half * e.curvature;
  const Ball kappa = kappa_phi / e.process * (two * closed + kappa_phi * e.radius);
  const Ball epsilon = min(e.radius, alpha / (two * p_hi * kappa));
  const Ball inside = epsilon * sqrt(e.process / p_hi);
  const Ball one_minus_rate = half * alpha / (one + sqrt(one - half * alpha));
  const Ball tolerated = inside * one_minus_rate;
  const Ball gain = e.transition * p_hi / d.r;
  return {
      "Stochastic stability of the EKF (Reif, Guenther, Yaz, Unbehauen 1999), constants as published",
      {{"epsilon_prime", e.radius},
       {"a_bar", e.transition},
       {"p_lo", e.process},
       {"p_hi", p_hi},
       {"alpha", alpha},
       {"kappa", kappa},
       {"epsilon_published", epsilon},
       {"initial_frequency_error_bound", inside},
       {"noise_bound", tolerated / gain},
       {"rate", one - one_minus_rate}},
      {less("excitation", R"(0 < \underline q)", zero, min(d.q1, d.q2)),
       less("start", R"(\lvert e_0 \rvert < \epsilon (\underline p / \bar p)^{1/2})",
            largest_initial_error(d), inside),
       tolerates_noise(
           R"(\lvert w \rvert + \frac{\bar a \bar p}{\underline r} \lvert v \rvert < \left(1 - \sqrt{1 - \alpha/2}\right) \epsilon (\underline p / \bar p)^{1/2})",
           d, one, gain, tolerated)}};
}

Derivation reif_two_step(const Design& d, const Tree& claimed) {
  const ErrorEquation e = error_equation(d, claimed_radius(claimed, "radius"));
  const Ball growth = half * e.curvature * e.correction;
  const Ball epsilon = min(e.radius, e.one_minus_alpha / (two * growth));
  const Ball one_minus_rate = e.one_minus_alpha - growth * epsilon;
  const Ball margin = one_minus_rate * epsilon / sqrt(e.largest);
  const Ball start = epsilon / e.beta;
  Derivation found;
  found.title = "The argument of Reif et al. (1999), carried out for the tracker's own filter";
  found.quantities = quantities_of(e);
  const std::vector<Quantity> more{{"epsilon_ball", epsilon},
                                   {"initial_frequency_error_bound", start},
                                   {"noise_bound", margin * sqrt(d.r)},
                                   {"rate", one - one_minus_rate}};
  found.quantities.insert(found.quantities.end(), more.begin(), more.end());
  found.conditions = {
      less("excitation", R"(0 < \underline q)", zero, min(d.q1, d.q2)), start_covariance(e, d),
      less("start", R"(\lvert e_0 \rvert < \epsilon / \beta)", largest_initial_error(d), start),
      tolerates_noise(
          R"(\frac{\lvert w \rvert}{\sqrt{\underline q}} + \frac{\lvert v \rvert}{\sqrt r} < (1 - \alpha - L\epsilon) \frac{\epsilon}{\sqrt{\bar p}})",
          d, one / sqrt(e.process), one / sqrt(d.r), margin)};
  return found;
}

}  // namespace veritrack::checker

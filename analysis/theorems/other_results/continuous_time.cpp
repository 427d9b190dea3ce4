#include "analysis/theorems/other_results/continuous_time.hpp"

#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/other_results/error_equation.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

const std::string kContinuousTheorems = "thesis, theorems 2.1 and 2.2";

/// The estimate keeps |z| <= 1 + kBand.
constexpr double kBand = 0.25;

/// Constants for estimates with |z| <= 1 + kBand; N_0 = nu I, the best choice for the sound bound.
struct ContinuousConstants {
  Interval leak;    ///< epsilon_c, a sample
  Interval q_0;     ///< Q >= q_0 I
  Interval spread;  ///< (|Q| + |Lambda|^2) / (2 alpha_0), alpha_0 = epsilon_c
  Interval nu;      ///< N_0 = nu I: half the spread
  Interval q;       ///< |N(t)| <= q = nu + spread
  Interval sound;   ///< |x_0 - m_0| below this decays to zero
};

ContinuousConstants constants(const Theorem29Input& input) {
  const Interval two(2.0);
  const Interval one(1.0);
  const Interval band(kBand);
  ContinuousConstants c;
  c.leak = -rigor::log(one - input.epsilon);
  c.q_0 = smallest_process_noise(input);
  // Lambda R^(-1/2) H = [[-alpha_0, 0], [0, -alpha_0], [x2, -x1]] leaves the symmetric part -epsilon_c I.
  const Interval gain = input.r * (square(c.leak) + square(one + band));
  c.spread = (largest_process_noise(input) + gain) / (two * c.leak);
  c.nu = c.spread / two;
  c.q = c.nu + c.spread;
  // The error stays below sqrt(q/nu) times its start: inside the band.
  c.sound = min(c.q_0 * sqrt(c.nu) / (c.q * sqrt(c.q)), band * sqrt(c.nu / c.q));
  return c;
}

/// The right side of (2.16) as printed, n = 3, with the state in units of 1/scale: the bound on |x_0 - m_0|
/// in the old units. Gamma = Q^-1 G, G = [[b, 0, 0], [0, b, 0], [x2, -x1, b + epsilon_c]], b = beta_0 = 1.
Interval printed_bound(const Theorem29Input& input, const ContinuousConstants& c, double scale,
                       const Interval& nu) {
  const Interval one(1.0);
  const Interval units = square(Interval(scale));
  const Interval g_squared = Interval(2.0) + square(Interval(1.0 + kBand)) + square(one + c.leak);
  const Interval gamma_squared = g_squared / square(c.q_0 * units);
  const Interval p = one / (nu * units) + (one / (input.r * units) + gamma_squared) / Interval(2.0);
  return c.q_0 * units / (Interval(9.0) * sqrt(p) / sqrt(nu * units));
}

}  // namespace

Derivation evaluate_baras_bensoussan_james(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const ContinuousConstants c = constants(input.theorem_2_9);
  const Interval start_covariance = is_finite(c.nu) ? c.nu : Interval(1.0);
  const Interval printed = printed_bound(input.theorem_2_9, c, 1.0, start_covariance);
  const Interval rescaled = printed_bound(input.theorem_2_9, c, 1024.0, start_covariance);

  Derivation derivation;
  derivation.id = "baras-bensoussan-james";
  derivation.title =
      "Baras, Bensoussan and James 1988 (thesis, theorem 2.2) for the matching continuous-time oscillator";
  const std::string no_leak = "Without a leak the pair is not detectable in the theorem's sense.";
  add_quantity(derivation,
               {"epsilon_c", R"(\epsilon_c)", R"(-\log(1 - \epsilon))", "matching decay per sample"}, c.leak);
  add_quantity(
      derivation,
      {"q", "q", R"(\lVert N_0 \rVert + \frac{\lVert Q^{1/2} \rVert^2 + \lVert \Lambda \rVert^2}{2\alpha_0})",
       "thesis, theorem 2.1, N_0 chosen here"},
      c.q, no_leak);
  add_quantity(derivation,
               {"printed_start_bound", R"(\lvert x_0 - m_0 \rvert)",
                R"(\frac{q_0}{n^2 p^{1/2} \lVert P_0^{1/2} \rVert})", "thesis, (2.16)"},
               printed);
  add_quantity(derivation,
               {"printed_start_bound_rescaled", R"(\lvert x_0 - m_0 \rvert)",
                R"(\frac{q_0}{n^2 p^{1/2} \lVert P_0^{1/2} \rVert})",
                "thesis, (2.16), with the state in units of 1/1024"},
               rescaled);
  add_guarantee(derivation, {c.sound, Interval::empty(), Interval::empty()}, "docs/published-results.md",
                "The theorem is for signals without noise.");
  const AssumedNoise noise = assumed_noise(input);
  const Interval far = pow(Interval(2.0), 500);
  const Interval bound = pow(Interval(2.0), 400);
  const Interval coupling = square((far - bound) / Interval(2.0));
  derivation.conditions = {
      compare("bounded-derivative", R"(\sup_x \lVert \partial f / \partial x \rVert < \infty)",
              {"its last column at |z| = 2^500", sqrt(square(far) + square(c.leak))}, {"|z|", far}),
      compare("excitation", R"(0 < q_0)", zero(), {"min(q_1, q_2)", c.q_0}),
      compare("detectable", R"(\eta'(F + \Lambda H)\eta \le -\alpha_0 |\eta|^2 \text{ at } \eta = (0, 0, 1))",
              zero(), {"the leak epsilon_c", c.leak}),
      compare("detectable-everywhere", R"(\lVert \Lambda(x) \rVert \le 2^{400} \text{ serves every } x)",
              {"the square of the coupling at |z| = 2^500", coupling}, {"2^400 epsilon_c", bound * c.leak},
              Strictness::weak),
      compare("controllable-everywhere", R"(\lVert Q\Gamma(x) \rVert \le 2^{400} \text{ serves every } x)",
              {"the square of the coupling at |z| = 2^500", coupling}, {"2^800", square(bound)},
              Strictness::weak),
      compare("units", R"(\text{(2.16) does not depend on the units of } x)",
              {"the bound in units of 1/1024", rescaled}, {"the bound in units of 1", printed},
              Strictness::weak),
      compare("noise-free", R"(w = 0, \quad v = 0)",
              {"the largest |w| + |v| allowed", noise.process + noise.measurement}, zero(), Strictness::weak),
      start_error(input, R"(\frac{q_0}{q^{3/2} \lVert P_0^{1/2} \rVert})", c.sound)};
  derivation.notes = {
      "(2.16) as printed depends on the units of the state, so that suitable units make it admit any start: "
      "p bounds the inverse of the covariance, but its proof needs the bound q on the covariance, to the "
      "power 3/2.",
      "Definition 2.2 pairs F with Q, theorem 2.1 with a square root of Q: with Q Gamma the term in p is "
      "that of "
      "Q^(1/2) Gamma. Also N_0 = P_0^-1 is the covariance, P its inverse.",
      "The conditions require one bounded Lambda and Gamma for all states. Near the signal both exist if "
      "there is a leak; initial_frequency_error_bound is for that neighbourhood, any start with N(0) = nu I, "
      "and a signal that follows the model."};
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

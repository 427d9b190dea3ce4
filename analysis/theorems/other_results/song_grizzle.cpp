#include "analysis/theorems/other_results/song_grizzle.hpp"

#include "analysis/statements/comparison.hpp"
#include "analysis/statements/derivation_builder.hpp"
#include "analysis/theorems/other_results/error_equation.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

const std::string kSongGrizzleTheorems = "thesis, theorems 2.4 and 2.5";

/// The constants of theorem 2.4 for prediction errors e(k|k-1) up to `largest_error`.
struct LocalConstants {
  ErrorEquation equation;
  Interval p, q, r;
  Interval phi;            ///< (1/2) X (pq)^2: no curvature in the output
  Interval decrease;       ///< 1/(r q^2)
  Interval largest_error;  ///< E = q^(1/2) V_0^(1/2): at most half of the zero of varphi
};

LocalConstants local_constants(const TrackerInput& input, const Interval& radius) {
  LocalConstants c;
  c.equation = error_equation(input, radius);
  const ErrorEquation& equation = c.equation;
  const Interval one(1.0);
  const Interval two(2.0);
  const Interval transition_squared = square(equation.transition);
  c.p = one / equation.process;
  c.q = transition_squared * equation.covariance.largest + largest_process_noise(input.theorem_2_9);
  c.r = one / equation.covariance.smallest + transition_squared / equation.process;
  c.phi = equation.curvature / two * square(c.p * c.q);
  c.decrease = one / (c.r * square(c.q));
  // varphi = -decrease + p E phi (2 p q a_bar + phi E) vanishes at phi E = D / (sqrt(b^2 + D) + b).
  const Interval b = c.p * c.q * equation.transition;
  const Interval d = c.decrease / c.p;
  const Interval vanishing = d / (sqrt(square(b) + d) + b) / c.phi;
  // The filtered error, at most |I - KH| E, must stay within the radius, too.
  c.largest_error = min(vanishing / two, equation.radius / max(one, equation.correction));
  return c;
}

}  // namespace

Derivation evaluate_song_grizzle(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const Theorem29Input input = with_finite_members(unchecked.theorem_2_9);
  Derivation derivation;
  derivation.id = "song-grizzle";
  derivation.title = "Song and Grizzle 1993 (thesis, theorem 2.5), assumptions as printed";
  const Interval singular = observability_eigenvalues(Interval(0.0), input.r, input.epsilon).smallest;
  derivation.conditions.push_back(compare(
      "gramian", R"(0 < \beta_1, \quad \beta_1 I \le \mathcal{O} \text{ for every sequence of estimates})",
      zero(), {"the smallest eigenvalue of the Gramian at z = 0", singular}));
  const Interval far = pow(Interval(2.0), 500);
  derivation.conditions.push_back(compare(
      "bounded-F",
      R"(\sup_x \lVert F(x) \rVert < \infty \text{, so } \lVert F(x) \rVert < |z| \text{ for large } |z|)",
      {"|F| at |z| = 2^500", first_derivative_norm(far, input.epsilon)}, {"|z|", far}));
  add_guarantee(derivation, {Interval::empty(), Interval::empty(), Interval::empty()}, kSongGrizzleTheorems,
                "The theorem is for signals without noise.");
  derivation.notes.emplace_back(
      "The assumptions concern every state; song-grizzle/local evaluates the argument near the signal.");
  conclude(derivation);
  return derivation;
}

Derivation evaluate_song_grizzle_local(const TrackerInput& unchecked) {
  const rigor::UpwardRounding upward;
  const TrackerInput input = with_finite_members(unchecked);
  const auto start = [](const LocalConstants& c) {
    return c.largest_error / sqrt(c.p * c.q) / c.equation.transition;
  };
  const Interval radius =
      best_radius([&](const Interval& candidate) { return start(local_constants(input, candidate)); });
  const LocalConstants c = local_constants(input, radius);
  const ErrorEquation& equation = c.equation;
  const Interval one(1.0);
  const Interval growth = c.p * c.largest_error * c.phi *
                          (Interval(2.0) * c.p * c.q * equation.transition + c.phi * c.largest_error);
  const Interval gamma = c.decrease - growth;

  Derivation derivation;
  derivation.id = "song-grizzle/local";
  derivation.title = "The argument of Song and Grizzle (1993), suprema over the states near the signal";
  const std::string divides = "It divides by min(q_1, q_2), which may be 0 in this design.";
  add_error_equation(derivation, equation);
  add_quantity(derivation,
               {"p", "p", R"(\lvert P(k \mid k-1)^{-1} \rvert \le p = 1/\underline q)", kSongGrizzleTheorems},
               c.p, divides);
  add_quantity(derivation,
               {"q", "q", R"(\lvert P(k \mid k-1) \rvert \le q = \bar a^2 \bar p + \max(q_1, q_2))",
                kSongGrizzleTheorems},
               c.q);
  add_quantity(
      derivation,
      {"r", "r",
       R"(\lvert P(k \mid k)^{-1} + F' Q^{-1} F \rvert \le r = 1/\underline p + \bar a^2/\underline q)",
       kSongGrizzleTheorems},
      c.r, divides);
  add_quantity(derivation, {"phi", R"(\phi)", R"(\frac{1}{2} \kappa_f (pq)^2)", kSongGrizzleTheorems}, c.phi,
               divides);
  add_quantity(derivation, {"prediction_error", R"(q^{1/2} V(0, e_0)^{1/2})", "", kSongGrizzleTheorems},
               c.largest_error, divides);
  add_quantity(derivation, {"gamma", R"(\gamma)", R"(-\varphi)", kSongGrizzleTheorems}, gamma, divides);
  add_guarantee(derivation, {start(c), Interval::empty(), sqrt(one - gamma / c.p)}, kSongGrizzleTheorems,
                "The theorem is for signals without noise.");
  const AssumedNoise noise = assumed_noise(input);
  derivation.conditions = {
      start_covariance(input, equation),
      compare("varphi", R"(\varphi(q^{1/2}V(0, e_0)^{1/2}, \kappa_f, 0) < 0)",
              {"the growth by curvature", growth}, {"1/(r q^2)", c.decrease}),
      compare("noise-free", R"(w(k) = 0, \quad v(k) = 0)",
              {"the largest |w| + |v| allowed", noise.process + noise.measurement}, zero(), Strictness::weak),
      start_error(input, R"(\frac{q^{1/2} V(0, e_0)^{1/2}}{\bar a (pq)^{1/2}})", start(c))};
  derivation.notes.emplace_back(
      "The theorem concerns the prediction error; the first prediction multiplies an initial filtered error "
      "by at most a_bar.");
  conclude(derivation);
  return derivation;
}

}  // namespace veritrack::theorems

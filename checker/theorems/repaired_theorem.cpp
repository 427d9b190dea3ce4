#include "checker/theorems/repaired_theorem.hpp"

#include "checker/theorems/error_bounds.hpp"
#include "checker/theorems/signal_model.hpp"
#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

void add_start(Derivation& found, const ErrorBounds& tube, const Design& d) {
  const Ball start = tube.radius / sqrt(tube.q());
  const std::vector<Quantity> quantities{
      {"window", Ball(tube.window)},
      {"epsilon_r", tube.plane},
      {"rho_1", first_derivative_norm(one + tube.plane, d.epsilon)},
      {"p", tube.p()},
      {"q", tube.q()},
      {"s", tube.s, Sense::bounds_above},
      {"beta", sqrt(tube.p() * tube.q())},
      {"one_minus_alpha", tube.one_minus_alpha, Sense::bounds_below},
      {"curvature", tube.curvature, Sense::bounds_above},
      {"process_gain", tube.process_gain, Sense::bounds_above},
      {"measurement_gain", tube.measurement_gain, Sense::bounds_above},
      {"radius", tube.radius},
      {"epsilon_z", sqrt(tube.p()) * tube.radius},
      {"initial_error_bound", start},
      {"initial_frequency_error_bound", tube.radius / sqrt(tube.information[2][2])},
      {"rate", one - tube.one_minus_alpha, Sense::bounds_above}};
  found.quantities.insert(found.quantities.end(), quantities.begin(), quantities.end());
}

void check_feasibility(const Tree& claimed, const std::optional<ErrorBounds>& noise, const Design& d,
                       Objections& objections) {
  const Verdict verdict = verdict_from(claimed.at("verdict").text());
  if (claimed.at("every_design").truth()) {
    objections.emplace_back("feasibility: not shown for every design");
  }
  if (verdict == Verdict::refuted) {
    // F P F' <= mu Q for no mu: alpha = 1, and no radius tolerates any noise.
    check_verdict("refuted", certainly_equal(d.q1, zero) ? Verdict::refuted : Verdict::undecided,
                  "feasibility", objections);
    if (const Tree* bound = claimed.find("lower_bound")) {
      check_enclosure(*bound, {"lower_bound", one}, objections);
    }
    return;
  }
  if (!noise) {
    objections.emplace_back("feasibility: no tube in the evidence tolerates noise");
    return;
  }
  const Tree& witness = claimed.at("witness");
  const Ball w = read_enclosure(witness.at("c_1"), "c_1", objections) * sqrt(d.q2);
  const Ball v = read_enclosure(witness.at("c_2"), "c_2", objections) * sqrt(d.r);
  const Ball start = noise->radius / sqrt(noise->q());
  const bool is_proved = certainly_positive(w) && certainly_positive(v) && certainly_positive(start) &&
                         noise->invariant(noise->disturbance(w, v));
  check_verdict("proved", proved_if(is_proved), "feasibility", objections);
  check_enclosure(witness.at("window"), {"window", Ball(noise->window)}, objections);
  check_enclosure(witness.at("epsilon_r"), {"epsilon_r", noise->plane}, objections);
  check_enclosure(witness.at("frequency_tube"), {"frequency_tube", noise->frequency}, objections);
  check_enclosure(witness.at("radius"), {"radius", noise->radius}, objections);
  check_enclosure(witness.at("initial_error_bound"), {"initial_error_bound", start}, objections);
  if (witness.members().size() != 7) {
    objections.emplace_back("feasibility: the witness contains more than was checked");
  }
}

}  // namespace

std::string check_repaired_theorem(const Tree& claimed, const Design& d, Objections& objections) {
  const std::optional<ErrorBounds> start = verified_error_bounds(claimed, "start", d, objections);
  const std::optional<ErrorBounds> noise = verified_error_bounds(claimed, "noise", d, objections);
  const std::optional<ErrorBounds> process = verified_error_bounds(claimed, "process-noise", d, objections);
  const std::optional<ErrorBounds> assumed = verified_error_bounds(claimed, "assumed", d, objections);
  const Ball nothing = Ball::everything();
  Derivation found;
  found.title = "Theorem 2.9 repaired: error and noise bounds with every gap of the proof closed";
  found.quantities = {{"delta_1", d.q1}, {"delta_2", d.r}};
  if (start && start->invariant(zero)) {
    add_start(found, *start, d);
  }
  if (noise && noise->invariant(zero)) {
    found.quantities.push_back(
        {"noise_bound", noise->tolerated() / noise->measurement_gain, Sense::bounds_below});
  }
  if (process && process->invariant(zero)) {
    found.quantities.push_back(
        {"process_noise_bound", process->tolerated() / process->process_gain, Sense::bounds_below});
  }
  const Ball smallest = min(d.q1, d.q2);
  found.conditions = {
      {"Q", "0 < Q", decide_less(zero, smallest), zero, smallest},
      {"epsilon", R"(0 \le \epsilon < 1)",
       all_of({decide_at_most(zero, d.epsilon), decide_less(d.epsilon, one)}), d.epsilon, one},
      {"invariance", R"(\alpha R + c R^2 + g_w \lVert w \rVert + g_v \lVert v \rVert \le R)"},
      {"P(0|0)", R"(q^{-1} I \le P(k|k) \le p I \text{ from } k = 0)"},
      {"2.45", R"(\lvert e_0 \rvert \le q^{-1/2} R)"}};
  if (assumed) {
    const Ball disturbance = assumed->disturbance(d.epsilon * d.largest_frequency + d.slew, d.noise);
    const Ball start_error = assumed->radius / sqrt(assumed->q());
    Condition& invariance = found.conditions[2];
    invariance.verdict = proved_if(assumed->invariant(disturbance));
    invariance.lhs = (one - assumed->one_minus_alpha) * assumed->radius +
                     assumed->curvature * square(assumed->radius) + disturbance;
    invariance.lhs_sense = Sense::bounds_above;
    invariance.rhs = assumed->radius;
    // Without a leak the steady state lies in every order interval that the filter keeps.
    const bool in_range = d.covariance
                              ? assumed->window == 0 &&
                                    definite(assumed->upper - d.highest_covariance.value_or(*d.covariance)) &&
                                    definite(*d.covariance - inverse(assumed->information))
                              : d.without_leak() && !d.covariance_multiples;
    found.conditions[3].verdict = proved_if(in_range);
    Condition& initial = found.conditions[4];
    initial.lhs = largest_initial_error(d);
    initial.rhs = start_error;
    initial.verdict = proved_if(certainly_at_most(largest_initial_error(d), start_error));
    const bool assured = assumed->invariant(disturbance) && in_range && initial.verdict == Verdict::proved;
    const Ball room = square(assumed->one_minus_alpha) - four * assumed->curvature * disturbance;
    const Ball ultimate = two * disturbance / (assumed->one_minus_alpha + sqrt(room));
    const Ball gain = assumed->frequency_gain();
    found.quantities.push_back({"frequency_error_bound", assured ? gain * assumed->radius : nothing});
    found.quantities.push_back(
        {"ultimate_frequency_error", assured ? gain * ultimate : nothing, Sense::bounds_above});
  }
  std::string title = check_derivation(claimed, found, objections);
  if (const Tree* feasibility = claimed.find("feasibility")) {
    check_feasibility(*feasibility, noise, d, objections);
  }
  return title;
}

}  // namespace veritrack::checker

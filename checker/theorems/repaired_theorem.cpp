#include "checker/theorems/repaired_theorem.hpp"

#include "checker/numbers/matrix3.hpp"
#include "checker/theorems/signal_model.hpp"
#include "checker/theorems/theorem_2_9.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball half(0.5);
const Ball one(1.0);
const Ball two(2.0);

/// One tube with its recursion, as the evidence gives it. In use only when it is verified.
struct Tube {
  Ball plane, frequency;  ///< |z(k|k) - z(k)| and |x3(k|k) - x3(k)| at most
  Ball one_minus_alpha, curvature, process_gain, measurement_gain, s, radius;
  Matrix3 upper, information;  ///< P(k|k) <= upper, P(k|k)^-1 <= information
  [[nodiscard]] Ball plane_gain() const {
    return sqrt(larger_eigenvalue(upper[0][0], upper[1][0], upper[1][1]));
  }
  [[nodiscard]] Ball frequency_gain() const { return sqrt(upper[2][2]); }
  [[nodiscard]] Ball p() const { return extreme_eigenvalues(upper).high; }
  [[nodiscard]] Ball q() const { return extreme_eigenvalues(information).high; }
  [[nodiscard]] Ball disturbance(const Ball& w, const Ball& v) const {
    return process_gain * w + measurement_gain * v;
  }
  /// alpha R + c R^2 + d <= R, and R keeps the estimate in the tube.
  [[nodiscard]] bool invariant(const Ball& disturbance) const {
    return certainly_positive(radius) && certainly_at_most(radius, plane / plane_gain()) &&
           certainly_at_most(radius, frequency / frequency_gain()) &&
           certainly_at_most(curvature * square(radius) + disturbance, one_minus_alpha * radius);
  }
  /// The largest disturbance that its radius bears.
  [[nodiscard]] Ball borne() const { return one_minus_alpha * radius - curvature * square(radius); }
};

/// (P^-1 + H'H/r)^-1, H = [I 0].
Matrix3 updated(const Matrix3& p, const Ball& r) {
  const Ball s11 = p[0][0] + r;
  const Ball s22 = p[1][1] + r;
  const Ball& s12 = p[1][0];
  const Ball determinant = s11 * s22 - square(s12);
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result[i][j] =
          p[i][j] - (p[i][0] * (s22 * p[j][0] - s12 * p[j][1]) + p[i][1] * (s11 * p[j][1] - s12 * p[j][0])) /
                        determinant;
      result[j][i] = result[i][j];
    }
  }
  return result;
}

/// Walks the amplitudes rho and turns theta that occur in the tube.
class TubeCheck {
 public:
  TubeCheck(const Tube& tube, const Design& design)
      : tube_(tube),
        design_(design),
        lower_(inverse(tube.information)),
        noise_(diagonal(design.q1, design.q1, design.q2)),
        alpha2_(square(one - tube.one_minus_alpha)) {}

  [[nodiscard]] bool holds() const {
    Ball turn;
    arb_asin(turn.raw(), tube_.plane.raw(), precision());
    turn = two * turn + tube_.frequency;
    const double half_turn = turn.upper_double();
    const double width = tube_.plane.upper_double();
    return definite(lower_) && definite(tube_.upper - lower_) && certainly_less(turn, one) &&
           holds_over(-width, width, -half_turn, half_turn, kDepth);
  }

 private:
  static constexpr int kDepth = 12;

  [[nodiscard]] bool holds_over(double a_low, double a_high, double turn_low, double turn_high,
                                int depth) const {
    if (holds_at(one + Ball::hull(Ball(a_low), Ball(a_high)), Ball::hull(Ball(turn_low), Ball(turn_high)))) {
      return true;
    }
    if (depth == 0) {
      return false;
    }
    const double a = 0.5 * (a_low + a_high);
    const double turn = 0.5 * (turn_low + turn_high);
    return depth % 2 == 0 ? holds_over(a_low, a, turn_low, turn_high, depth - 1) &&
                                holds_over(a, a_high, turn_low, turn_high, depth - 1)
                          : holds_over(a_low, a_high, turn_low, turn, depth - 1) &&
                                holds_over(a_low, a_high, turn, turn_high, depth - 1);
  }

  [[nodiscard]] bool holds_at(const Ball& rho, const Ball& turn) const {
    const Ball kept = one - design_.epsilon;
    const Ball c = cos(turn);
    const Ball s = sin(turn);
    // F(rho) U(turn).
    const Matrix3 step{{{c, -s, zero}, {s, c, rho}, {zero, zero, kept}}};
    const Matrix3 carried = congruent(step, tube_.upper);
    const Matrix3 most = carried + noise_;
    const Matrix3 least = congruent(step, lower_) + noise_;
    if (!definite(tube_.upper - updated(most, design_.r)) || !definite(updated(least, design_.r) - lower_)) {
      return false;
    }
    // F U P U' F' < mu Q with alpha^2 = mu/(1 + mu).
    const Ball mu = alpha2_ / (one - alpha2_);
    if (!definite(diagonal(mu * design_.q1, mu * design_.q1, mu * design_.q2) - carried) ||
        !definite(diagonal(tube_.s, tube_.s, tube_.s) - most)) {
      return false;
    }
    // g_v^2 = 1/r - 1/innovation, g_w^2 = (L^-1)_33, and the weight of the curvature is the norm of
    // (L^-1)_zz.
    const Ball innovation = one / (one / design_.r - square(tube_.measurement_gain)) - design_.r;
    const Ball weight =
        square(tube_.curvature / (half * tube_.upper[2][2] + tube_.frequency_gain() * tube_.plane_gain()));
    const Matrix3 over = inverse(least);
    const SquareMatrix<2> seen{{{innovation - most[0][0], zero}, {-most[1][0], innovation - most[1][1]}}};
    const SquareMatrix<2> plane{{{weight - over[0][0], zero}, {-over[1][0], weight - over[1][1]}}};
    return definite(seen) && definite(plane) && certainly_less(over[2][2], square(tube_.process_gain));
  }

  const Tube& tube_;
  const Design& design_;
  Matrix3 lower_, noise_;
  Ball alpha2_;
};

/// The tube of this name, verified; none when the evidence has none, or it does not hold.
std::optional<Tube> verified_tube(const Tree& derivation, const std::string& name, const Design& design,
                                  Objections& objections) {
  const Tree* evidence = derivation.find("evidence");
  if (evidence == nullptr) {
    return std::nullopt;
  }
  for (const Tree& item : evidence->elements()) {
    if (item.at("name").text() != name) {
      continue;
    }
    const auto number = [&](const char* key) { return from_hexadecimal(item.at("numbers").at(key).text()); };
    const auto matrix = [&](const char* key) {
      Matrix3 result;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          result[i][j] = from_hexadecimal(item.at("matrices").at(key).at(i).at(j).text());
        }
      }
      return result;
    };
    const Tube tube{number("plane_error"),
                    number("frequency_error"),
                    number("one_minus_alpha"),
                    number("curvature"),
                    number("process_gain"),
                    number("measurement_gain"),
                    number("s"),
                    number("radius"),
                    matrix("covariance_upper"),
                    matrix("information_upper")};
    bool sensible = certainly_equal(number("window"), zero) && certainly_positive(tube.plane) &&
                    certainly_less(tube.plane, one) && certainly_positive(tube.frequency) &&
                    certainly_positive(tube.one_minus_alpha) && certainly_less(tube.one_minus_alpha, one) &&
                    certainly_positive(tube.curvature) && certainly_positive(tube.process_gain) &&
                    certainly_positive(tube.measurement_gain) && certainly_positive(design.q1) &&
                    certainly_at_most(zero, design.epsilon) && certainly_less(design.epsilon, one);
    for (const Matrix3* m : {&tube.upper, &tube.information}) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          sensible = sensible && certainly_equal((*m)[i][j], (*m)[j][i]);
        }
      }
    }
    if (sensible && TubeCheck(tube, design).holds()) {
      return tube;
    }
    objections.push_back("the tube \"" + name + "\" is not certainly what its evidence says");
  }
  return std::nullopt;
}

void add_start(Derivation& found, const Tube& tube, const Design& d) {
  const Ball start = tube.radius / sqrt(tube.q());
  const std::vector<Quantity> quantities{
      {"window", zero},
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

void check_feasibility(const Tree& claimed, const std::optional<Tube>& noise, const Design& d,
                       Objections& objections) {
  const Verdict verdict = verdict_from(claimed.at("verdict").text());
  if (verdict == Verdict::undecided) {
    return;
  }
  if (claimed.at("every_design").truth()) {
    objections.emplace_back("feasibility: not shown for every design");
  }
  if (verdict == Verdict::refuted) {
    // F P F' <= mu Q holds for no mu: alpha = 1, and no radius bears any noise.
    check_verdict("refuted", certainly_equal(d.q1, zero) ? Verdict::refuted : Verdict::undecided,
                  "feasibility", objections);
    if (const Tree* bound = claimed.find("lower_bound")) {
      check_enclosure(*bound, {"lower_bound", one}, objections);
    }
    return;
  }
  if (!noise) {
    objections.emplace_back("feasibility: no tube in the evidence bears noise");
    return;
  }
  const Tree& witness = claimed.at("witness");
  const Ball w = read_enclosure(witness.at("c_1"), "c_1", objections) * sqrt(d.q2);
  const Ball v = read_enclosure(witness.at("c_2"), "c_2", objections) * sqrt(d.r);
  const Ball start = noise->radius / sqrt(noise->q());
  const bool holds = certainly_positive(w) && certainly_positive(v) && certainly_positive(start) &&
                     noise->invariant(noise->disturbance(w, v));
  check_verdict("proved", proved_if(holds), "feasibility", objections);
  check_enclosure(witness.at("window"), {"window", zero}, objections);
  check_enclosure(witness.at("epsilon_r"), {"epsilon_r", noise->plane}, objections);
  check_enclosure(witness.at("frequency_tube"), {"frequency_tube", noise->frequency}, objections);
  check_enclosure(witness.at("radius"), {"radius", noise->radius}, objections);
  check_enclosure(witness.at("initial_error_bound"), {"initial_error_bound", start}, objections);
  if (witness.members().size() != 7) {
    objections.emplace_back("feasibility: the witness holds more than was checked");
  }
}

}  // namespace

void check_repaired_theorem(const Tree& claimed, const Design& d, Objections& objections) {
  const std::optional<Tube> start = verified_tube(claimed, "start", d, objections);
  const std::optional<Tube> noise = verified_tube(claimed, "noise", d, objections);
  const std::optional<Tube> process = verified_tube(claimed, "process-noise", d, objections);
  const std::optional<Tube> assumed = verified_tube(claimed, "assumed", d, objections);
  const Ball nothing = Ball::everything();
  Derivation found;
  found.title = "Theorem 2.9 repaired: error and noise bounds with every gap of the proof closed";
  found.quantities = {{"delta_1", d.q1}, {"delta_2", d.r}};
  if (start && start->invariant(zero)) {
    add_start(found, *start, d);
  }
  if (noise && noise->invariant(zero)) {
    found.quantities.push_back(
        {"noise_bound", noise->borne() / noise->measurement_gain, Sense::bounds_below});
  }
  if (process && process->invariant(zero)) {
    found.quantities.push_back(
        {"process_noise_bound", process->borne() / process->process_gain, Sense::bounds_below});
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
    const bool in_range = d.covariance ? definite(assumed->upper - *d.covariance) &&
                                             definite(*d.covariance - inverse(assumed->information))
                                       : certainly_equal(d.epsilon, zero);
    found.conditions[3].verdict = proved_if(in_range);
    Condition& initial = found.conditions[4];
    initial.lhs = largest_initial_error(d);
    initial.rhs = start_error;
    initial.verdict = proved_if(certainly_at_most(largest_initial_error(d), start_error));
    const bool assured = assumed->invariant(disturbance) && in_range && initial.verdict == Verdict::proved;
    const Ball room = square(assumed->one_minus_alpha) - Ball(4.0) * assumed->curvature * disturbance;
    const Ball ultimate = two * disturbance / (assumed->one_minus_alpha + sqrt(room));
    const Ball gain = assumed->frequency_gain();
    found.quantities.push_back({"frequency_error_bound", assured ? gain * assumed->radius : nothing});
    found.quantities.push_back(
        {"ultimate_frequency_error", assured ? gain * ultimate : nothing, Sense::bounds_above});
  }
  check_derivation(claimed, found, objections);
  if (const Tree* feasibility = claimed.find("feasibility")) {
    check_feasibility(*feasibility, noise, d, objections);
  }
}

}  // namespace veritrack::checker

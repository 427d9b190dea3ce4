#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/signal_model.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"

namespace veritrack::theorems::gaps {

namespace {

using rigor::Interval;
using rigor::IntervalVector;

IntervalVector<3> state(double in_phase, double quadrature, double frequency) {
  return rigor::to_interval(Eigen::Vector3d(in_phase, quadrature, frequency));
}

/// A bound against the exact supremum over |x| <= R_x + eps_r, which is attained at |z| = R_x + eps_r.
Statement supremum_statement(const std::string& name, const std::string& derivative, const Reading& reading,
                             const Interval& exact, const Interval& bound) {
  return make_statement(gap_id(name, reading.name),
                        "||" + derivative + "|| <= " + name + " for all |x| <= R_x + eps_r.",
                        decide_less_equal(exact, bound),
                        "The exact supremum, at |x1 + i x2| = R_x + eps_r, is " + enclosed(exact) + "; " +
                            name + " is " + enclosed(bound) + ".",
                        {evidence("supremum", R"(\sup \lVert \cdot \rVert)", "", exact),
                         evidence(name, "\\" + name, "", bound)});
}

/// (2.33) needs a Lipschitz constant of the second derivative and takes that of the first.
Statement remainder_in_general() {
  // f'(x) = -cos(8x)/8 has the Lipschitz constant 1, the remainder at 0 and 1/8 is (1 - cos 1)/8.
  const Interval remainder = (Interval(1.0) - rigor::cos(Interval(1.0))) / Interval(8.0);
  const Interval bound = square(Interval(0.125)) / Interval(2.0);
  return make_statement(
      gap_id("remainder-constant", "general"),
      "A Lipschitz constant rho_4 of the first derivative gives (2.33), |f'(x1) - f'(x2) - f''(x2)(x1 - x2)| "
      "<= rho_4 |x1 - x2|^2 / 2.",
      decide_less_equal(remainder, bound),
      "f'(x) = -cos(8x)/8, rho_4 = 1, x1 = 1/8, x2 = 0: the left side is " + enclosed(remainder) +
          ", the right side " + enclosed(bound) + ".",
      {evidence("remainder", "", "", remainder), evidence("claimed_bound", "", "", bound)});
}

/// For the tracker the number happens to be large enough for both meanings.
Statement remainder_for_tracker(const Reading& reading) {
  const Interval ball = reading.constants.state_bound + reading.constants.epsilon_r;
  const Interval second = second_derivative_norm(ball);
  const Interval third = third_derivative_norm(ball);
  const Interval& bound = reading.constants.rho_4;
  return make_statement(
      gap_id("remainder-constant", reading.name),
      "The rho_4 of section 3.5 is a Lipschitz constant of df/dx (above (2.33)) and of the second derivative "
      "(which (2.33) needs) for all |x| <= R_x + eps_r.",
      rigor::conjunction({decide_less_equal(second, bound), decide_less_equal(third, bound)}),
      "The exact Lipschitz constants are " + enclosed(second) + " and " + enclosed(third) + "; rho_4 is " +
          enclosed(bound) + ".",
      {evidence("lipschitz_of_first_derivative", "", R"(\sup\lVert \partial^2 f \rVert)", second),
       evidence("lipschitz_of_second_derivative", "", R"(\sup\lVert \partial^3 f \rVert)", third),
       evidence("rho_4", R"(\rho_4)", "", bound)});
}

/// The proof of Theorem 2.8 has the second-order remainder B in place of F_x - F_zbar.
Statement decomposition_printed() {
  // x = (1, 0, 0), z = (0, 0, 1/2), zbar = (1, 0, -1/2); entry (1,1) of F is cos x3.
  const Interval half(0.5);
  const auto [sine, cosine] = rigor::sin_cos(half);
  const Interval difference = Interval(1.0) - cosine;
  const Interval remainder = difference - half * sine;
  return make_statement(
      gap_id("decomposition", "printed"),
      "F_x(k) = F_zbar(k) + B(k) with B(k) = F_x - F_zbar - (d^2 f/dx^2)(zbar) z (proof of Theorem 2.8), to "
      "nine digits.",
      decide_less_equal(abs(difference - remainder), Interval(1e-9)),
      "x = (1, 0, 0), z = (0, 0, 1/2): entry (1,1) of F_x - F_zbar is " + enclosed(difference) +
          ", of B it is " + enclosed(remainder) + ".",
      {evidence("difference_entry", "", R"(1 - \cos\frac{1}{2})", difference),
       evidence("remainder_entry", "", R"(1 - \cos\frac{1}{2} - \frac{1}{2}\sin\frac{1}{2})", remainder)});
}

Statement decomposition_repaired(const Readings& readings) {
  const Theorem29Constants& c = readings.printed();
  const Interval exact = second_derivative_norm(c.state_bound + c.epsilon_r);
  return make_statement(
      gap_id("decomposition", "repaired"),
      "||F_x(k) - F_zbar(k)|| <= rho_4 |z(k)| for all |x| <= R_x, |z| <= eps_r (the mean value theorem).",
      decide_less_equal(exact, c.rho_4),
      "The supremum of ||d^2 f/dx^2|| over the segments from x to x - z is at most " + at_most(exact) +
          "; rho_4 is " + enclosed(c.rho_4) + ".",
      {evidence("supremum", R"(\sup\lVert \partial^2 f \rVert)", "", exact),
       evidence("rho_4", R"(\rho_4)", "", c.rho_4)});
}

/// e(k+1|k) = F_x e -+ kappa_f(x, -e) at x = (1, 0, 0), e = (0, 0, 1/2): the first component.
Statement sign_statement(const std::string& place, const std::string& sign, double factor,
                         const Readings& readings) {
  const Interval& epsilon = readings.input.epsilon;
  const IntervalVector<3> x = state(1.0, 0.0, 0.0);
  const IntervalVector<3> error = state(0.0, 0.0, 0.5);
  const Interval moved = transition(x, epsilon)(0) - transition(x - error, epsilon)(0);
  // F_x e has the first component 0: the third column of F_x is (0, 1, 1 - epsilon).
  const Interval kappa = transition(x - error, epsilon)(0) - transition(x, epsilon)(0);
  const Interval claimed = Interval(factor) * kappa;
  return make_statement(gap_id("remainder-sign", place),
                        "f(x) - f(x - e) = F_x e " + sign +
                            " kappa_f(x, -e), to nine digits, at x = (1, 0, 0), e = (0, 0, 1/2).",
                        decide_less_equal(abs(moved - claimed), Interval(1e-9)),
                        "First components there: f(x) - f(x - e) is " + enclosed(moved) +
                            ", F_x e is 0, kappa_f is " + enclosed(kappa) + ".",
                        {evidence("moved", "", R"(1 - \cos\frac{1}{2})", moved),
                         evidence("kappa_f", R"(\kappa_f)", R"(\cos\frac{1}{2} - 1)", kappa)});
}

}  // namespace

std::vector<Statement> derivative_gaps(const Readings& readings) {
  std::vector<Statement> statements;
  for (const Reading& reading : readings.each) {
    const Theorem29Constants& c = reading.constants;
    const Interval ball = c.state_bound + c.epsilon_r;
    statements.push_back(supremum_statement("rho_1", "df/dx", reading,
                                            first_derivative_norm(ball, readings.input.epsilon), c.rho_1));
    statements.push_back(
        supremum_statement("rho_2", "d^2 f/dx^2", reading, second_derivative_norm(ball), c.rho_2));
    statements.push_back(
        supremum_statement("rho_3", "d^3 f/dx^3", reading, third_derivative_norm(ball), c.rho_3));
  }
  statements.push_back(remainder_in_general());
  for (const Reading& reading : readings.each) {
    statements.push_back(remainder_for_tracker(reading));
  }
  statements.push_back(decomposition_printed());
  statements.push_back(decomposition_repaired(readings));
  statements.push_back(sign_statement("2.12", "-", -1.0, readings));
  statements.push_back(sign_statement("theorem-2.9", "+", 1.0, readings));
  return statements;
}

}  // namespace veritrack::theorems::gaps

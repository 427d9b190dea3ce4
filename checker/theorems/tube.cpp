#include "checker/theorems/tube.hpp"

namespace veritrack::checker {

namespace {

const Ball zero(0.0);
const Ball half(0.5);
const Ball one(1.0);
const Ball two(2.0);

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

}  // namespace

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

}  // namespace veritrack::checker

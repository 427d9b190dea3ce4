#include "checker/theorems/error_bounds.hpp"

#include <algorithm>
#include <functional>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

/// (P^-1 + H'H/r)^-1, H = [I 0]: r I - r^2 S^-1 in the plane, without the cancellation of P - P H' S^-1 H P.
Matrix3 updated(const Matrix3& p, const Ball& r) {
  const Ball s11 = p[0][0] + r;
  const Ball s22 = p[1][1] + r;
  const Ball& s12 = p[1][0];
  const Ball over = one / (s11 * s22 - square(s12));
  const Ball k1 = (p[2][0] * s22 - p[2][1] * s12) * over;
  const Ball k2 = (p[2][1] * s11 - p[2][0] * s12) * over;
  Matrix3 result;
  result[0][0] = r - square(r) * s22 * over;
  result[1][0] = result[0][1] = square(r) * s12 * over;
  result[1][1] = r - square(r) * s11 * over;
  result[2][0] = result[0][2] = r * k1;
  result[2][1] = result[1][2] = r * k2;
  result[2][2] = p[2][2] - (k1 * p[2][0] + k2 * p[2][1]);
  return result;
}

/// Walks the amplitudes rho and turns theta that occur in the tube.
class ErrorBoundsCheck {
 public:
  ErrorBoundsCheck(const ErrorBounds& tube, const Design& design)
      : tube_(tube),
        design_(design),
        lower_(inverse(tube.information)),
        noise_(diagonal(design.q1, design.q1, design.q2)),
        alpha2_(square(one - tube.one_minus_alpha)) {}

  [[nodiscard]] bool is_proved() const {
    return definite(lower_) && definite(tube_.upper - lower_) &&
           (tube_.window == 0 ? keeps_bounds() : window_is_proved()) &&
           everywhere([&](const Matrix3& step) { return constants_are_proved(step); });
  }

 private:
  static constexpr int kDepth = 16;
  /// F(rho) U(turn), for all of a box.
  using Predicate = std::function<bool(const Matrix3& step)>;

  [[nodiscard]] Matrix3 step(const Ball& rho, const Ball& turn) const {
    const Ball c = cos(turn);
    const Ball s = sin(turn);
    return {{{c, -s, zero}, {s, c, rho}, {zero, zero, one - design_.epsilon}}};
  }

  /// For all amplitudes and turns of the tube.
  [[nodiscard]] bool everywhere(const Predicate& predicate) const {
    const Ball turn = two * arcsine(tube_.plane) + tube_.frequency;
    const double half_turn = turn.upper_double();
    const double width = tube_.plane.upper_double();
    // cannot bind (turn): larger turns are also examined, and those that are not finite prove nothing.
    return certainly_less(turn, one) && is_true_over(predicate, -width, width, -half_turn, half_turn, kDepth);
  }

  [[nodiscard]] bool is_true_over(const Predicate& predicate, double a_low, double a_high, double turn_low,
                                  double turn_high, int depth) const {
    if (predicate(
            step(one + Ball::hull(Ball(a_low), Ball(a_high)), Ball::hull(Ball(turn_low), Ball(turn_high))))) {
      return true;
    }
    if (depth == 0) {
      return false;
    }
    const double a = 0.5 * (a_low + a_high);
    const double turn = 0.5 * (turn_low + turn_high);
    return depth % 2 == 0 ? is_true_over(predicate, a_low, a, turn_low, turn_high, depth - 1) &&
                                is_true_over(predicate, a, a_high, turn_low, turn_high, depth - 1)
                          : is_true_over(predicate, a_low, a_high, turn_low, turn, depth - 1) &&
                                is_true_over(predicate, a_low, a_high, turn, turn_high, depth - 1);
  }

  /// P(k+1|k+1) of a P(k|k).
  [[nodiscard]] Matrix3 after(const Matrix3& step, const Matrix3& p) const {
    return updated(congruent(step, p) + noise_, design_.r);
  }
  /// P(2|2)^-1 at least, whatever P(0|0): P(1|1)^-1 >= H'H/r =: I, and (G I^-1 G' + Q)^-1 is, by Woodbury's
  /// formula, Q^-1 - Q^-1 G (I + G'Q^-1 G)^-1 G'Q^-1.
  [[nodiscard]] Matrix3 second_information(const Matrix3& step) const {
    const Matrix3 seen = diagonal(one / design_.r, one / design_.r, zero);
    const Matrix3 weight = diagonal(one / design_.q1, one / design_.q1, one / design_.q2);
    Matrix3 transposed;
    Matrix3 weighted;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        transposed[i][j] = step[j][i];
        weighted[i][j] = weight[i][i] * step[i][j];
      }
    }
    return weight - congruent(weighted, inverse(seen + congruent(transposed, weight))) + seen;
  }

  /// The order interval is mapped to itself.
  [[nodiscard]] bool keeps_bounds() const {
    return everywhere([&](const Matrix3& step) {
      return definite(tube_.upper - after(step, tube_.upper)) && definite(after(step, lower_) - lower_);
    });
  }

  /// After window + 1 updates from any P >= 0 the covariance is in its bounds: update by update, between
  /// matrices near those of exact estimates, with more room than the tube takes.
  [[nodiscard]] bool window_is_proved() const {
    bool above = false;
    bool below = false;
    for (const double room : {0x1p-20, 0x1p-16, 0x1p-13, 0x1p-10, 0x1p-7, 0x1p-4}) {
      above = above || stays_below_upper(room);
      below = below || stays_above_lower(room);
    }
    return above && below;
  }
  [[nodiscard]] bool stays_below_upper(double room) const {
    Matrix3 p;
    bool below = false;
    for (int k = 1; k <= tube_.window && !below; ++k) {
      const Matrix3 exact = k == 1 ? inverse(second_information(step(one, zero))) : after(step(one, zero), p);
      const Matrix3 next = scaled(exact, 1.0 + room);
      const Matrix3 information = inverse(next);
      if (!everywhere([&](const Matrix3& step) {
            return k == 1 ? definite(second_information(step) - information)
                          : definite(next - after(step, p));
          })) {
        return false;
      }
      p = next;
      below = definite(tube_.upper - p);
    }
    return below;
  }
  [[nodiscard]] bool stays_above_lower(double room) const {
    Matrix3 p = updated(noise_, design_.r);
    bool above = definite(p - lower_);
    for (int k = 1; k <= tube_.window && !above; ++k) {
      const Matrix3 next = scaled(after(step(one, zero), p), 1.0 - room);
      if (!everywhere([&](const Matrix3& step) { return definite(after(step, p) - next); })) {
        return false;
      }
      p = next;
      above = definite(p - lower_);
    }
    return above;
  }
  /// A symmetric matrix of exact numbers near `factor` times this one.
  static Matrix3 scaled(const Matrix3& p, double factor) {
    Matrix3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        result[i][j] = Ball(factor * p[i][j].near());
        result[j][i] = result[i][j];
      }
    }
    return result;
  }

  [[nodiscard]] bool constants_are_proved(const Matrix3& step) const {
    const Matrix3 carried = congruent(step, tube_.upper);
    const Matrix3 most = carried + noise_;
    const Matrix3 least = congruent(step, lower_) + noise_;
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

  const ErrorBounds& tube_;
  const Design& design_;
  Matrix3 lower_, noise_;
  Ball alpha2_;
};

}  // namespace

std::optional<ErrorBounds> verified_error_bounds(const Tree& derivation, const std::string& name,
                                                 const Design& design, Objections& objections) {
  const Tree* item = find_evidence(derivation, name);
  if (item == nullptr) {
    return std::nullopt;
  }
  const auto number = [&](const char* key) { return exact_number(item->at("numbers").at(key)); };
  const auto matrix = [&](const char* key) { return exact_matrix(item->at("matrices").at(key)); };
  const double window = number("window").near();
  const ErrorBounds tube{number("plane_error"),
                         number("frequency_error"),
                         number("one_minus_alpha"),
                         number("curvature"),
                         number("process_gain"),
                         number("measurement_gain"),
                         number("s"),
                         number("radius"),
                         matrix("covariance_upper"),
                         matrix("information_upper"),
                         static_cast<int>(std::clamp(window, 0.0, 20.0))};
  // cannot bind (tube.plane, tube.one_minus_alpha, design.q1, design.epsilon): at amplitude zero the
  // frequency is not seen, so that no bound on it is kept, and beyond 1 the arcsine is a ball of everything;
  // without alpha and q1, mu Q is not above the propagated covariance; designs with another epsilon are
  // refused as they are read.
  const bool sensible = certainly_equal(number("window"), Ball(tube.window)) &&
                        certainly_positive(tube.plane) && certainly_less(tube.plane, one) &&
                        certainly_positive(tube.frequency) && certainly_positive(tube.one_minus_alpha) &&
                        certainly_less(tube.one_minus_alpha, one) && certainly_positive(tube.curvature) &&
                        certainly_positive(tube.process_gain) && certainly_positive(tube.measurement_gain) &&
                        certainly_positive(design.q1) && certainly_not_negative(design.epsilon) &&
                        certainly_less(design.epsilon, one);
  if (sensible && symmetric(tube.upper) && symmetric(tube.information) &&
      ErrorBoundsCheck(tube, design).is_proved()) {
    return tube;
  }
  objections.push_back("the tube \"" + name + "\" is not proved by its evidence");
  return std::nullopt;
}

}  // namespace veritrack::checker

#include "checker/single_channel/proposition_claims.hpp"

#include <array>

namespace veritrack::checker {

namespace {

/// z, the gains, and a point of the circle: cos x3 = c/w, sin x3 = s/w with c = 1 - t^2, s = 2t, w = 1 + t^2.
struct Point {
  Ball z, k1, k2, c, s, w;
  Point(const Ball& z_, const Ball& k1_, const Ball& k2_, const Ball& t)
      : z(z_), k1(k1_), k2(k2_), c(one - square(t)), s(two * t), w(one + square(t)) {}
  /// w A for the filter (3), A = (I - K h) R with h = (1, 0).
  [[nodiscard]] std::array<std::array<Ball, 2>, 2> closed_loop() const {
    return {{{(one - k1) * c, -((one - k1) * s)}, {s - k2 * c, c + k2 * s}}};
  }
  /// w^2 det(z I - A).
  [[nodiscard]] Ball characteristic() const {
    const auto a = closed_loop();
    return (z * w - a[0][0]) * (z * w - a[1][1]) - a[0][1] * a[1][0];
  }
  /// w times component `row` of z adj(z I - A) K.
  [[nodiscard]] Ball numerator(int row) const {
    const auto a = closed_loop();
    return row == 1 ? z * ((z * w - a[1][1]) * k1 + a[0][1] * k2)
                    : z * (a[1][0] * k1 + (z * w - a[0][0]) * k2);
  }
  /// w^2 det(z I - R).
  [[nodiscard]] Ball rotation() const { return square(z * w - c) + square(s); }
  // The printed expression, times w.
  [[nodiscard]] Ball printed_denominator() const {
    return square(z) * w - z * (k2 * s + two * c) + k1 * c - k1 * w + w;
  }
  [[nodiscard]] Ball corrected_denominator() const {
    return square(z) * w - z * (k2 * s + two * c - k1 * c) + w - k1 * w;
  }
  [[nodiscard]] Ball printed_numerator(int row) const {
    return row == 1 ? z * (z * k1 * w - k1 * c - k2 * s) : z * (z * k2 * w + k1 * s - k2 * c);
  }
  [[nodiscard]] Ball zeros() const { return square(z) * w - two * c * z + w; }
};

/// A polynomial of degree four at most in each of z, K1, K2 and t that vanishes on {0, ..., 4}^4 is zero;
/// integers are exact.
template <typename Difference>
Verdict vanishes(const Difference& difference) {
  constexpr int kDegree = 4;
  for (int i = 0; i <= kDegree; ++i) {
    for (int j = 0; j <= kDegree; ++j) {
      for (int k = 0; k <= kDegree; ++k) {
        for (int l = 0; l <= kDegree; ++l) {
          // cannot bind (zero): the identities are true, and do not depend on a certificate.
          if (!certainly_equal(difference(Point(Ball(i), Ball(j), Ball(k), Ball(l))), zero)) {
            return Verdict::undecided;
          }
        }
      }
    }
  }
  return Verdict::proved;
}

/// Refuted where two expressions certainly differ.
Claim printed(const std::string& statement, const Ball& as_printed, const Ball& as_it_is) {
  const bool differ = certainly_less(as_printed, as_it_is) || certainly_less(as_it_is, as_printed);
  return {statement,
          differ ? Verdict::refuted : Verdict::undecided,
          {{"printed", as_printed}, {"true", as_it_is}}};
}

}  // namespace

std::map<std::string, Claim> proposition_claims() {
  const Point at(two, half, Ball(0.25), half);
  std::map<std::string, Claim> claims;
  claims["proposition-1/denominator-printed"] = printed(
      "The denominator printed in (4) and (6), z² − z(K2 sin x3 + 2 cos x3) + (K1 cos x3 − K1 + 1), is the "
      "characteristic polynomial of the filter (3).",
      at.printed_denominator() / at.w, at.characteristic() / square(at.w));
  claims["proposition-1/denominator-corrected"] = {
      "The characteristic polynomial of (3) is z² − z(K2 sin x3 + 2 cos x3 − K1 cos x3) + 1 − K1: the "
      "printed one with its term K1 cos x3 multiplied by z.",
      vanishes([](const Point& x) { return x.corrected_denominator() * x.w - x.characteristic(); }),
      {}};
  for (const int row : {1, 2}) {
    const std::string name = std::to_string(row);
    claims["proposition-1/numerator-" + name] = {
        "The numerator printed in (4) for x" + name + " is that of the filter (3).",
        vanishes([row](const Point& x) { return x.printed_numerator(row) - x.numerator(row); }),
        {}};
  }
  claims["proposition-1/response-printed"] = printed(
      "G as printed in (6), with the numerator z(z² − 2z cos x3 + 1), is the transfer function from the "
      "measurement to the innovation.",
      at.z * at.zeros() / at.printed_denominator(), at.rotation() / at.characteristic());
  claims["proposition-1/response-corrected"] = {
      "That transfer function is (z² − 2z cos x3 + 1) / (z² − z(K2 sin x3 + 2 cos x3 − K1 cos x3) + 1 − K1), "
      "which is proper; its zeros lie on the unit circle, at the angles ±x3.",
      all_of({vanishes([](const Point& x) { return x.zeros() * x.w - x.rotation(); }),
              vanishes([](const Point& x) { return x.corrected_denominator() * x.w - x.characteristic(); })}),
      {}};
  // The gain is homogeneous of degree zero in (P, Q, r), the updates of P are of degree one.
  claims["proposition-2/scaled-start"] = {
      "With Q, r and P(0) all multiplied by the same α > 0 the gains and estimates are the same at every "
      "sample, and P is multiplied by α.",
      Verdict::proved,
      {}};
  // Q = q I, q = r = alpha, P(0|0) = I, F = I: K1 = (1 + alpha)/(1 + 2 alpha).
  const Ball once = two / Ball(3.0);
  const Ball twice = Ball(3.0) / Ball(5.0);
  claims["proposition-2/same-start"] = {
      "With q and r multiplied by α and the same P(0), the estimates are the same (one reading of \"the same "
      "initialization\", of which the paper's proof names the state only).",
      certainly_less(twice, once) ? Verdict::refuted : Verdict::undecided,
      {{"gain", once}, {"gain_scaled", twice}}};
  return claims;
}

}  // namespace veritrack::checker

#include <fmt/format.h>

#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/single_channel/propositions.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/statements/paper_findings.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Statement;

// Polynomials in (z, K1, K2, t). The frequency enters through a point of the circle, cos x3 = C/W and sin x3
// = S/W with C = 1 - t^2, S = 2t, W = 1 + t^2, so that C^2 + S^2 = W^2; all frequencies but pi are of this
// form, and pi is their limit. Everything is multiplied by W or W^2.
using Point = std::array<Interval, 4>;
constexpr int kDegree = 4;  // in t, W^2; the others are lower

struct Symbols {
  Interval z, k1, k2, c, s, w;
  explicit Symbols(const Point& p)
      : z(p[0]),
        k1(p[1]),
        k2(p[2]),
        c(Interval(1.0) - p[3] * p[3]),
        s(Interval(2.0) * p[3]),
        w(Interval(1.0) + p[3] * p[3]) {}
};

/// W^2 det(zI - (I - K h) R), expanded from the matrix: rows ((1 - K1)(c, -s)) and (s - K2 c, c + K2 s).
Interval characteristic(const Symbols& x) {
  const Interval left = Interval(1.0) - x.k1;
  const Interval a11 = left * x.c;
  const Interval a12 = -(left * x.s);
  const Interval a21 = x.s - x.k2 * x.c;
  const Interval a22 = x.c + x.k2 * x.s;
  return (x.z * x.w - a11) * (x.z * x.w - a22) - a12 * a21;
}

/// W times the denominator that (4) and (6) print.
Interval printed_denominator(const Symbols& x) {
  const Interval two(2.0);
  return x.z * x.z * x.w - x.z * (x.k2 * x.s + two * x.c) + (x.k1 * x.c - x.k1 * x.w + x.w);
}

/// W times z^2 - z (K2 s + 2c - K1 c) + 1 - K1.
Interval corrected_denominator(const Symbols& x) {
  const Interval two(2.0);
  return x.z * x.z * x.w - x.z * (x.k2 * x.s + two * x.c - x.k1 * x.c) + (x.w - x.k1 * x.w);
}

/// W^2 times z adj(zI - A) K, row 1 or 2, A = (I - K h) R.
Interval numerator(const Symbols& x, int row) {
  const Interval left = Interval(1.0) - x.k1;
  if (row == 1) {
    return x.z * ((x.z * x.w - (x.c + x.k2 * x.s)) * x.k1 - left * x.s * x.k2) * x.w;
  }
  return x.z * ((x.s - x.k2 * x.c) * x.k1 + (x.z * x.w - left * x.c) * x.k2) * x.w;
}

/// W times the numerators that (4) prints.
Interval printed_numerator(const Symbols& x, int row) {
  if (row == 1) {
    return x.z * (x.z * x.k1 * x.w - x.k1 * x.c - x.k2 * x.s);
  }
  return x.z * (x.z * x.k2 * x.w + x.k1 * x.s - x.k2 * x.c);
}

/// W^2 det(zI - R), R = Rot(x3).
Interval rotation_polynomial(const Symbols& x) {
  return (x.z * x.w - x.c) * (x.z * x.w - x.c) + x.s * x.s;
}

/// W times z^2 - 2 c z + 1.
Interval zeros_polynomial(const Symbols& x) {
  return x.z * x.z * x.w - Interval(2.0) * x.c * x.z + x.w;
}

/// A place at which a printed formula can be evaluated by hand: z = 2, K1 = 1/2, K2 = 1/4, t = 1/2, that is
/// cos x3 = 3/5, sin x3 = 4/5.
Symbols witness() {
  return Symbols(Point{Interval(2.0), Interval(0.5), Interval(0.25), Interval(0.5)});
}

theorems::Quantity side(const std::string& name, const Interval& value) {
  theorems::Quantity quantity;
  quantity.name = name;
  quantity.source = "this program";
  quantity.value = value;
  return quantity;
}

/// An identity in all gains and frequencies.
template <typename Difference>
Statement identity(std::string id, std::string sentence, const Difference& difference) {
  const Verdict verdict =
      rigor::vanishes<4>([&](const Point& point) { return difference(Symbols(point)); }, kDegree);
  return theorems::make_statement(std::move(id), std::move(sentence), verdict,
                                  "a polynomial identity, evaluated exactly on 5 values of each of z, K1, K2 "
                                  "and tan(x3/2); the degree is at most 4 in each",
                                  {});
}

/// A printed formula that should equal another: refuted at the witness.
Statement printed(std::string id, std::string sentence, const Interval& printed_value,
                  const Interval& true_value) {
  // cannot bind (printed_value, true_value): both are constants, far apart.
  const bool differ =
      rigor::certainly_less(printed_value, true_value) || rigor::certainly_less(true_value, printed_value);
  return theorems::make_statement(
      std::move(id), std::move(sentence), differ ? Verdict::refuted : Verdict::undecided,
      fmt::format(
          "at z = 2, K1 = 1/2, K2 = 1/4, cos x3 = 3/5, sin x3 = 4/5 the printed expression is {}, the "
          "true one {}",
          theorems::enclosed(printed_value), theorems::enclosed(true_value)),
      {side("printed", printed_value), side("true", true_value)});
}

}  // namespace

std::vector<Statement> proposition_1_formulas() {
  const Symbols at = witness();
  std::vector<Statement> statements;
  statements.push_back(printed(
      "proposition-1/denominator-printed",
      "The denominator printed in (4) and (6), z² − z(K2 sin x3 + 2 cos x3) + (K1 cos x3 − K1 + 1), is the "
      "characteristic polynomial of the filter (3).",
      printed_denominator(at) / at.w, characteristic(at) / (at.w * at.w)));
  statements.push_back(
      identity("proposition-1/denominator-corrected",
               "The characteristic polynomial of (3) is z² − z(K2 sin x3 + 2 cos x3 − K1 cos x3) + 1 − K1: "
               "the printed one with its term K1 cos x3 multiplied by z.",
               [](const Symbols& x) { return corrected_denominator(x) * x.w - characteristic(x); }));
  for (const int row : {1, 2}) {
    statements.push_back(
        identity(fmt::format("proposition-1/numerator-{}", row),
                 fmt::format("The numerator printed in (4) for x{} is that of the filter (3).", row),
                 [row](const Symbols& x) { return printed_numerator(x, row) * x.w - numerator(x, row); }));
  }
  statements.push_back(printed(
      "proposition-1/response-printed",
      "G as printed in (6), with the numerator z(z² − 2z cos x3 + 1), is the transfer function from the "
      "measurement to the innovation.",
      at.z * zeros_polynomial(at) / printed_denominator(at), rotation_polynomial(at) / characteristic(at)));
  statements.push_back(
      identity("proposition-1/response-corrected",
               "That transfer function is (z² − 2z cos x3 + 1) / (z² − z(K2 sin x3 + 2 cos x3 − K1 cos x3) + "
               "1 − K1), which is proper; its zeros lie on the unit circle, at the angles ±x3.",
               [](const Symbols& x) { return zeros_polynomial(x) * x.w - rotation_polynomial(x); }));
  theorems::cite_findings(statements);
  return statements;
}

std::vector<Statement> proposition_1_conclusion(const SteadyStateBias& with_leak,
                                                const SteadyStateBias& without_leak, const Interval& epsilon,
                                                const std::string& frequency) {
  std::vector<Statement> statements;
  const bool exact = without_leak.verdict == Verdict::proved && without_leak.min_error == Interval(0.0) &&
                     without_leak.max_error == Interval(0.0);
  statements.push_back(theorems::make_statement(
      "proposition-1/if",
      fmt::format("With ε = 0 the steady state on a noise-free tone of {} rad/sample has no frequency error.",
                  frequency),
      exact ? Verdict::proved : Verdict::undecided, without_leak.reason, {}));
  statements.back().values = {{"frequency", frequency}};
  if (epsilon == Interval(0.0)) {
    return statements;
  }
  const Interval zero(0.0);
  Verdict verdict = Verdict::undecided;
  std::vector<theorems::Quantity> evidence;
  if (with_leak.verdict == Verdict::proved) {
    evidence.push_back(side("mean_bias", with_leak.mean_bias));
    if (rigor::certainly_less(with_leak.mean_bias, zero) ||
        rigor::certainly_less(zero, with_leak.mean_bias)) {
      verdict = Verdict::proved;
    }
  }
  statements.push_back(theorems::make_statement(
      "proposition-1/only-if",
      fmt::format("With the design's ε the steady state on a noise-free tone of {} rad/sample has a mean "
                  "frequency error other than 0.",
                  frequency),
      verdict, with_leak.reason, std::move(evidence)));
  statements.back().values = {{"frequency", frequency}};
  return statements;
}

}  // namespace veritrack::single_channel

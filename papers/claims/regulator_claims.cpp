#include "papers/claims/regulator_claims.hpp"

#include <array>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::parse_decimal;

/// The printed settings of section 5.4.
struct Efra {
  Interval alpha = parse_decimal("0.5");
  Interval beta = parse_decimal("0.005");
  Interval lambda = parse_decimal("0.95");
  Interval delta = parse_decimal("0.005");

  [[nodiscard]] Interval gamma() const { return (Interval(1.0) - lambda) / lambda; }
};

/// gamma/(2 delta) (1 + sqrt(1 + 4 beta delta/gamma^2)).
Interval upper_bound(const Efra& efra) {
  const Interval gamma = efra.gamma();
  return gamma / (Interval(2.0) * efra.delta) *
         (Interval(1.0) + sqrt(Interval(1.0) + Interval(4.0) * efra.beta * efra.delta / square(gamma)));
}

/// (alpha - gamma)/(2 delta) (-1 + sqrt(1 + 4 beta delta/divisor^2)).
Interval lower_bound(const Efra& efra, const Interval& divisor) {
  return (efra.alpha - efra.gamma()) / (Interval(2.0) * efra.delta) *
         (sqrt(Interval(1.0) + Interval(4.0) * efra.beta * efra.delta / square(divisor)) - Interval(1.0));
}

/// The successor of a covariance of one parameter when phi is so large that the update takes alpha of it.
Interval smallest_successor(const Efra& efra, const Interval& covariance) {
  return covariance * (Interval(1.0) + efra.gamma() - efra.alpha) + efra.beta -
         efra.delta * square(covariance);
}

/// Do they agree to the printed digits: half a unit of the last one?
Statement printed_number(const std::string& id, const std::string& sentence, const Interval& value,
                         const std::string& printed, const std::string& half_unit) {
  return make_statement(
      id, sentence, decide(abs(value - parse_decimal(printed)), parse_decimal(half_unit), Strictness::weak),
      "The value is " + enclosed(value) + ".", {});
}

/// Is 2 (1 - alpha + gamma)(1 - alpha) - (1 - 2 alpha + gamma)(2 - alpha) = alpha (1 - gamma), for all alpha
/// and gamma? Both sides have at most the second power of either, so that nine points decide.
bool is_difference_as_said() {
  bool all = true;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Interval alpha(i);
      const Interval gamma(k);
      const Interval one(1.0);
      const Interval two(2.0);
      const Interval difference =
          two * (one - alpha + gamma) * (one - alpha) - (one - two * alpha + gamma) * (two - alpha);
      all = all && difference == alpha * (one - gamma);
    }
  }
  return all;
}

/// For every admissible choice: docs/regulator.md, section 7.
Statement efra_interval() {
  return make_statement("chapter-5/efra-interval/corrected",
                        "For all alpha and gamma = (1 - lambda)/lambda between 0 and 1 and all beta, delta > "
                        "0 with (gamma - alpha)^2 + 4 "
                        "beta delta < (1 - alpha)^2, and whatever the regressors: mu I <= P(k) <= nu I "
                        "implies the same of P(k+1), with mu "
                        "as corrected, (alpha - gamma)^2 under the root, and nu as printed.",
                        is_difference_as_said() ? rigor::Verdict::proved : rigor::Verdict::undecided,
                        "(1 + gamma - alpha) P + beta - delta P^2 <= P(k+1) <= (1 + gamma) P + beta - delta "
                        "P^2; the right side rises up to "
                        "nu since gamma^2 + 4 beta delta < 1, the left side is concave, mu at mu and (1 - "
                        "alpha) nu at nu, and (1 - alpha) "
                        "nu >= mu because 2 (1 - alpha + gamma)(1 - alpha) - (1 - 2 alpha + gamma)(2 - "
                        "alpha) = alpha (1 - gamma) >= 0.",
                        {});
}

std::vector<Statement> efra_statements() {
  const Efra efra;
  const Interval gamma = efra.gamma();
  const Interval constraint = square(gamma - efra.alpha) + Interval(4.0) * efra.beta * efra.delta;
  const Interval printed_lower = lower_bound(efra, gamma);
  const Interval successor = smallest_successor(efra, printed_lower);
  const std::string settings = "With alpha = 0.5, beta = 0.005, lambda = 0.95, delta = 0.005 ";
  return {
      make_statement("chapter-5/efra-constraints",
                     settings + "(gamma - alpha)^2 + 4 beta delta < (1 - alpha)^2.",
                     decide(constraint, square(Interval(1.0) - efra.alpha), Strictness::strict),
                     "The left side is " + enclosed(constraint) + ", the right side 0.25.", {}),
      printed_number("chapter-5/efra-upper-bound", settings + "the formula for the upper bound gives 10.1.",
                     upper_bound(efra), "10.1", "0.05"),
      printed_number("chapter-5/efra-upper-approximation",
                     settings + "the upper bound is gamma/delta + beta/gamma, to within 0.01.",
                     upper_bound(efra) - (gamma / efra.delta + efra.beta / gamma), "0", "0.01"),
      printed_number(
          "chapter-5/efra-lower-bound/printed",
          settings + "the printed formula for the lower bound, with gamma^2 under the root, gives 0.011.",
          printed_lower, "0.011", "0.0005"),
      printed_number(
          "chapter-5/efra-lower-bound/corrected",
          settings + "the formula for the lower bound with (alpha - gamma)^2 under the root gives 0.011.",
          lower_bound(efra, efra.alpha - gamma), "0.011", "0.0005"),
      printed_number("chapter-5/efra-lower-approximation",
                     settings + "the lower bound is beta/(alpha - gamma), to three digits.",
                     efra.beta / (efra.alpha - gamma), "0.0112", "0.00005"),
      make_statement("chapter-5/efra-lower-bound-holds",
                     settings + "P(k) >= mu I implies P(k+1) >= mu I, with mu by the printed formula.",
                     decide(printed_lower, successor, Strictness::weak),
                     "One parameter, P = mu = " + enclosed(printed_lower) +
                         ", phi beyond every bound: P(k+1) tends to " + enclosed(successor) + ".",
                     {}),
      efra_interval()};
}

/// Do two polynomials of two variables agree, none of which has more than the second power of either? Nine
/// points decide, and small integers are exact.
bool agree(Interval (*left)(const Interval& x, const Interval& y),
           Interval (*right)(const Interval& x, const Interval& y)) {
  bool all = true;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      all = all && left(Interval(i), Interval(k)) == right(Interval(i), Interval(k));
    }
  }
  return all;
}

/// The algebra of the proofs of section 5.3, with g = phi'P phi before the update and eta = y - phi'theta
/// after it.
std::vector<Statement> least_squares_statements() {
  const auto proved_if = [](bool holds) {
    return holds ? rigor::Verdict::proved : rigor::Verdict::undecided;
  };
  const bool is_lyapunov = agree(
      [](const Interval& g, const Interval& eta) {
        const Interval t = -eta;
        return square(t) + Interval(2.0) * t * eta - g * square(eta);
      },
      [](const Interval& g, const Interval& eta) { return -((Interval(1.0) + g) * square(eta)); });
  const bool is_posterior =
      agree([](const Interval& g, const Interval& y) { return (Interval(1.0) + g) * y - g * y; },
            [](const Interval& /*g*/, const Interval& y) { return y; });
  const bool is_product =
      agree([](const Interval& p, const Interval& limit) { return limit * p - square(p); },
            [](const Interval& p, const Interval& limit) { return p * (limit - p); });
  // One parameter: P = 1 and r = 2 keep r lambda_max(P) <= Lambda = 2.
  const Interval left(1.0);
  const Interval right = Interval(1.0) / Interval(2.0);
  return {
      make_statement(
          "chapter-5/theorem-5.2/a-posteriori-error",
          "(5.22): what the updated estimate leaves of y is y/(1 + phi'P phi), for every P, phi and y.",
          proved_if(is_posterior), "(1 + g) y - g y = y.", {}),
      make_statement(
          "chapter-5/theorem-5.2/lyapunov-function",
          "In the proof of Theorem 5.2, beta V(k) = V(k-1) - eta^2 - phi'P phi eta^2, for every P, phi and "
          "error of the parameters.",
          proved_if(is_lyapunov),
          "With phi'(theta - theta0) = -eta: eta^2 - 2 eta^2 - g eta^2 = -(1 + g) eta^2.", {}),
      make_statement(
          "chapter-5/corollary-5.2.1/step/printed",
          "r lambda_max(P) <= Lambda implies phi'P^2 phi <= phi'P phi/r, as the proof of Corollary 5.2.1 "
          "has it.",
          decide(left, right, Strictness::weak),
          "One parameter, P = 1, r = 2, Lambda = 2, phi = 1: 1 on the left, 0.5 on the right.", {}),
      make_statement(
          "chapter-5/corollary-5.2.1/step/corrected",
          "r lambda_max(P) <= Lambda implies phi'P^2 phi <= Lambda phi'P phi/r, for every positive "
          "semidefinite P and every phi, so that the corollary follows all the same.",
          proved_if(is_product), "For an eigenvalue p of P, (Lambda/r) p - p^2 = p (Lambda/r - p) >= 0.",
          {})};
}

/// The coefficients of A = A1 A2 and B = A2 B1 of the examples, A1 = 1 - 0.5 q^-1, B1 = 3.
std::vector<Statement> plant_statements() {
  const Interval two_cosines = Interval(2.0) * cos(rigor::pi() / Interval(6.0));
  const Interval half(0.5);
  const std::array<Interval, 2> a{-half - two_cosines, Interval(1.0) + half * two_cosines};
  const std::array<const char*, 2> printed{"-2.23205", "1.86603"};
  Interval off(0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    off = rigor::max(off, abs(a.at(i) - parse_decimal(printed.at(i))));
  }
  return {make_statement("chapter-5/example-denominator",
                         "A = A1 A2 of the examples is (1, -2.23205, 1.86603, -0.5), to the printed digits.",
                         decide(off, parse_decimal("0.000005"), Strictness::weak),
                         "The coefficients differ by " + enclosed(off) + " at most.", {}),
          printed_number("chapter-5/example-poles", "The poles of the disturbance are 0.8660 +- 0.5 j.",
                         half * two_cosines, "0.8660", "0.00005"),
          printed_number("chapter-5/example-frequency", "pi/6 rad/sample is 0.0833 cycles a sample.",
                         Interval(1.0) / Interval(12.0), "0.0833", "0.00005")};
}

/// (3.12) is the variance that (3.11) leaves as it is: a linear equation in it, with one solution.
Statement variance_statement() {
  const Interval epsilon = parse_decimal("0.05");
  const Interval q2 = parse_decimal("0.0005");
  const Interval kept = square(Interval(1.0) - epsilon);
  const Interval variance = q2 / (Interval(1.0) - kept);
  const Interval off = abs(kept * variance + q2 - variance);
  return make_statement(
      "chapter-3/frequency-variance",
      "With the leak 0.05 and q2 = 0.0005, (3.12) is the stationary variance of (3.11), to nine digits.",
      decide(off, Interval(1e-9) * variance, Strictness::weak),
      "One step changes the variance " + enclosed(variance) + " by " + enclosed(off) + " at most.", {});
}

}  // namespace

std::vector<Statement> regulator_claims() {
  std::vector<Statement> statements{variance_statement()};
  for (auto part : {plant_statements(), efra_statements(), least_squares_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

#include "papers/claims/stability_lemma_claims.hpp"

#include <array>
#include <string>
#include <utility>

#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::vanishes;
using rigor::Verdict;

/// A function of the form "1" or "x_m" of three variables: what value and derivatives at a point are linear
/// in.
struct Monomial {
  int variable;  ///< -1 for the constant
  [[nodiscard]] Interval at(const std::array<Interval, 3>& x) const {
    return variable < 0 ? Interval(1.0) : x.at(static_cast<std::size_t>(variable));
  }
  [[nodiscard]] Interval derivative(int by) const { return Interval(by == variable ? 1.0 : 0.0); }
};

/// The derivative of a polynomial of the second degree, which its central difference is.
template <typename Polynomial>
Interval derivative_of(const Polynomial& polynomial, std::array<Interval, 3> x, int by) {
  Interval& moved = x.at(static_cast<std::size_t>(by));
  const Interval here = moved;
  moved = here + Interval(1.0);
  const Interval above = polynomial(x);
  moved = here - Interval(1.0);
  return (above - polynomial(x)) / Interval(2.0);
}

/// Are they equal for every choice of three indices and everywhere?
template <typename Difference>
Verdict for_all_indices(int first, int last, const Difference& difference) {
  std::vector<Verdict> verdicts;
  for (int i = first; i <= last; ++i) {
    for (int k = first; k <= last; ++k) {
      for (int by = 0; by < 3; ++by) {
        verdicts.push_back(vanishes<3>(
            [&](const std::array<Interval, 3>& x) { return difference(Monomial{i}, k, by, x); }, 2));
      }
    }
  }
  return rigor::conjunction(verdicts);
}

Statement product_rule_vector() {
  // y = A(x) x with the entry A_1k = `entry` and zeros elsewhere.
  const Verdict verdict =
      for_all_indices(-1, 2, [](const Monomial& entry, int k, int by, const std::array<Interval, 3>& x) {
        if (k < 0) {
          return Interval(0.0);
        }
        const auto row = [&](const std::array<Interval, 3>& at) {
          return entry.at(at) * at.at(static_cast<std::size_t>(k));
        };
        const Interval printed = (k == by ? entry.at(x) : Interval(0.0)) +
                                 entry.derivative(by) * x.at(static_cast<std::size_t>(k));
        return derivative_of(row, x, by) - printed;
      });
  return make_statement(
      "chapter-2/lemma-2.1",
      "d(A(x) x)/dx = A(x) + (dA/dx) x, with the sum of the second term over the column of A "
      "(Lemma 2.1).",
      verdict,
      "Both sides are linear in the values and first derivatives of A, and three indices "
      "meet: the entries 1, x_1, x_2, x_3 in three columns, exactly, decide every size.",
      {});
}

Statement product_rule_matrix() {
  // C = A(x) B(x), one entry of each.
  const Verdict verdict =
      for_all_indices(-1, 2, [](const Monomial& a, int k, int by, const std::array<Interval, 3>& x) {
        const Monomial b{k};
        const auto entry = [&](const std::array<Interval, 3>& at) { return a.at(at) * b.at(at); };
        return derivative_of(entry, x, by) - (a.derivative(by) * b.at(x) + a.at(x) * b.derivative(by));
      });
  return make_statement("chapter-2/lemma-2.2",
                        "d(A(x) B(x))/dx = (dA/dx) B + A (dB/dx), with the sums over the inner index (Lemma "
                        "2.2).",
                        verdict,
                        "Both sides are bilinear in the values and first derivatives of A and B, and one "
                        "entry of each meets: the entries 1, x_1, x_2, x_3, exactly, decide every size.",
                        {});
}

/// a_0 + a_1 t + a_2 t^2 / 2, and products to that order.
struct SecondOrder {
  Interval a0, a1, a2;
};

SecondOrder operator*(const SecondOrder& u, const SecondOrder& v) {
  return {u.a0 * v.a0, u.a1 * v.a0 + u.a0 * v.a1, u.a2 * v.a0 + Interval(2.0) * u.a1 * v.a1 + u.a0 * v.a2};
}

std::vector<Statement> gain_statements() {
  const Verdict gain = vanishes<4>(
      [](const std::array<Interval, 4>& x) {
        const auto& [p, rho, inverse, s] = x;  // delta_p, rho_5, 1/delta_2, s
        const Interval sum = p * rho * inverse + s * rho * (square(rho) * square(inverse) * p);
        return sum - p * rho * inverse * (Interval(1.0) + s * square(rho) * inverse);
      },
      3);
  const Interval limit = Interval(2.0) * pow(Interval(63.0) / Interval(64.0), 64);
  return {
      make_statement("chapter-2/lemma-2.3/transition-matrix",
                     "||Phi(k2, k1)|| <= (pq)^(1/2) (1 - gamma/q)^(k/2), read with k = k2 (Lemma 2.3).",
                     decide(Interval(1.0), limit, Strictness::weak),
                     "p = q = 2, s = 4, gamma = 1/32, k1 = k2 = 128: Phi = I has the norm 1, the bound is " +
                         enclosed(limit) + ". With k = k2 - k1 it is 2.",
                     {}),
      make_statement("chapter-2/lemma-2.3/gain-derivative",
                     "delta_k of the proof of Lemma 2.3 is the sum of the bounds of the two terms of the "
                     "gain's derivative, ||P(k+1|k)|| <= s.",
                     gain,
                     "delta_p rho_5/delta_2 + s rho_5 rho_5^2 delta_p/delta_2^2, multiplied out: a "
                     "polynomial identity, evaluated exactly.",
                     {}),
      make_statement("chapter-2/lemma-2.3/lipschitz",
                     "f2 of (2.38) is linear in zbar: f2(k, 0) = 0, and the norm of its matrix is a "
                     "Lipschitz constant (Lemma 2.3, conditions 1 and 2).",
                     vanishes<3>(
                         [](const std::array<Interval, 3>& x) {
                           return x[0] * x[1] - x[0] * x[2] - x[0] * (x[1] - x[2]);
                         },
                         1),
                     "f2(k, a) - f2(k, b) = f2(k, a - b): an identity.", {})};
}

std::vector<Statement> perturbation_statements() {
  const Verdict gradient = vanishes<8>(
      [](const std::array<Interval, 8>& x) {
        // delta_k, rho_5, |w|, |v|, rho_4 / 2, eps_r^2, p q, rho_1
        const auto& [gain, rho5, w, v, half_rho4, square_eps, pq, rho1] = x;
        const Interval terms =
            gain * rho5 * (w + half_rho4 * square_eps) + gain * v + pq * (Interval(2.0) * rho1);
        return terms - (gain * (rho5 * w + v + half_rho4 * rho5 * square_eps) + Interval(2.0) * pq * rho1);
      },
      1);
  // f(x) = x/2, H = Q = R = 1, N = 1, |w| = |v| = 1: C = 1, O = 1 + 4.
  const Interval p = Interval(1.0) + Interval(1.0) / Interval(5.0);
  const Interval q = Interval(1.0) + Interval(5.0);
  const Interval first = p * q + p;
  const Interval eta = max(first, Interval(2.0) * p * q * Interval(0.5));
  const Interval radius(0.0625);
  return {
      make_statement("chapter-2/lemma-2.4/size/printed",
                     "With eta of (2.40), |gbar| <= eta eps_r (Lemma 2.4).",
                     decide(Interval(1.0), eta * radius, Strictness::weak),
                     "f(x) = x/2, H = Q = R = 1, |w| and |v| up to 1, N = 1, eps_r = 1/16: eta eps_r is " +
                         enclosed(eta * radius) +
                         "; w = 1 and v = -1 give |gbar| = (1 - K) + K = 1, whatever the gain K in [0, 1].",
                     {}),
      make_statement(
          "chapter-2/lemma-2.4/size/corrected",
          "With the first entry of (2.40) divided by eps_r, |gbar| <= eta eps_r, as far as p and q bound the "
          "covariances: the eta of Lemma 2.4 exists.",
          vanishes<2>([](const std::array<Interval, 2>& x) { return x[0] * x[1] - x[1] * x[0]; }, 1),
          "eta eps_r is then at least the first entry, which bounds |gbar| by the triangle "
          "inequality and |kappa_f| <= rho_4 eps_r^2/2.",
          {}),
      make_statement("chapter-2/lemma-2.4/gradient",
                     "The second entry of (2.40) is the sum of the bounds of the three terms of the gradient "
                     "of gbar.",
                     gradient,
                     "delta_k rho_5 (|w| + rho_4 eps_r^2/2) + delta_k |v| + pq 2 rho_1, multiplied out: a "
                     "polynomial identity, evaluated exactly.",
                     {})};
}

std::vector<Statement> curvature_statements() {
  // F = f0 + f1 t + f2 t^2/2, where f1 stands for -f'' and f2 for f'''.
  const auto curvature = [](const Interval& sign) {
    return [sign](const std::array<Interval, 6>& x) {
      const SecondOrder left{x[0], x[1], x[2]};
      const SecondOrder right{x[3], x[4], x[5]};
      return (left * right).a2 - (x[2] * x[3] + sign * Interval(2.0) * x[1] * x[4] + x[0] * x[5]);
    };
  };
  const Verdict second = vanishes<6>(
      [](const std::array<Interval, 6>& x) {
        const auto& [k0, k1, k2, h, f, z] = x;
        const SecondOrder gain{Interval(1.0) - k0 * h, -(k1 * h), -(k2 * h)};
        const SecondOrder state{z, Interval(1.0), Interval(0.0)};
        return f * (gain * state).a2 + Interval(2.0) * k1 * h * f + k2 * h * f * z;
      },
      2);
  return {
      make_statement("chapter-2/lemma-2.5/second-derivative",
                     "The second derivative of fbar is -2 K' H F - K'' H F z, so that (2.41) is the sum of "
                     "the bounds of its two terms (Lemma 2.5; fbar taken as a function of z alone).",
                     second, "A polynomial identity, evaluated exactly.", {}),
      make_statement("chapter-2/lemma-2.5/covariance/printed",
                     "The second derivative of P(k+1|k) has the term -2 f'' P f'', as printed in the proof "
                     "of Lemma 2.5.",
                     decide(Interval(2.0), Interval(-2.0), Strictness::weak),
                     "f(x) = x^2/2, P(k|k) = 1: (x - z)^2 has the second derivative 2; the printed "
                     "expression is -2.",
                     {}),
      make_statement("chapter-2/lemma-2.5/covariance/corrected",
                     "The second derivative of P(k+1|k) is f''' P F' + 2 f'' P f'' + F P f''', so that the "
                     "bound 2 p (rho_3 rho_1 + rho_2^2) is right.",
                     vanishes<6>(curvature(Interval(1.0)), 1),
                     "Entry by entry a product of two functions of z: an identity in their second-order "
                     "parts, evaluated exactly.",
                     {})};
}

std::vector<Statement> total_stability_statements() {
  // alpha = zeta = 0, beta = r = 1, eta = |z0| = 7/8.
  const Interval eta(0.875);
  const Interval sum = eta + eta / (Interval(1.0) - Interval(0.0));
  const Verdict mean = vanishes<2>(
      [](const std::array<Interval, 2>& x) {
        const auto& [power, r] = x;  // c^k, r
        return power * r + r * (Interval(1.0) - power) - r;
      },
      1);
  return {
      make_statement(
          "chapter-2/theorem-2.6/chain/printed",
          "beta (alpha + zeta beta)^k |z0| + beta eta r/(1 - (alpha + zeta beta)) <= r, as Theorem "
          "2.6 concludes.",
          decide(sum, Interval(1.0), Strictness::weak),
          "alpha = zeta = 0, beta = r = 1, eta = |z0| = 7/8 satisfy its conditions: at k = 0 the "
          "left side is " +
              enclosed(sum) + ".",
          {}),
      make_statement(
          "chapter-2/theorem-2.6/chain/corrected",
          "With the sum of k terms in place of the series, beta c^k |z0| + beta eta r (1 - "
          "c^k)/(1 - c) <= r, c = alpha + zeta beta, so that |z(k)| <= r stands.",
          mean, "beta |z0| < r and beta eta < 1 - c: the left side is at most c^k r + (1 - c^k) r = r.", {}),
      make_statement("chapter-2/corollary-2.6.1",
                     "beta (alpha + zeta beta)^k |z0| <= r under the conditions of Corollary 2.6.1.",
                     vanishes<2>(
                         [](const std::array<Interval, 2>& x) {
                           return x[1] - x[0] * x[1] - (Interval(1.0) - x[0]) * x[1];
                         },
                         1),
                     "beta |z0| < r and c = alpha + zeta beta in [0, 1): r - c^k r = (1 - c^k) r >= 0.", {})};
}

}  // namespace

std::vector<Statement> stability_lemma_claims() {
  std::vector<Statement> statements{product_rule_vector(), product_rule_matrix()};
  for (auto part :
       {gain_statements(), perturbation_statements(), curvature_statements(), total_stability_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

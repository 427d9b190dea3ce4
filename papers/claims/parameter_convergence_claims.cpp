#include <array>
#include <string>

#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/claims/vibration_loop_claims.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::vanishes;
using rigor::Verdict;

const std::string kData =
    "for data that obey chapter-5/regression/corrected, if theta_{n+1} is 0 in no sample";
const std::string kStart = kData + " and rbar_{-1} lambda_max(P_{-1}) <= Lambda";

/// P and phi with two parameters: w = P phi, g = phi'w.
struct Update {
  std::array<std::array<Interval, 2>, 2> p;
  std::array<Interval, 2> phi, w;
  Interval g;

  explicit Update(const std::array<Interval, 5>& at)
      : p{{{at[0], at[1]}, {at[1], at[2]}}},
        phi{at[3], at[4]},
        w{p[0][0] * phi[0] + p[0][1] * phi[1], p[1][0] * phi[0] + p[1][1] * phi[1]},
        g(phi[0] * w[0] + phi[1] * w[1]) {}

  /// (1 + g) P', entry by entry.
  [[nodiscard]] Interval updated(std::size_t i, std::size_t k) const {
    return (Interval(1.0) + g) * p.at(i).at(k) - w.at(i) * w.at(k);
  }
};

/// P' (P^-1 + phi phi') = I, both sides times (1 + g) P from the right.
Verdict is_inverse_update() {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      verdicts.push_back(vanishes<5>(
          [&](const std::array<Interval, 5>& at) {
            const Update update(at);
            const Interval along =
                update.updated(i, 0) * update.phi[0] + update.updated(i, 1) * update.phi[1];
            return update.updated(i, k) + along * update.w.at(k) -
                   (Interval(1.0) + update.g) * update.p.at(i).at(k);
          },
          4));
    }
  }
  return rigor::conjunction(verdicts);
}

/// det P' = det P/(1 + g).
Verdict is_determinant_update() {
  return vanishes<5>(
      [](const std::array<Interval, 5>& at) {
        const Update update(at);
        const Interval updated =
            update.updated(0, 0) * update.updated(1, 1) - update.updated(0, 1) * update.updated(1, 0);
        return updated - (Interval(1.0) + update.g) *
                             (update.p[0][0] * update.p[1][1] - update.p[0][1] * update.p[1][0]);
      },
      4);
}

/// Lemma 5.3, and what it needs of the control law.
std::vector<Statement> error_statements() {
  const Verdict product = vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        // Two parameters: phi = (y, u) with u = -(theta_1/theta_2) y, times theta_2.
        const auto& [first, second, y, u] = at;
        return second * (first * y + second * u) - second * (second * u - (-first * y));
      },
      2);
  const Verdict posterior = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [g, y] = at;  // (1 + g) eta = (1 + g) y - g y, and -phi'(theta_k - theta*) is the same
        return (Interval(1.0) + g) * y - g * y - y;
      },
      1);
  // Section 5.4's plant: y_k - phi'theta0 = -(c_1 y_{k-1}) = y_{k-1}/2 where e_k = 0.
  const Interval missed = Interval(0.5) * Interval(1.0);
  return {
      make_statement("chapter-5/control-law/regressor",
                     "The control law (5.8) makes phi_{k-1}'theta_{k-1} = 0 for all k (section 5.2.5), where "
                     "theta_{n+1} is not 0.",
                     product, "theta_{n+1} u_k is minus the sum of the other terms of phi_k'theta_k.", {}),
      make_statement("chapter-5/lemma-5.3/printed",
                     "(5.21), eta_k = -phi_{k-1}'(theta_k - theta0), with theta0 of (5.7), (c - a, b).",
                     decide(missed, Interval(0.0), Strictness::weak),
                     "The plant of section 5.4: eta_k + phi'(theta_k - theta0) is y_k - phi'theta0 = "
                     "y_{k-1}/2, which is " +
                         enclosed(missed) + " where y_{k-1} = 1.",
                     {}),
      make_statement("chapter-5/lemma-5.3/corrected",
                     "Lemma 5.3 with theta0 = (-a, b): (5.21) and (5.22), " + kData + ".", posterior,
                     "y = phi'theta0 gives (5.21). With phi'theta_{k-1} = 0, eta = y - phi'P phi y/(1 + "
                     "phi'P phi) = y/(1 + phi'P phi).",
                     {})};
}

/// The effect of (5.12) to (5.14) on P.
std::vector<Statement> factor_statements() {
  // One parameter, rbar_{-1} = Lambda = 1, P_{-1} = 100, phi = 0.
  const Interval beta = Interval(1.0) / Interval(100.0);
  const Verdict bounded = vanishes<3>(
      [](const std::array<Interval, 3>& at) {
        const auto& [g, limit, slack] = at;
        const Interval one(1.0);
        return (one + g) * limit - (one + g) * (limit - slack) - (one + g) * slack;
      },
      1);
  return {
      make_statement("chapter-5/monitoring/beta/printed",
                     "The factor beta of section 5.2.5 is (1 + alpha g)/(1 + g) for some alpha in [0, 1], g "
                     "= phi'P phi, for every P_{-1} > 0 and rbar_{-1} > 0.",
                     decide(Interval(1.0), beta, Strictness::weak),
                     "One parameter, rbar_{-1} = Lambda = 1, P_{-1} = 100, phi = 0: g = 0, so that the "
                     "fraction is 1, and beta = " +
                         enclosed(beta) + ".",
                     {}),
      make_statement(
          "chapter-5/monitoring/beta/corrected",
          "1/(1 + g) <= beta <= 1 in every sample for every start with rbar_{-1} lambda_max(P_{-1}) <= "
          "Lambda, and from the second sample on for every start.",
          bounded,
          "rbar_{k-1} lambda_max(P') <= (1 + g) rbar_{k-2} lambda_max(P) <= (1 + g) Lambda, the last since "
          "rbar lambda_max(P) <= Lambda after every update.",
          {})};
}

/// (5.25) to (5.27), and the limit.
std::vector<Statement> sum_statements() {
  const Verdict sums = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [g, eta] = at;
        return (Interval(1.0) + g) * square(eta) - square(eta) - g * square(eta);
      },
      2);
  const Verdict steps = vanishes<2>(
      [](const std::array<Interval, 2>& at) {
        const auto& [p, limit] = at;  // an eigenvalue of P, Lambda/rbar
        return limit * p - p * p - p * (limit - p);
      },
      2);
  const std::string decrease =
      "V_k/rbar_{k-1} <= V_{k-1}/rbar_{k-2} - (1 + g) eta^2/rbar_{k-2}, g = phi'P phi, as 1/beta <= 1 + g";
  return {
      make_statement(
          "chapter-5/theorem-5.2/5.25",
          "(5.25): the sum of eta_k^2/rbar_{k-2} is finite, at most V_0/rbar_{-1}, " + kStart + ".", sums,
          decrease + ".", {}),
      make_statement(
          "chapter-5/theorem-5.2/5.26",
          "(5.26): the sum of phi'P phi eta_k^2/rbar_{k-2} is finite, at most V_0/rbar_{-1}, " + kStart + ".",
          sums, decrease + ".", {}),
      make_statement(
          "chapter-5/corollary-5.2.1/5.27",
          "(5.27): |theta_k - theta_{k-1}|^2 tends to 0, and the sum of all is at most Lambda "
          "V_0/rbar_{-1}, " +
              kStart + ".",
          rigor::conjunction({sums, steps}),
          "theta_k - theta_{k-1} = P phi eta, and phi'P^2 phi <= (Lambda/rbar_{k-2}) phi'P phi, since p^2 <= "
          "(Lambda/rbar) p for every eigenvalue p of P: Lambda times the sum of (5.26).",
          {}),
      make_statement(
          "chapter-5/corollary-5.2.1/limit",
          "The estimates converge to a limit (section 5.3.2, where (5.27) alone would allow them to drift "
          "for "
          "ever), " +
              kData + ".",
          is_inverse_update(),
          "P'^-1 = P^-1 + phi phi' (an identity, checked with two parameters), so that M_k = (beta_0 ... "
          "beta_k) "
          "P_k^-1 never decreases and M_k (theta_k - theta*) never changes: theta_k - theta* = M_k^-1 M_0 "
          "(theta_0 - theta*), and M_k^-1 converges.",
          {}),
      make_statement(
          "chapter-5/convergence-rate",
          "P_k tends to 0 (section 5.3.2), " + kData +
              ", v is not 0 and the plant has no pole at e^{j omega}.",
          is_determinant_update(),
          "Were rbar bounded, so would det P^-1 be, as det P' = det P/(1 + g) (an identity, checked with two "
          "parameters) and beta >= 1/(1 + g); P would stay above a multiple of I, the sum of g, and with it "
          "that of "
          "|phi|^2, would be finite, and A1 v = A1 y - B1 u would tend to 0, which is a sinusoid of a size "
          "other "
          "than 0. So rbar grows beyond all bounds, and lambda_max(P) <= Lambda/rbar.",
          {})};
}

}  // namespace

std::vector<Statement> parameter_convergence_claims() {
  std::vector<Statement> statements = error_statements();
  for (auto part : {factor_statements(), sum_statements()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace veritrack::theorems

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

/// K_i = p_1i / (p_11 + r) from scaled and from unscaled values, multiplied out: variables alpha, p_11, p_1i,
/// r.
Verdict gain_is_unchanged() {
  return rigor::vanishes<4>(
      [](const std::array<Interval, 4>& x) {
        const auto& [alpha, p11, p1i, r] = x;
        return alpha * p1i * (p11 + r) - p1i * (alpha * p11 + alpha * r);
      },
      2);
}

/// (p_ij - p_1i p_1j / (p_11 + r)) alpha from both, multiplied out by (p_11 + r)(alpha p_11 + alpha r):
/// variables alpha, p_11, p_1i, p_1j, p_ij, r.
Verdict update_is_scaled() {
  return rigor::vanishes<6>(
      [](const std::array<Interval, 6>& x) {
        const auto& [alpha, p11, p1i, p1j, pij, r] = x;
        const Interval s = p11 + r;
        const Interval scaled_s = alpha * p11 + alpha * r;
        return (alpha * pij * scaled_s - alpha * p1i * alpha * p1j) * s -
               alpha * (pij * s - p1i * p1j) * scaled_s;
      },
      3);
}

/// One entry of sum_kl f_ik p_kl f_jl + q_ij is linear in (p, q): one term and the noise represent all.
Verdict prediction_is_scaled() {
  return rigor::vanishes<5>(
      [](const std::array<Interval, 5>& x) {
        const auto& [alpha, fik, fjl, pkl, qij] = x;
        return (fik * (alpha * pkl) * fjl + alpha * qij) - alpha * (fik * pkl * fjl + qij);
      },
      1);
}

theorems::Quantity gain(const std::string& name, const Interval& value) {
  theorems::Quantity quantity;
  quantity.name = name;
  quantity.source = "this program";
  quantity.value = value;
  return quantity;
}

}  // namespace

std::vector<Statement> proposition_2() {
  std::vector<Statement> statements;
  statements.push_back(theorems::make_statement(
      "proposition-2/scaled-start",
      "With Q, r and P(0) all multiplied by the same α > 0 the gains and estimates are the same at every "
      "sample, and P is multiplied by α.",
      rigor::conjunction({gain_is_unchanged(), update_is_scaled(), prediction_is_scaled()}),
      "identities of the maps: the gain, each entry of the measurement update and of the time update, "
      "exactly evaluated as polynomials in the entries, r and α; the rest is induction over the samples",
      {}));

  // P(1|0) = F P(0) F' + Q from P(0) = 0 is Q, and then scales; from P(0) = I, x = (0, 0, 0) and F = I it is
  // I + Q. With Q = alpha I, r = alpha: K1 = (1 + alpha) / (1 + 2 alpha).
  const auto first_gain = [](double alpha) {
    return (Interval(1.0) + Interval(alpha)) / (Interval(1.0) + Interval(2.0) * Interval(alpha));
  };
  const Interval once = first_gain(1.0);
  const Interval twice = first_gain(2.0);
  // cannot bind (twice): 3/5 and 2/3.
  statements.push_back(theorems::make_statement(
      "proposition-2/same-start",
      "With q and r multiplied by α and the same P(0), the estimates are the same (one reading of \"the same "
      "initialization\", of which the paper's proof names the state only).",
      rigor::certainly_less(twice, once) ? Verdict::refuted : Verdict::undecided,
      fmt::format(
          "Q = q I with q = r = 1, P(0|0) = I, x(0|0) = (0, 0, 0): the first gain K1 is {}; with α = 2 "
          "it is {}, and so is x1(1|1) for y(1) = 1",
          theorems::enclosed(once), theorems::enclosed(twice)),
      {gain("gain", once), gain("gain_scaled", twice)}));
  theorems::cite_findings(statements);
  return statements;
}

}  // namespace veritrack::single_channel

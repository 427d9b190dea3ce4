#include <array>
#include <string>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/polynomial_identity.hpp"
#include "analysis/statements/comparison.hpp"
#include "papers/dft_block/thesis_claims.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::parse_decimal;
using rigor::Verdict;
using theorems::enclosed;
using theorems::make_statement;
using theorems::Statement;
using theorems::Strictness;

/// Tables 4.1 and 4.2. Variances of the samples, signal units squared.
struct DataSet {
  const char *snr, *variance, *q2, *q3, *r_d;
};
constexpr std::array kDataSets{DataSet{"0", "1", "0.0010", "0.0025", "12.50"},
                               DataSet{"-10", "10", "0.0010", "0.0045", "20.00"},
                               DataSet{"-20", "100", "0.0010", "0.0100", "125.0"}};

/// det (q1 e1, q3 e3, F q3 e3), F of (4.18) with the leak of the offset: the third column is q3 (0, 2 pi, 1 -
/// epsilon).
Interval determinant(const Interval& q1, const Interval& q3, const Interval& turn) {
  return q1 * (Interval(0.0) - q3 * (q3 * turn));
}

std::vector<Statement> controllability_statements() {
  const Interval found =
      abs(determinant(parse_decimal("0.00005"), parse_decimal("0.0025"), Interval(2.0) * rigor::pi()));
  const Verdict general = rigor::vanishes<4>(
      [](const std::array<Interval, 4>& at) {
        const auto& [q1, q3, turn, kept] = at;
        // Expanded along the first column: rows 2 and 3 of (0, q3) and (turn q3, kept q3).
        const Interval minor = Interval(0.0) * (kept * q3) - q3 * (turn * q3);
        return q1 * minor - determinant(q1, q3, turn);
      },
      2);
  return {
      make_statement("chapter-4/controllability/printed",
                     "With the state noise (4.33), q1 and q3 > 0 and none in the phase, [F, Q] is not "
                     "controllable, so that q2 > 0 is needed for that (section 4.4.2).",
                     decide(found, Interval(0.0), Strictness::weak),
                     "q1 and q3 of set 1: Q e1, Q e3 and F Q e3 have a determinant of size " +
                         enclosed(found) + ". The offset moves the phase.",
                     {}),
      make_statement(
          "chapter-4/controllability/corrected",
          "[F, Q] is controllable for all q1, q3 > 0 and q2 >= 0, with and without leak: (4.34) is one "
          "choice, (4.33) another.",
          general,
          "det (Q e1, Q e3, F Q e3) is -2 pi q1 q3^2 for q2 = 0, an identity; more noise takes nothing from "
          "the range of (Q, F Q, F^2 Q), as all of it is positive semidefinite.",
          {})};
}

std::vector<Statement> table_statements() {
  std::vector<Verdict> variances, guidelines;
  for (const DataSet& set : kDataSets) {
    // The SNRs are whole decades, so that the power of ten is exact.
    const int decades = -static_cast<int>(midpoint(parse_decimal(set.snr)) / 10.0);
    const Interval variance = parse_decimal(set.variance);
    variances.push_back(
        decide(abs(variance - pow(Interval(10.0), decades)), Interval(0.0), Strictness::weak));
    guidelines.push_back(decide(variance, parse_decimal(set.r_d), Strictness::weak));
    guidelines.push_back(decide(Interval(0.0), parse_decimal(set.q2), Strictness::strict));
    guidelines.push_back(decide(parse_decimal(set.q2), parse_decimal(set.q3), Strictness::weak));
  }
  // The mean of cos^2 over whole turns, for amplitude 1 and set 1.
  const Interval ratio = Interval(0.5) / parse_decimal(kDataSets[0].variance);
  return {
      make_statement("chapter-4/table-4.1/variance",
                     "The noise variances of Table 4.1 are 10^{-0.1 SNRmax}: 1, 10 and 100.",
                     rigor::conjunction(variances), "10^0, 10^1 and 10^2, exactly.", {}),
      make_statement(
          "chapter-4/table-4.1/snr",
          "SNRmax of Table 4.1 is the tone's mean power over the variance of the noise.",
          decide(abs(ratio - Interval(1.0)), parse_decimal("0.01"), Strictness::weak),
          "Set 1, closest range, amplitude 1: mean power 1/2, variance 1, where SNRmax = 0 dB says 1. "
          "Tables 4.1 and 4.2 count the amplitude squared over the variance, 3 dB more.",
          {}),
      make_statement("chapter-4/table-4.2/guidelines",
                     "The designs of Table 4.2 follow section 4.4: r^d is at least the variance of the noise "
                     "(4.31), and 0 < q2 <= q3.",
                     rigor::conjunction(guidelines),
                     "12.5 >= 1, 20 >= 10, 125 >= 100; q2 = 0.001, q3 = 0.0025, 0.0045 and 0.01.", {})};
}

Statement block_length_statement() {
  // A tone in the middle of its bin: (rho/2)^2 against sigma^2/T, both parts of the bin together.
  const auto ratio = [](const char* length, const char* snr) {
    return parse_decimal(length) * parse_decimal(snr) / Interval(4.0);
  };
  const auto is_one = [&](const char* length, const char* snr) {
    return decide(abs(ratio(length, snr) - Interval(1.0)), Interval(1e-12), Strictness::weak);
  };
  const Interval strong = ratio("1000", "0.01");
  const Interval weak = ratio("1000", "0.001");
  return make_statement(
      "chapter-4/block-length",
      "T >= 1000 is of the right size for -20 to -30 dB (section 4.4.4): a tone in the middle of its bin is "
      "as "
      "strong there as the noise from T = 400 on at -20 dB (rho^2/sigma^2), and from T = 4000 on at -30 dB.",
      rigor::conjunction({is_one("400", "0.01"), is_one("4000", "0.001")}),
      "The ratio is T rho^2/(4 sigma^2). At T = 1000 it is " + enclosed(strong) + " at -20 dB and " +
          enclosed(weak) + " at -30 dB.",
      {});
}

}  // namespace

std::vector<Statement> tuning_claims() {
  std::vector<Statement> statements = controllability_statements();
  for (Statement& statement : table_statements()) {
    statements.push_back(std::move(statement));
  }
  statements.push_back(block_length_statement());
  return statements;
}

}  // namespace veritrack::dft_block

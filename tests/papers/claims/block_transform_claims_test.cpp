#include "papers/claims/block_transform_claims.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>

#include "analysis/rigor/rounding.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;
using Number = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr Number kI(0.0, 1.0);

std::map<std::string, Verdict> verdicts() {
  const rigor::UpwardRounding upward;
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : theorems::block_transform_claims()) {
    CHECK_FALSE(statement.sentence.empty());
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
  }
  return found;
}

}  // namespace

TEST_CASE("what chapter 4 prints is decided as its formulas are right or wrong") {
  const std::map<std::string, Verdict> expected{
      {"chapter-4/transform/printed", Verdict::refuted}, {"chapter-4/transform/corrected", Verdict::proved},
      {"chapter-4/narrow-band/4.6", Verdict::refuted},   {"chapter-4/narrow-band/4.9", Verdict::proved},
      {"chapter-4/jacobian", Verdict::proved},           {"chapter-4/integer-offset", Verdict::refuted},
      {"chapter-4/larger-L", Verdict::refuted}};
  CHECK(verdicts() == expected);
}

TEST_CASE("sums over the samples in double precision say the same of (4.5), (4.6) and (4.9)") {
  constexpr int kBlock = 64;
  constexpr double kOffset = 0.25;
  constexpr double kPhase = 0.5;
  double printed = 0.0, corrected = 0.0, early = 0.0, late = 0.0;
  for (int bin = 14; bin <= 18; ++bin) {
    Number sum = 0.0;
    for (int t = 0; t < kBlock; ++t) {
      sum += std::cos(2.0 * kPi * (16.0 + kOffset) * t / kBlock + kPhase) *
             std::exp(-2.0 * kPi * kI * static_cast<double>(bin * t) / static_cast<double>(kBlock));
    }
    sum /= kBlock;
    const auto term = [](double places, double sign) {
      return std::exp(sign * kI * (kPhase + kPi * (kBlock - 1.0) / kBlock * places)) *
             std::sin(kPi * places) / (2.0 * kBlock * std::sin(kPi * places / kBlock));
    };
    const double d = 16.0 - bin + kOffset;
    const double mirrored = 16.0 + bin + kOffset;
    printed = std::max(printed, std::abs(sum - term(d, 1.0) - term(mirrored, 1.0)));
    corrected = std::max(corrected, std::abs(sum - term(d, 1.0) - term(mirrored, -1.0)));
    const auto narrow = [&](double sign) {
      return std::exp(kI * kPhase) * (std::exp(sign * 2.0 * kPi * kI * kOffset) - 1.0) / (4.0 * kPi * kI * d);
    };
    early = std::max(early, std::abs(sum - narrow(-1.0)));
    late = std::max(late, std::abs(sum - narrow(1.0)));
  }
  CHECK(printed > 1e-3);
  CHECK(corrected < 1e-12);
  CHECK(early > 2.0 / kBlock);
  CHECK(late < 2.0 / kBlock);
}

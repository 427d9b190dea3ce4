#include "analysis/search/golden_section.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::search {
namespace {

TEST_CASE("the golden section comes near the bottom of a valley, and tells the cost there") {
  const auto cost = [](double x) { return (x - 0.3) * (x - 0.3) + 2.0; };
  const GoldenPoint best = golden_section(-4.0, 3.0, 40, cost);
  CHECK(std::fabs(best.point - 0.3) < 1e-6);
  CHECK(best.cost == cost(best.point));
}

TEST_CASE("the golden section runs to the end where the cost only falls or only rises") {
  CHECK(golden_section(0.0, 1.0, 60, [](double x) { return x; }).point < 1e-9);
  CHECK(golden_section(0.0, 1.0, 60, [](double x) { return -x; }).point > 1.0 - 1e-9);
}

TEST_CASE("a step narrows the interval by 0.618, with one new cost each") {
  int calls = 0;
  (void)golden_section(0.0, 1.0, 12, [&](double x) {
    ++calls;
    return std::fabs(x - 0.5);
  });
  CHECK(calls == 14);
}

TEST_CASE("what ends at enough would have ended no higher") {
  const auto cost = [](double x) { return std::fabs(x - 0.3); };
  const double least = golden_section(-4.0, 3.0, 40, cost).cost;
  for (const double enough : {3.0, 0.5, 0.01, 1e-5}) {
    int calls = 0;
    const GoldenPoint found = golden_section(
        -4.0, 3.0, 40,
        [&](double x) {
          ++calls;
          return cost(x);
        },
        enough);
    CAPTURE(enough);
    CHECK(found.cost == cost(found.point));
    CHECK(found.cost <= enough);
    CHECK(found.cost >= least);
    CHECK(calls < 42);
  }
  CHECK(golden_section(-4.0, 3.0, 40, cost, -1.0).cost == least);
}

}  // namespace
}  // namespace veritrack::search

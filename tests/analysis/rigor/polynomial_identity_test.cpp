#include "analysis/rigor/polynomial_identity.hpp"

#include <doctest/doctest.h>

#include <array>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

TEST_CASE("an identity is proved, a non-identity refuted, and rounding decides neither") {
  const rigor::UpwardRounding upward;
  using Point = std::array<Interval, 2>;
  const auto square_of_sum = [](const Point& x) {
    return (x[0] + x[1]) * (x[0] + x[1]) - (x[0] * x[0] + Interval(2.0) * x[0] * x[1] + x[1] * x[1]);
  };
  CHECK(vanishes<2>(square_of_sum, 2) == Verdict::proved);
  CHECK(vanishes<2>([](const Point& x) { return x[0] * x[1]; }, 1) == Verdict::refuted);
  CHECK(vanishes<2>([](const Point& x) { return x[0] * (x[0] - Interval(1.0)) * (x[0] + Interval(1.0)); },
                    3) == Verdict::refuted);
  CHECK(vanishes<2>([](const Point&) { return Interval::from_bounds(-1e-300, 1e-300); }, 1) ==
        Verdict::undecided);
  CHECK(vanishes<2>([](const Point&) { return Interval::empty(); }, 1) == Verdict::undecided);
}

}  // namespace veritrack::rigor

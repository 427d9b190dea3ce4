#include "analysis/search/bisection_cover.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace veritrack::search {
namespace {

struct Part {
  double low = 0.0;
  double high = 1.0;
};

/// |x - 1/3| >= 1/100 or the part is narrower than `narrow`, which holds wherever it is.
CellDecision<Part> look_at(const Part& part, double narrow) {
  constexpr double kPlace = 1.0 / 3.0;
  constexpr double kApart = 0.01;
  const double middle = 0.5 * (part.low + part.high);
  const bool is_apart = part.high <= kPlace - kApart || part.low >= kPlace + kApart;
  return {is_apart || part.high - part.low < narrow, {{Part{part.low, middle}, Part{middle, part.high}}}};
}

TEST_CASE("parts that hold cover the whole, each point once") {
  double covered = 0.0;
  double end = 0.0;
  const auto cover = cover_by_bisection(Part{}, 1000, [&](const Part& part) {
    CellDecision<Part> seen = look_at(part, 1e-3);
    if (seen.holds) {
      CHECK(part.low == end);  // from the left to the right
      end = part.high;
      covered += part.high - part.low;
    }
    return seen;
  });
  CHECK(cover.is_proved);
  CHECK_FALSE(cover.failed);
  CHECK(covered == 1.0);
  // 1/100 on both sides of 1/3 in parts of 1/1024, and the halves on the way there.
  CHECK(cover.cells > 20);
  CHECK(cover.cells < 90);
}

TEST_CASE("a budget that is used up proves nothing") {
  const auto look = [](const Part& part) { return look_at(part, 1e-3); };
  const auto whole = cover_by_bisection(Part{}, 1000, look);
  CHECK(cover_by_bisection(Part{}, whole.cells, look).is_proved);
  const auto less = cover_by_bisection(Part{}, whole.cells - 1, look);
  CHECK_FALSE(less.is_proved);
  CHECK(less.failed);
  CHECK_FALSE(cover_by_bisection(Part{}, 0, look).is_proved);
}

TEST_CASE("a cell without parts ends the cover, and is named") {
  const auto cover = cover_by_bisection(Part{}, 1000, [](const Part& part) {
    CellDecision<Part> seen = look_at(part, 0.0);
    if (part.high - part.low < 1e-6) {
      seen.parts.reset();
    }
    return seen;
  });
  CHECK_FALSE(cover.is_proved);
  REQUIRE(cover.failed);
  CHECK(std::fabs(cover.failed->low - 1.0 / 3.0) < 0.01 + 1e-6);
}

}  // namespace
}  // namespace veritrack::search

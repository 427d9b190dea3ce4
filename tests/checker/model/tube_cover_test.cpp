#include "checker/model/tube_cover.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {
namespace {

/// Certain where a part is narrow enough; `halve_frequencies` is what an answer guesses.
bool covers(double half_turn, double half_z, std::optional<bool> halve_frequencies, std::int64_t& cells) {
  const auto ask = [&](std::size_t, const TubePart& part, const std::vector<std::size_t>& questions) {
    PartAnswer answer{questions, halve_frequencies};
    if (part.half_turn <= half_turn && part.half_z <= half_z) {
      answer.open.clear();
    }
    return answer;
  };
  return certain_everywhere({{4, 1, 1}}, ask, cells);
}

TEST_CASE("where it is not known which width makes a part fail, both are halved") {
  std::int64_t cells = 0;
  CHECK(covers(0x1p-3, 0.3, {}, cells));
  CHECK(covers(0x1p-9, 2.0, {}, cells));
  CHECK(covers(0x1p-8, 0.1, {}, cells));
  CHECK(cells > 0);
}

TEST_CASE("a wrong guess of which width makes a part fail does not make it fail for ever") {
  std::int64_t cells = 0;
  // Only frequencies help, and phases are halved; and the other way round.
  CHECK(covers(1.0, 0.5, false, cells));
  CHECK(covers(0x1p-4, 1.0, true, cells));
}

TEST_CASE("parts that are asked cover everything, and what one place needs does not divide all others") {
  // Finer and finer towards a quarter of a turn; the widths of the parts that were certain.
  std::mutex mutex;
  double area = 0.0;
  std::int64_t certain = 0;
  const auto ask = [&](std::size_t, const TubePart& part, const std::vector<std::size_t>& questions) {
    const double far = std::max(std::abs(part.turn - 0.25), 0x1p-10);
    const bool is_certain = part.half_turn <= far / 4.0 && part.half_z <= 0.25;
    if (is_certain && part.half_turn > 0.0) {
      const std::lock_guard lock(mutex);
      area += 2.0 * part.half_turn * part.half_z;
      ++certain;
    }
    return is_certain ? PartAnswer{} : PartAnswer{questions, part.half_z > 0.25};
  };
  std::int64_t cells = 0;
  CHECK(certain_everywhere({{4, 1, 1}}, ask, cells));
  CHECK(area == 1.0);  // of one turn, and z from -1 to 1 with half the weight
  CHECK(cells >= certain);
  CHECK(cells < 2 * certain);
  CHECK(certain < 1500);  // of equal ones as fine as the finest there would be 8192
}

TEST_CASE("what fails at a point fails, whatever is halved") {
  std::int64_t cells = 0;
  for (const std::optional<bool> guess : {std::optional<bool>(), std::optional(true), std::optional(false)}) {
    CHECK_FALSE(covers(-1.0, 1.0, guess, cells));
    CHECK_FALSE(covers(std::numeric_limits<double>::quiet_NaN(), 1.0, guess, cells));
  }
  CHECK_FALSE(certain_everywhere(
      {}, [](std::size_t, const TubePart&, const std::vector<std::size_t>&) { return PartAnswer{}; }, cells));
}

TEST_CASE("a first grid that is larger than the budget ends the work, and takes no memory before") {
  std::int64_t cells = 0;
  const auto ask = [](std::size_t, const TubePart&, const std::vector<std::size_t>&) { return PartAnswer{}; };
  constexpr std::size_t kMany = std::size_t{1} << 40U;  // a part of it each would take terabytes
  set_budget(100'000);
  CHECK_THROWS_AS((void)certain_everywhere({{kMany, 65'536, 1}}, ask, cells), OutOfBudget);
  set_budget(kDefaultBudget);
}

}  // namespace
}  // namespace veritrack::checker

// The drift inequality in a cell against the Gaussian integral of the textbook filter.
#include "checker/quadrature/lock_inequality.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Textbook;

namespace {

LockCell around(const std::array<double, 4>& x, double half_width) {
  LockCell cell{};
  for (std::size_t i = 0; i < 4; ++i) {
    cell.low[i] = x[i] - half_width;
    cell.high[i] = x[i] + half_width;
  }
  if (cell.low[3] < 0.0) {
    cell.high[3] -= cell.low[3];
    cell.low[3] = 0.0;
  }
  return cell;
}

lock_test::Vector errors_at(const Textbook& book, const std::array<double, 4>& x) {
  return book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]);
}

}  // namespace

TEST_CASE("where a cell is proved, the Gaussian integral of the textbook filter keeps the inequality") {
  test::Random random(5310);
  // With the noise of the set, and with so much that little is left.
  for (const double deviation : {0.056, 0.095}) {
    for (const double half_width : {0.15, 0.05}) {
      LockSet set = lock_test::WrittenSet().set();
      set.deviation = Ball(deviation);
      const Textbook book{{}, set};
      const LockInequality inequality(book.design.filter(), set, left_of_drift(set));
      int proved = 0;
      double closest = -1e9;
      const auto count = test::effort(40);
      for (std::int64_t k = 0; k < count; ++k) {
        const LockCell cell = around(lock_test::somewhere(set, random), half_width);
        if (!inequality.look(cell).proved) {
          continue;
        }
        ++proved;
        for (int l = 0; l < 20; ++l) {
          std::array<double, 4> x{};
          for (std::size_t i = 0; i < 4; ++i) {
            x[i] = random.uniform(cell.low[i], cell.high[i]);
          }
          const double excess = book.excess(errors_at(book, x), book.covariance_of_level(x[3], random), x[3]);
          CHECK(excess <= 0.0);
          closest = std::max(closest, excess);
        }
      }
      MESSAGE("deviation " << deviation << ", half width " << half_width << ": " << proved << " of " << count
                           << " cells proved, closest " << closest);
      CHECK(4 * proved > count);
    }
  }
}

TEST_CASE("with a leak a proved cell is one for all frequencies of the set") {
  test::Random random(5312);
  const LockSet set = lock_test::leaking_set();
  const Textbook book{lock_test::leaking_variances(), set};
  const LockInequality inequality(book.design.filter(), set, left_of_drift(set));
  int proved = 0;
  const auto count = test::effort(40);
  for (std::int64_t k = 0; k < count; ++k) {
    const LockCell cell = around(lock_test::somewhere(set, random), 0.1);
    if (!inequality.look(cell).proved) {
      continue;
    }
    ++proved;
    for (int l = 0; l < 20; ++l) {
      std::array<double, 4> x{};
      for (std::size_t i = 0; i < 4; ++i) {
        x[i] = random.uniform(cell.low[i], cell.high[i]);
      }
      const Matrix p = book.covariance_of_level(x[3], random);
      CHECK(book.excess(errors_at(book, x), p, x[3], l % 2 == 0 ? 1.4 : 1.6) <= 0.0);
    }
  }
  MESSAGE(proved << " of " << count << " cells proved");
  CHECK(4 * proved > count);
}

TEST_CASE("a cell with a point where the integral grows is not proved") {
  test::Random random(5311);
  LockSet set = lock_test::WrittenSet().set();
  // Where the inequality fails and where it holds: levels beyond that of the set, and noise that is too
  // large.
  for (const auto& [level, deviation] : {std::pair{5.0, 0.11}, std::pair{5.0, 0.13}, std::pair{1.0, 0.16}}) {
    set.level = Ball(level);
    set.deviation = Ball(deviation);
    const Textbook book{{}, set};
    const LockInequality inequality(book.design.filter(), set, left_of_drift(set));
    int grows = 0;
    int looked = 0;
    for (std::int64_t k = 0; k < test::effort(200); ++k) {
      const std::array<double, 4> x = lock_test::somewhere(set, random);
      const double excess = book.excess(errors_at(book, x), book.covariance_of_level(x[3], random), x[3]);
      ++looked;
      if (!(excess <= 0.0)) {
        ++grows;
        for (const double half_width : {0.2, 0.02, 0.0}) {
          CHECK_FALSE(inequality.look(around(x, half_width)).proved);
        }
      }
    }
    MESSAGE("level " << level << ", deviation " << deviation << ": grows at " << grows << " of " << looked);
    CHECK(10 * grows > looked);
  }
}

TEST_CASE("a drift, a walk, a noise or a level of the covariance that is worse undoes a proof") {
  // A cell whose inequality is not much more than true: each number is moved until the proof ends, and the
  // textbook agrees not much later.
  const LockSet set = lock_test::WrittenSet().set();
  const LockCell cell = around({1.5, 1.5, 1.5, 0.5}, 0.01);
  const auto proves = [&](const LockSet& other) {
    return LockInequality(lock_test::Variances().filter(), other, left_of_drift(other)).look(cell).proved;
  };
  CHECK(proves(set));
  const auto excess_of = [&](const LockSet& other) {
    test::Random random(5312);
    const Textbook book{{}, other};
    double most = -1e9;
    for (int k = 0; k < 4000; ++k) {
      const std::array<double, 4> x{1.5, 1.5, 1.5, 0.5};
      most = std::max(most, book.excess(errors_at(book, x), book.covariance_of_level(x[3], random), x[3]));
    }
    return most;
  };
  const auto last_proved = [&](auto change) {
    double low = 0.0;
    double high = 1.0;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (low + high);
      LockSet other = set;
      change(other, middle);
      (proves(other) ? low : high) = middle;
    }
    LockSet just = set;
    change(just, low);
    CHECK(excess_of(just) <= 0.0);
    LockSet beyond = set;
    change(beyond, high);
    CHECK_FALSE(proves(beyond));
    return low;
  };
  const double noise = last_proved([](LockSet& s, double x) { s.deviation = Ball(0.056 + 0.1 * x); });
  const double walk = last_proved([](LockSet& s, double x) { s.walk = Ball(0.0036 + 0.04 * x); });
  MESSAGE("deviation up to " << 0.056 + 0.1 * noise << ", walk up to " << 0.0036 + 0.04 * walk);
  CHECK(noise < 1.0);
  CHECK(walk < 1.0);
}

TEST_CASE("only cells beyond the level are left out") {
  const LockSet set = lock_test::WrittenSet().set();
  const LockInequality inequality(lock_test::Variances().filter(), set, left_of_drift(set));
  // |u|^2 + 2.17 s^2 = 10 on the rim.
  CHECK(inequality.outside({{3.17, -0.1, 0.0, 0.0}, {3.2, 0.1, 0.1, 0.1}}));
  CHECK_FALSE(inequality.outside({{3.16, -0.1, 0.0, 0.0}, {3.2, 0.1, 0.1, 0.1}}));
  CHECK(inequality.outside({{0.0, -3.2, 0.0, 0.0}, {3.2, -3.17, 0.1, 0.1}}));
  CHECK(inequality.outside({{0.0, 0.0, 0.0, 2.15}, {3.2, 0.1, 0.1, 2.2}}));
  CHECK_FALSE(inequality.outside({{0.0, 0.0, 0.0, 2.14}, {3.2, 0.1, 0.1, 2.2}}));
}

TEST_CASE("a cell that is no box is not proved") {
  const LockSet set = lock_test::WrittenSet().set();
  const LockInequality inequality(lock_test::Variances().filter(), set, left_of_drift(set));
  const double nothing = std::nan("");
  CHECK_FALSE(inequality.look({{nothing, 0.0, 0.0, 0.0}, {0.1, 0.1, 0.1, 0.1}}).proved);
  CHECK_FALSE(inequality.look({{0.0, 0.0, 0.0, 0.0}, {0.1, HUGE_VAL, 0.1, 0.1}}).proved);
  CHECK_FALSE(inequality.look({{0.0, 0.0, 0.0, nothing}, {0.1, 0.1, 0.1, nothing}}).proved);
}

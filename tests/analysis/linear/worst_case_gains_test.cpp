#include "analysis/linear/worst_case_gains.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;
using Matrix = std::vector<std::vector<long double>>;

std::vector<Row> intervals(const Matrix& a) {
  std::vector<Row> rows;
  for (const auto& row : a) {
    rows.emplace_back();
    for (const long double x : row) {
      rows.back().emplace_back(static_cast<double>(x));
    }
  }
  return rows;
}

/// c A^k, by multiplying on.
std::vector<long double> next_row(const std::vector<long double>& row, const Matrix& a) {
  std::vector<long double> next(row.size(), 0.0L);
  for (std::size_t j = 0; j < row.size(); ++j) {
    for (std::size_t l = 0; l < row.size(); ++l) {
      next[j] += row[l] * a[l][j];
    }
  }
  return next;
}

TEST_CASE("of one state the gain is that of a geometric series") {
  const rigor::UpwardRounding upward;
  for (const double pole : {0.5, -0.75, 0.984375, 0.0}) {
    const auto gains =
        worst_case_gains({{Interval(pole)}}, {{{{Interval(3.0)}}}}, {{Interval(2.0)}}, 4096, 8);
    REQUIRE(gains.has_value());
    const double exact = 6.0 / (1.0 - std::fabs(pole));
    CHECK(gains->inputs[0][0].total() >= exact);
    CHECK(gains->inputs[0][0].total() <= exact * (1.0 + 1e-12));
    CHECK(gains->starts[0][0].blocks[0] >= 2.0);
    CHECK(gains->starts[0][0].blocks[0] <= 2.0 + 1e-12);
    CHECK(gains->starts[0][0].blocks[7] >= 2.0 * std::pow(std::fabs(pole), 7.0 * 512.0));
  }
}

TEST_CASE("a horizon that is too short makes bounds longer, never too short") {
  const rigor::UpwardRounding upward;
  const double pole = 0.9375;
  double last = INFINITY;
  for (const std::size_t samples : {64U, 128U, 256U, 512U}) {
    const auto gains =
        worst_case_gains({{Interval(pole)}}, {{{{Interval(1.0)}}}}, {{Interval(1.0)}}, samples, 4);
    REQUIRE(gains.has_value());
    CHECK(gains->inputs[0][0].total() >= 16.0);
    CHECK(gains->inputs[0][0].total() <= last * (1.0 + 1e-12));
    last = gains->inputs[0][0].total();
  }
  CHECK(last <= 16.0 * (1.0 + 1e-9));
}

TEST_CASE("nothing is said of a recursion that does not decay") {
  const rigor::UpwardRounding upward;
  for (const double pole : {1.0, -1.0, 1.5}) {
    CHECK_FALSE(
        worst_case_gains({{Interval(pole)}}, {{{{Interval(1.0)}}}}, {{Interval(1.0)}}, 256, 4).has_value());
    CHECK_FALSE(proposed_horizon({{Interval(pole)}}, 4, 1e-8, 1U << 20U).has_value());
  }
  const Interval around_one = Interval::from_bounds(0.5, 1.0);
  CHECK_FALSE(worst_case_gains({{around_one}}, {{{{Interval(1.0)}}}}, {{Interval(1.0)}}, 256, 4).has_value());
  CHECK_THROWS_AS((void)worst_case_gains({{Interval(0.5)}}, {}, {}, 10, 4), std::invalid_argument);
}

TEST_CASE("random recursions: sums in long double, block by block") {
  const rigor::UpwardRounding upward;
  test::Random random(37001);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    // A rotation that decays, and a real mode that feeds it.
    const double decay = random.uniform(0.8, 0.97);
    const double angle = random.uniform(0.0, std::numbers::pi);
    Matrix a{{decay * std::cos(angle), -decay * std::sin(angle), random.uniform(-1.0, 1.0)},
             {decay * std::sin(angle), decay * std::cos(angle), random.uniform(-1.0, 1.0)},
             {0.0L, 0.0L, random.uniform(-0.9, 0.9)}};
    for (auto& row : a) {
      for (long double& x : row) {
        x = static_cast<double>(x);
      }
    }
    const std::vector<long double> form{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0L};
    const std::vector<long double> first{0.3L, -0.2L, 1.0L};
    const std::vector<long double> second{static_cast<double>(random.uniform(-1.0, 1.0)), 0.5L, 0.0L};
    Row row;
    GainInput disc{{Row(), Row()}};
    for (std::size_t i = 0; i < 3; ++i) {
      row.emplace_back(static_cast<double>(form[i]));
      disc.columns[0].emplace_back(static_cast<double>(first[i]));
      disc.columns[1].emplace_back(static_cast<double>(second[i]));
    }
    const std::size_t samples = 2048;
    const auto gains = worst_case_gains(intervals(a), {disc}, {row}, samples, 16);
    REQUIRE(gains.has_value());
    std::vector<long double> response = form;
    long double all = 0.0L;
    for (std::size_t block = 0; block < 16; ++block) {
      long double sum = 0.0L;
      long double largest = 0.0L;
      for (std::size_t k = 0; k < samples / 16; ++k) {
        long double u = 0.0L;
        long double v = 0.0L;
        for (std::size_t i = 0; i < 3; ++i) {
          u += response[i] * static_cast<double>(first[i]);
          v += response[i] * static_cast<double>(second[i]);
        }
        sum += std::hypot(u, v);
        largest = std::max(largest, std::fabs(response[0]));
        response = next_row(response, a);
      }
      all += sum;
      const double bound = gains->inputs[0][0].blocks[block] + gains->inputs[0][0].missed;
      CHECK(static_cast<long double>(bound) >= sum * (1.0L - 1e-12L) - 1e-18L);
      CHECK(static_cast<long double>(gains->starts[0][0].blocks[block]) >=
            largest * (1.0L - 1e-12L) - 1e-18L);
    }
    CHECK(static_cast<long double>(gains->inputs[0][0].total()) <= all * (1.0L + 1e-9L));
  }
}

TEST_CASE("a matrix that changes from sample to sample within its intervals keeps the bound") {
  const rigor::UpwardRounding upward;
  test::Random random(37002);
  const Interval entry = Interval::from_bounds(0.85, 0.9);
  const std::vector<Row> a{{entry, Interval(0.05)}, {Interval(-0.05), entry}};
  const auto gains =
      worst_case_gains(a, {{{{Interval(1.0), Interval(0.0)}}}}, {{Interval(1.0), Interval(0.0)}}, 1024, 4);
  REQUIRE(gains.has_value());
  double largest = 0.0;
  for (int run = 0; run < 200; ++run) {
    double x = 0.0;
    double y = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double p = random.below(2) == 0 ? 0.85 : 0.9;
      const double q = random.below(2) == 0 ? 0.85 : 0.9;
      const double next = p * x + 0.05 * y + (run == 0 || random.below(8) > 0 ? 1.0 : -1.0);
      y = -0.05 * x + q * y;
      x = next;
      largest = std::max(largest, std::fabs(x));
    }
  }
  CHECK(largest <= gains->inputs[0][0].total());
  CHECK(largest >= 0.5 * gains->inputs[0][0].total());
}

}  // namespace
}  // namespace veritrack::linear

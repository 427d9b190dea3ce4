#include "analysis/rigor/rounding.hpp"

#include <doctest/doctest.h>

#include <thread>

#include "tests/analysis/rigor/mpfr_oracle.hpp"
#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;

TEST_CASE("scopes hold, nest and restore the rounding mode") {
  CHECK_FALSE(rigor::rounding_is_upward());
  {
    const rigor::UpwardRounding outer;
    CHECK(rigor::rounding_is_upward());
    {
      const rigor::NearestRounding inner;
      CHECK_FALSE(rigor::rounding_is_upward());
      CHECK_THROWS_AS(rigor::require_upward_rounding(), rigor::RoundingModeError);
    }
    CHECK(rigor::rounding_is_upward());
    CHECK_NOTHROW(rigor::require_upward_rounding());
  }
  CHECK_FALSE(rigor::rounding_is_upward());
}

TEST_CASE("unwinding restores the rounding mode") {
  const auto throwing = [] {
    const rigor::UpwardRounding mode;
    throw 1;
  };
  CHECK_THROWS_AS(throwing(), int);
  CHECK_FALSE(rigor::rounding_is_upward());
}

TEST_CASE("a scope clears flush-to-zero, and gives it back") {
  const unsigned int control = rigor::detail::read_control();
  rigor::detail::write_control(control | rigor::detail::kFlushMask);
  const bool refused_outside = !rigor::rounding_is_upward();
  const bool held_inside = upward([] { return rigor::rounding_is_upward(); });
  const double halved = upward([] { return rigor::mul_up(kSmallestNormal, 0.5); });
  const unsigned int after = rigor::detail::read_control();
  rigor::detail::write_control(control);
  CHECK(refused_outside);
  CHECK(held_inside);
  CHECK(halved == std::ldexp(1.0, -1023));
  CHECK((after & rigor::detail::kFlushMask) == rigor::detail::kFlushMask);
}

TEST_CASE("upward mode with denormals flushed is not fit for intervals") {
  const rigor::UpwardRounding mode;
  const unsigned int control = rigor::detail::read_control();
  for (const unsigned int flag : {0x8000U, 0x0040U}) {
    rigor::detail::write_control(control | flag);
    const bool fit = rigor::rounding_is_upward();
    rigor::detail::write_control(control);
    CHECK_FALSE(fit);
  }
}

TEST_CASE("a thread holds a mode of its own") {
  const rigor::UpwardRounding mode;
  bool upward_in_scope = false;
  std::thread([&] {
    const rigor::NearestRounding nearest;
    const rigor::UpwardRounding own;
    upward_in_scope = rigor::rounding_is_upward();
  }).join();
  CHECK(upward_in_scope);
  CHECK(rigor::rounding_is_upward());
}

TEST_CASE("scalar operations are correctly rounded in both directions") {
  Operands operands(1);
  Oracle x;
  Oracle y;
  Oracle exact;
  Misses misses;
  struct Operation {
    const char* name;
    double (*down)(double, double);
    double (*up)(double, double);
    int (*oracle)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
  };
  const Operation operations[] = {{"add", rigor::add_down, rigor::add_up, mpfr_add},
                                  {"sub", rigor::sub_down, rigor::sub_up, mpfr_sub},
                                  {"mul", rigor::mul_down, rigor::mul_up, mpfr_mul},
                                  {"div", rigor::div_down, rigor::div_up, mpfr_div}};
  for (std::int64_t round = effort(200'000); round > 0; --round) {
    const double a = operands.number();
    const double b = operands.coin() ? operands.number() : neighbour(a, static_cast<int>(round % 3) - 1);
    x = a;
    y = b;
    for (const Operation& operation : operations) {
      if (operation.oracle == mpfr_div && b == 0.0) {
        continue;
      }
      const rigor::UpwardRounding mode;
      const double down = operation.down(a, b);
      const double up = operation.up(a, b);
      const rigor::NearestRounding oracle_mode;
      exact.evaluate(operation.oracle, x.value(), y.value());
      misses.expect(down == exact.rounded_down() && up == exact.rounded_up(), operation.name, a, b, down, up);
    }
    const double magnitude = std::fabs(a);
    x = magnitude;
    exact.evaluate(mpfr_sqrt, x.value());
    const double down = upward([&] { return rigor::sqrt_down(magnitude); });
    const double up = upward([&] { return rigor::sqrt_up(magnitude); });
    misses.expect(down == exact.rounded_down() && up == exact.rounded_up(), "sqrt", magnitude, down, up);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

#include "analysis/rigor/taylor_functions.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/dual_functions.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

template <int Degree>
using TwoVariables = rigor::TaylorModel<2, Degree>;

/// A function on models, the truth, and where to try it.
template <int Degree>
struct Function {
  std::string name;
  TwoVariables<Degree> (*on_models)(const TwoVariables<Degree>&);
  long double (*truth)(long double);
  double lower, upper;
};

template <int Degree>
std::vector<Function<Degree>> functions() {
  using M = TwoVariables<Degree>;
  using L = long double;
  return {
      {"sin", [](const M& x) { return sin(x); }, [](L x) { return std::sin(x); }, -5.0, 5.0},
      {"cos", [](const M& x) { return cos(x); }, [](L x) { return std::cos(x); }, -5.0, 5.0},
      {"tan", [](const M& x) { return tan(x); }, [](L x) { return std::tan(x); }, -1.0, 1.0},
      {"asin", [](const M& x) { return asin(x); }, [](L x) { return std::asin(x); }, -0.7, 0.7},
      {"acos", [](const M& x) { return acos(x); }, [](L x) { return std::acos(x); }, -0.7, 0.7},
      {"atan", [](const M& x) { return atan(x); }, [](L x) { return std::atan(x); }, -3.0, 3.0},
      {"sqrt", [](const M& x) { return sqrt(x); }, [](L x) { return std::sqrt(x); }, 0.5, 3.0},
      {"exp", [](const M& x) { return exp(x); }, [](L x) { return std::exp(x); }, -2.0, 2.0},
      {"log", [](const M& x) { return log(x); }, [](L x) { return std::log(x); }, 0.5, 3.0},
      {"atan2(x, 2)", [](const M& x) { return atan2(x, M(2.0)); }, [](L x) { return std::atan2(x, 2.0L); },
       -3.0, 3.0},
      {"atan2(1, x)", [](const M& x) { return atan2(M(1.0), x); }, [](L x) { return std::atan2(1.0L, x); },
       -3.0, 3.0},
  };
}

template <int Degree>
void check_functions() {
  test::Random random(1400 + Degree);
  for (const Function<Degree>& function : functions<Degree>()) {
    CAPTURE(function.name);
    for (std::int64_t round = 0; round < test::effort(200); ++round) {
      const double at = random.uniform(function.lower, function.upper);
      const double width = 0.1 * random.uniform();
      CAPTURE(at);
      const rigor::UpwardRounding upward;
      const auto x = TwoVariables<Degree>::variable(Interval::from_bounds(at - width, at + width), 0);
      const TwoVariables<Degree> result = function.on_models(x);
      REQUIRE(std::isfinite(result.remainder()));
      for (int k = 0; k < 8; ++k) {
        const double place = k < 2 ? 2.0 * k - 1.0 : random.uniform(-1.0, 1.0);
        const long double point = static_cast<long double>(x.constant()) +
                                  static_cast<long double>(x.linear(0)) * static_cast<long double>(place);
        long double polynomial = 0.0L;
        for (std::size_t i = 0; i < TwoVariables<Degree>::kTerms; ++i) {
          const auto& exponents = TwoVariables<Degree>::Monomials::kExponents[i];
          if (exponents[1] == 0) {
            polynomial += static_cast<long double>(result.coefficients()[i]) *
                          std::pow(static_cast<long double>(place), exponents[0]);
          }
        }
        CHECK(std::fabs(function.truth(point) - polynomial) <=
              static_cast<long double>(result.remainder()) + 1e-17L);
      }
      // Not merely wide: of the order of the first power that is left out.
      CHECK(result.remainder() <= 1e-12 + 300.0 * std::pow(width, std::min(Degree + 1, 5)));
    }
  }
}

TEST_CASE("functions of Taylor models hold the function") {
  check_functions<2>();
  check_functions<4>();
  check_functions<6>();
}

TEST_CASE("nothing is known where a function is not defined or not smooth") {
  const rigor::UpwardRounding upward;
  using M = TwoVariables<4>;
  const M around_zero = M::variable(Interval::from_bounds(-0.1, 0.1), 0);
  const M around_one = M::variable(Interval::from_bounds(0.9, 1.1), 0);
  const M far = M::variable(Interval::from_bounds(-0.1, 2.0), 0);
  CHECK(std::isnan(sqrt(around_zero).remainder()));
  CHECK(std::isnan(log(around_zero).remainder()));
  CHECK(std::isnan(asin(around_one).remainder()));
  CHECK(std::isnan(acos(around_one).remainder()));
  CHECK(std::isnan(tan(far).remainder()));
  CHECK(std::isnan(atan2(around_zero, M(-1.0)).remainder()));
  CHECK(std::isnan(atan2(around_zero, around_zero).remainder()));
  CHECK(std::isnan(exp(M()).remainder()));
  CHECK(std::isnan(stays_within(around_one, M(0.0), M(1.0)).remainder()));
  CHECK(std::isnan(stays_within(around_one, M(1.0), M(2.0)).remainder()));
  CHECK(stays_within(around_one, M(0.5), M(1.5)).remainder() == around_one.remainder());
}

TEST_CASE("asin, acos and stays_within of dual numbers") {
  using Dual = rigor::Dual<Interval, 2>;
  test::Random random(1490);
  for (std::int64_t round = 0; round < test::effort(500); ++round) {
    const double at = random.uniform(-0.99, 0.99);
    CAPTURE(at);
    const long double slope = 1.0L / std::sqrt(1.0L - static_cast<long double>(at) * at);
    const auto holds = [](const Interval& enclosure, long double truth) {
      const long double margin = 1e-17L * (1.0L + std::fabs(truth));
      return static_cast<long double>(enclosure.lower()) <= truth + margin &&
             static_cast<long double>(enclosure.upper()) >= truth - margin;
    };
    const rigor::Dual<double, 2> plain = asin(rigor::Dual<double, 2>(at, {1.0, 0.0}));
    CHECK(std::fabs(plain.derivative(0) - static_cast<double>(slope)) <= 1e-12 * static_cast<double>(slope));
    const rigor::UpwardRounding upward;
    const Dual x = rigor::variable<2>(Interval(at), 0);
    CHECK(holds(asin(x).value(), std::asin(static_cast<long double>(at))));
    CHECK(holds(asin(x).derivative(0), slope));
    CHECK(holds(acos(x).value(), std::acos(static_cast<long double>(at))));
    CHECK(holds(acos(x).derivative(0), -slope));
    CHECK(holds(acos(x).derivative(1), 0.0L));
    const Dual within = stays_within(x, Dual(-1.0), Dual(1.0));
    CHECK(within.value() == x.value());
    CHECK(holds(within.derivative(0), 1.0L));
    CHECK(rigor::is_empty(stays_within(x, Dual(at), Dual(1.0)).derivative(0)));
    CHECK(rigor::is_empty(stays_within(x, Dual(at), Dual(1.0)).value()));
  }
  const rigor::UpwardRounding upward;
  CHECK(rigor::is_empty(asin(rigor::variable<2>(Interval(1.0), 0)).derivative(0)));
  CHECK(rigor::is_empty(acos(rigor::variable<2>(Interval(1.5), 0)).value()));
}

}  // namespace

#include "analysis/theorems/error_bound.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/analysis/theorems/theorem_2_9_oracle.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

theorems::ErrorBoundConstants small_constants() {
  return {.state_bound = Interval(7.0),
          .beta = Interval(2.0),
          .one_minus_alpha = Interval(0.5),
          .zeta = Interval(0.0625),
          .eta = Interval(0.03125),
          .epsilon_z = Interval(0.25),
          .initial_error = Interval(0.125)};
}

}  // namespace

TEST_CASE("the error bound of dyadic constants, by hand") {
  const rigor::UpwardRounding upward;
  const auto bound = theorems::make_error_bound(small_constants());
  REQUIRE(bound.has_value());
  // 2 * 1/32 * (7 - 1/2) / (1/2 - 1/8) = 6.5/16 / 0.375
  const double ultimate = 13.0 / 12.0;
  CHECK(std::fabs(bound->ultimate().lower() - ultimate) < 1e-15);
  CHECK(std::fabs(bound->ultimate().upper() - ultimate) < 1e-15);
  // k = 2: 0.25 * 0.5^2 + 0.25 * (0.5 + 0.125)^2
  const double at_two = 0.0625 + 0.25 * 0.390625 + ultimate;
  CHECK(std::fabs(bound->at(2).lower() - at_two) < 1e-14);
  CHECK(std::fabs(bound->at(2).upper() - at_two) < 1e-14);
  CHECK(std::fabs(bound->at(0).upper() - (0.5 + ultimate)) < 1e-14);
  CHECK(bound->at(100000).upper() <= bound->ultimate().upper() * (1.0 + 1e-15));
  CHECK_THROWS_AS((void)bound->at(-1), std::invalid_argument);
}

TEST_CASE("the error bound of random constants holds the value of 400-bit arithmetic") {
  test::Random random(2910);
  const std::int64_t count = test::effort(3000);
  for (std::int64_t i = 0; i < count; ++i) {
    const double gap = std::pow(10.0, random.uniform(-18.0, 0.0));
    const double beta = 1.0 + std::pow(10.0, random.uniform(-3.0, 3.0));
    const double zeta = gap / beta * random.uniform(0.0, 0.5);
    const double eta = gap / beta * random.uniform(0.0, 0.4);
    const double epsilon_z = random.uniform(0.0, 1.0) / beta;
    const double state_bound = random.uniform(1.0, 10.0);
    const double start = random.uniform(0.0, 1.0);
    const int k = static_cast<int>(random.below(1000));
    const rigor::UpwardRounding upward;
    const auto bound =
        theorems::make_error_bound({Interval(state_bound), Interval(beta), Interval(gap), Interval(zeta),
                                    Interval(eta), Interval(epsilon_z), Interval(start)});
    REQUIRE(bound.has_value());
    using test::Big;
    const Big alpha = Big(1.0) - Big(gap);
    const Big perturbed = alpha + Big(zeta) * Big(beta);
    const Big ultimate =
        Big(beta) * Big(eta) * (Big(state_bound) - Big(beta) * Big(epsilon_z)) / (Big(1.0) - perturbed);
    const Big truth =
        Big(beta) * pow(alpha, k) * Big(start) + Big(beta) * pow(perturbed, k) * Big(start) + ultimate;
    const Interval value = bound->at(k);
    CHECK(truth.lies_in(value.lower(), value.upper()));
    CHECK(ultimate.lies_in(bound->ultimate().lower(), bound->ultimate().upper()));
    CHECK(value.upper() - value.lower() <= 1e-12 * value.upper());
  }
}

TEST_CASE("no error bound where (2.43) is not certain or a constant is out of its range") {
  const auto refused = [](auto change) {
    auto constants = small_constants();
    change(constants);
    return !theorems::make_error_bound(constants).has_value();
  };
  CHECK_FALSE(refused([](auto&) {}));
  CHECK(refused([](auto& c) { c.eta = Interval(0.1875); }));  // beta (zeta + eta) = 1 - alpha exactly
  CHECK(refused([](auto& c) { c.eta = Interval::from_bounds(0.01, 0.2); }));
  CHECK(refused([](auto& c) { c.zeta = Interval(1.0); }));
  CHECK(refused([](auto& c) { c.one_minus_alpha = Interval(0.0); }));
  CHECK(refused([](auto& c) { c.one_minus_alpha = Interval(1.5); }));
  CHECK(refused([](auto& c) { c.beta = Interval(0.5); }));
  CHECK(refused([](auto& c) { c.initial_error = Interval(-0.1); }));
  CHECK(refused([](auto& c) { c.epsilon_z = Interval(10.0); }));  // the last term would be negative
  // (2.43) is true of these, too.
  CHECK(refused([](auto& c) { c.zeta = Interval(-0.0625); }));
  CHECK(refused([](auto& c) { c.eta = Interval(-0.015625); }));
  CHECK(refused([](auto& c) {  // of which the ultimate bound would be positive
    c.beta = Interval(1.0);
    c.one_minus_alpha = Interval(0.25);
    c.zeta = Interval(0.5);
    c.eta = Interval(-0.375);
  }));
  CHECK(refused([](auto& c) { c.epsilon_z = Interval(-0.25); }));
  CHECK(refused([](auto& c) {
    c.one_minus_alpha = Interval(-0.5);
    c.zeta = c.eta = Interval(-1.0);
  }));
  for (const Interval& poison : {Interval(), Interval::entire(),
                                 Interval::from_bounds(1.0, std::numeric_limits<double>::infinity())}) {
    CHECK(refused([&](auto& c) { c.state_bound = poison; }));
    CHECK(refused([&](auto& c) { c.beta = poison; }));
    CHECK(refused([&](auto& c) { c.one_minus_alpha = poison; }));
    CHECK(refused([&](auto& c) { c.zeta = poison; }));
    CHECK(refused([&](auto& c) { c.eta = poison; }));
    CHECK(refused([&](auto& c) { c.epsilon_z = poison; }));
    CHECK(refused([&](auto& c) { c.initial_error = poison; }));
  }
}

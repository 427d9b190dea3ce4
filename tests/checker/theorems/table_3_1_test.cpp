// Table 3.1 for designs that it is not about, and the r at which alpha is stationary.
#include "checker/theorems/table_3_1.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "checker/theorems/theorem_2_9.hpp"

using namespace veritrack::checker;

namespace {

Design table_design(double q1, double q2, double r, double sigma = 0.001) {
  Design design;
  design.q1 = Ball(q1);
  design.q2 = Ball(q2);
  design.r = Ball(r);
  design.epsilon = zero;
  design.state_bound = Ball(7.0);
  design.sigma = Ball(sigma);
  design.gamma_fraction = half;
  design.c1 = design.c2 = Ball(3.0);
  design.q1_equals_q2 = false;
  return design;
}

/// Is this verdict on one of the conditions accepted?
bool accepts(const std::string& id, const std::string& verdict, const Design& design, bool printed) {
  const Tree claimed = read_json(R"({"quantities": {}, "conditions": [{"id": ")" + id + R"(", "verdict": ")" +
                                 verdict + R"("}]})");
  Objections objections;
  check_table_3_1(claimed, design, printed, objections);
  return objections.empty();
}

}  // namespace

TEST_CASE("the table's signs are those of the formulas, for designs with noise and sigma in its range") {
  const std::array<std::string, 5> proved{"alpha-q1", "beta-q1", "alpha-q2", "beta-q2", "beta-r"};
  for (const bool printed : {true, false}) {
    CAPTURE(printed);
    for (const std::string& id : proved) {
      CAPTURE(id);
      CHECK(accepts(id, "proved", table_design(0.01, 0.02, 0.1), printed));
      CHECK_FALSE(accepts(id, "proved", table_design(0.0, 0.02, 0.1), printed));
      CHECK_FALSE(accepts(id, "proved", table_design(0.03, 0.02, 0.1), printed));
      CHECK_FALSE(accepts(id, "proved", table_design(0.01, 0.02, 0.1, -0.001), printed));
      CHECK_FALSE(accepts(id, "proved", table_design(0.01, 0.02, 0.1, 1.5), printed));
    }
  }
}

TEST_CASE("alpha is stationary where it is found, or nothing is") {
  for (const bool printed : {true, false}) {
    CAPTURE(printed);
    const char* verdict = printed ? "refuted" : "proved";
    CHECK(accepts("alpha-r", verdict, table_design(0.01, 0.02, 0.1), printed));
    CHECK(accepts("r_alpha", "proved", table_design(0.01, 0.02, 0.1), printed));
    for (const double size : {1e-45, 1e45}) {
      const Design design = table_design(size, 2.0 * size, size);
      CHECK_FALSE(accepts("alpha-r", verdict, design, printed));
      CHECK_FALSE(accepts("r_alpha", "proved", design, printed));
    }
    CHECK(accepts("r_beta", "proved", table_design(0.01, 0.02, 0.1), printed));
    CHECK_FALSE(accepts("r_beta", "proved", table_design(0.0, 0.02, 0.1), printed));
  }
}

TEST_CASE("the r that is found is where the derivative of s p^2 q changes its sign") {
  const Design design = table_design(0.01, 0.02, 0.1);
  const Constants29 c = constants_2_9(design, Reading::errata);
  const double b1 = 1.0 / (0.1 * c.b_1.near());
  const double b2 = 0.1 * c.b_2.near();
  const double rho = c.rho_1.near();
  const auto measure = [&](double log_r) {
    const double r = std::exp(log_r);
    const double q = 1.0 / 0.01 + b2 / r;
    return std::log(q + rho * rho / 0.01) + 2.0 * std::log(0.02 + r * b1) + std::log(q);
  };
  double low = std::log(1e-9);
  double high = std::log(1e3);
  for (int i = 0; i < 200; ++i) {
    const double third = (high - low) / 3.0;
    (measure(low + third) > measure(high - third) ? low : high) +=
        measure(low + third) > measure(high - third) ? third : -third;
  }
  const double r = std::exp(low);
  const auto accepted_of = [&](const Design& of, double from, double to) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  R"({"quantities": {"r_alpha": {"lo": "%a", "hi": "%a"}}, "conditions": []})", from, to);
    Objections objections;
    check_table_3_1(read_json(text.data()), of, false, objections);
    return objections.empty();
  };
  const auto accepted = [&](double from, double to) { return accepted_of(design, from, to); };
  CHECK(accepted(r * (1.0 - 1e-4), r * (1.0 + 1e-4)));
  // Of all designs between two: it is not only that of the middle one, on neither side.
  Design wide = design;
  wide.q1 = Ball::hull(Ball(0.008), Ball(0.0125));
  CHECK(accepted_of(wide, 0.5 * r, 2.0 * r));
  CHECK_FALSE(accepted_of(wide, 0.5 * r, r));
  CHECK_FALSE(accepted_of(wide, r, 2.0 * r));
  CHECK_FALSE(accepted(r * (1.0 + 1e-4), r * (1.0 + 1e-3)));
}

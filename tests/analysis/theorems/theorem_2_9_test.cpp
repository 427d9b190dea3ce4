#include "analysis/theorems/theorem_2_9.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "analysis/rigor/decimal.hpp"
#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/analysis/theorems/theorem_2_9_golden.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;
using theorems::Theorem29Variant;

constexpr std::array kVariants = {Theorem29Variant::printed, Theorem29Variant::errata};

const theorems::Condition& find_condition(const theorems::Derivation& derivation, const std::string& id) {
  const auto found = std::find_if(derivation.conditions.begin(), derivation.conditions.end(),
                                  [&](const auto& condition) { return condition.id == id; });
  REQUIRE(found != derivation.conditions.end());
  return *found;
}

Verdict verdict_of(const theorems::Theorem29& theorem, const std::string& id) {
  return find_condition(theorem.derivation, id).verdict;
}

/// The design as a design file gives it: every number with the enclosure of its decimal.
theorems::Theorem29Input input_from_decimals(const std::string& q, const std::string& r,
                                             const std::string& epsilon) {
  theorems::Theorem29Input input;
  input.q1 = input.q2 = rigor::parse_decimal(q);
  input.q1_equals_q2 = true;
  input.r = rigor::parse_decimal(r);
  input.epsilon = rigor::parse_decimal(epsilon);
  input.state_bound = rigor::parse_decimal("7");
  input.sigma = rigor::parse_decimal("1e-3");
  input.gamma_fraction = rigor::parse_decimal("0.5");
  input.c1 = input.c2 = rigor::parse_decimal("3");
  return input;
}

}  // namespace

TEST_CASE("the Table 3.2 designs have the constants computed in 150 digits, all with text") {
  const std::array<theorems::Theorem29Input, 4> inputs = {
      input_from_decimals("0.0005", "0.01", "0.05"), input_from_decimals("0.0065", "0.01", "0.05"),
      input_from_decimals("0.0013", "0.01", "0.01"), input_from_decimals("0.0023", "0.05", "0.01")};
  for (const Theorem29Variant variant : kVariants) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto derivation = theorems::evaluate_theorem_2_9(variant, inputs.at(i)).derivation;
      CHECK(derivation.id ==
            (variant == Theorem29Variant::printed ? "theorem-2.9/printed" : "theorem-2.9/errata"));
      REQUIRE(derivation.quantities.size() == test::kGolden.size());
      for (const test::GoldenRow& row : test::kGolden) {
        CAPTURE(row.name);
        const theorems::Quantity& quantity = find_quantity(derivation, row.name);
        const double golden =
            std::stod(variant == Theorem29Variant::printed ? row.printed.at(i) : row.errata.at(i));
        CHECK(std::fabs(quantity.value.lower() - golden) <= 1e-13 * golden);
        CHECK(std::fabs(quantity.value.upper() - golden) <= 1e-13 * golden);
        CHECK_FALSE(quantity.symbol.empty());
        CHECK_FALSE(quantity.formula.empty());
        CHECK_FALSE(quantity.source.empty());
        CHECK(quantity.formula.find('|') == std::string::npos);  // would split a cell of a Markdown table
      }
    }
  }
}

TEST_CASE("(2.43) and (2.44) are refuted for the Table 3.2 designs, and no error bound is given") {
  for (const Theorem29Variant variant : kVariants) {
    for (const test::TableRow& row : test::kTable32) {
      auto input = test::table_design(row).input();
      input.initial_error = Interval(0.01);
      input.largest_state = Interval(3.2);
      input.process_noise = Interval(0.01);
      input.measurement_noise = Interval(0.1);
      const auto theorem = theorems::evaluate_theorem_2_9(variant, input);
      for (const char* id :
           {"sigma", "epsilon_r", "gamma", "epsilon", "2.24", "2.25", "2.26", "2.28", "2.29"}) {
        CAPTURE(id);
        CHECK(verdict_of(theorem, id) == Verdict::proved);
      }
      CHECK(verdict_of(theorem, "2.43") == Verdict::refuted);
      CHECK(verdict_of(theorem, "2.45") == Verdict::refuted);
      CHECK(theorem.derivation.verdict == Verdict::refuted);
      CHECK_FALSE(theorem.error_bound.has_value());
      for (const auto& condition : theorem.derivation.conditions) {
        CHECK_FALSE(condition.reason.empty());
        CHECK(condition.reason.back() == '.');
      }
    }
  }
}

TEST_CASE(
    "the initial error is compared with its bound: proved below, refuted above, undecided without one") {
  const test::TestDesign design = test::table_design(test::kTable32[3]);
  for (const Theorem29Variant variant : kVariants) {
    auto input = design.input();
    CHECK(verdict_of(theorems::evaluate_theorem_2_9(variant, input), "2.45") == Verdict::undecided);
    const Interval bound = theorems::evaluate_theorem_2_9(variant, input).constants.initial_error_bound;
    REQUIRE(bound.lower() > 0.0);
    input.initial_error = Interval(bound.lower() * 0.999);
    CHECK(verdict_of(theorems::evaluate_theorem_2_9(variant, input), "2.45") == Verdict::proved);
    input.initial_error = Interval(bound.upper() * 1.001);
    CHECK(verdict_of(theorems::evaluate_theorem_2_9(variant, input), "2.45") == Verdict::refuted);
    input.initial_error = bound;
    CHECK(verdict_of(theorems::evaluate_theorem_2_9(variant, input), "2.45") == Verdict::undecided);
  }
}

TEST_CASE("what is assumed of the signal is compared with what the theorem assumes") {
  const test::TestDesign design = test::table_design(test::kTable32[3]);
  struct Comparison {
    std::string id;
    std::optional<Interval> theorems::Theorem29Input::*member;
    double bound;
  };
  const std::array<Comparison, 3> comparisons = {
      {{"2.26", &theorems::Theorem29Input::largest_state, 7.0},
       {"2.28", &theorems::Theorem29Input::process_noise, 3.0 * std::sqrt(design.q2)},
       {"2.29", &theorems::Theorem29Input::measurement_noise, 3.0 * std::sqrt(design.r)}}};
  for (const Comparison& comparison : comparisons) {
    CAPTURE(comparison.id);
    const double bound = comparison.bound;
    const auto verdict = [&](const std::optional<Interval>& largest) {
      auto input = design.input();
      input.*comparison.member = largest;
      return verdict_of(theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input), comparison.id);
    };
    CHECK(verdict(std::nullopt) == Verdict::undecided);
    CHECK(verdict(Interval()) == Verdict::undecided);
    CHECK(verdict(Interval(bound * 0.999999)) == Verdict::proved);
    CHECK(verdict(Interval(bound * 1.000001)) == Verdict::refuted);
    CHECK(verdict(Interval::from_bounds(bound * 0.9, bound * 1.1)) == Verdict::undecided);
  }
}

TEST_CASE("(2.43) and (2.44) are proved where they hold, each on its own") {
  const auto evaluate = [](auto change) {
    test::TestDesign design;
    design.q1 = design.q2 = design.r = 1.0;
    design.epsilon = 0.0;
    design.sigma = 1.0 - 0x1p-30;  // epsilon_r = 2^-30
    design.state_bound = 0x1p-29;
    design.c1 = design.c2 = 1e-12;
    change(design);
    auto input = design.input();
    input.initial_error = Interval(1e-30);
    input.process_noise = input.measurement_noise = Interval(0.0);
    return theorems::evaluate_theorem_2_9(Theorem29Variant::errata, input);
  };
  const auto theorem = evaluate([](auto&) {});
  for (const char* id : {"2.43", "2.44", "2.45"}) {
    CAPTURE(id);
    CHECK(verdict_of(theorem, id) == Verdict::proved);
    CHECK_FALSE(find_condition(theorem.derivation, id).reason.empty());
  }
  // But no signal on the unit circle stays within so small an R_x: the theorem is not PROVED, and bounds
  // nothing.
  CHECK(verdict_of(theorem, "2.26") == Verdict::refuted);
  CHECK(theorem.derivation.verdict == Verdict::refuted);
  CHECK_FALSE(theorem.error_bound.has_value());

  // Much noise takes (2.43) away, not (2.44); a gamma_fraction near 0 takes both.
  const auto noisy = evaluate([](auto& design) { design.c2 = 1.0; });
  CHECK(verdict_of(noisy, "2.43") == Verdict::refuted);
  CHECK(verdict_of(noisy, "2.44") == Verdict::proved);
  const auto slow = evaluate([](auto& design) { design.gamma_fraction = 1e-60; });
  CHECK(verdict_of(slow, "2.43") == Verdict::refuted);
  CHECK(verdict_of(slow, "2.44") == Verdict::refuted);
}

TEST_CASE("where every hypothesis holds there is an error bound") {
  // The signal is said to be smaller than the unit circle on which the constants rest: only to see the
  // machinery work.
  test::TestDesign design;
  design.q1 = design.q2 = design.r = 1.0;
  design.epsilon = 0.0;
  design.sigma = 1.0 - 0x1p-30;
  design.state_bound = 0x1p-26;  // above beta epsilon_z, or the last term of the bound is negative
  design.c1 = design.c2 = 1e-12;
  auto input = design.input();
  input.initial_error = Interval(1e-12);
  input.process_noise = input.measurement_noise = Interval(0.0);
  input.largest_state = Interval(0x1p-29);
  const auto theorem = theorems::evaluate_theorem_2_9(Theorem29Variant::errata, input);
  for (const auto& condition : theorem.derivation.conditions) {
    CAPTURE(condition.id);
    CAPTURE(condition.reason);
    CHECK(condition.verdict == Verdict::proved);
  }
  CHECK(theorem.derivation.verdict == Verdict::proved);
  REQUIRE(theorem.error_bound.has_value());
  const rigor::UpwardRounding upward;
  CHECK(certainly_less(theorem.error_bound->ultimate(), theorem.error_bound->at(0)));
  CHECK(certainly_positive(theorem.error_bound->ultimate()));
}

TEST_CASE("a condition of several inequalities shows the one that decided it") {
  test::TestDesign design = test::table_design(test::kTable32[3]);
  auto input = design.input();
  input.measurement_noise = Interval(0.0);
  const auto condition = [&](const char* id) {
    const auto derivation = theorems::evaluate_theorem_2_9(Theorem29Variant::errata, input).derivation;
    const auto found = std::find_if(derivation.conditions.begin(), derivation.conditions.end(),
                                    [&](const auto& one) { return one.id == id; });
    REQUIRE(found != derivation.conditions.end());
    return *found;
  };
  const rigor::UpwardRounding upward;
  // (2.28) by the noise: |w| against c_1 sqrt(q_2), not q_1 against q_2.
  input.process_noise = Interval(7.0);
  CHECK(condition("2.28").verdict == Verdict::refuted);
  CHECK(rigor::identical(condition("2.28").lhs, Interval(7.0)));
  CHECK(rigor::midpoint(condition("2.28").rhs) == doctest::Approx(design.c1 * std::sqrt(design.q2)));
  // (2.29) likewise.
  input.measurement_noise = Interval(9.0);
  CHECK(condition("2.29").verdict == Verdict::refuted);
  CHECK(rigor::identical(condition("2.29").lhs, Interval(9.0)));
  // By the order of q_1 and q_2, and by q_1 = 0.
  input.process_noise = Interval(0.0);
  input.q1_equals_q2 = false;
  input.q1 = Interval(1.0);
  CHECK(condition("2.28").verdict == Verdict::refuted);
  CHECK(rigor::identical(condition("2.28").lhs, Interval(1.0)));
  input.q1 = Interval(0.0);
  CHECK(condition("2.28").verdict == Verdict::refuted);
  CHECK(rigor::identical(condition("2.28").rhs, Interval(0.0)));
}

TEST_CASE("inadmissible parameters refute their condition") {
  const auto evaluate = [](Theorem29Variant variant, auto change) {
    test::TestDesign design;
    design.q1_equals_q2 = false;
    design.q1 = 0.001;
    change(design);
    return theorems::evaluate_theorem_2_9(variant, design.input());
  };
  for (const Theorem29Variant variant : kVariants) {
    const auto check_refuted = [&](const std::string& id, auto change) {
      CAPTURE(id);
      const auto theorem = evaluate(variant, change);
      CHECK(verdict_of(theorem, id) == Verdict::refuted);
      CHECK(theorem.derivation.verdict == Verdict::refuted);
      CHECK_FALSE(theorem.error_bound.has_value());
    };
    check_refuted("sigma", [](auto& d) { d.sigma = 0.0; });
    check_refuted("sigma", [](auto& d) { d.sigma = -0.1; });
    check_refuted("sigma", [](auto& d) { d.sigma = 1.5; });
    check_refuted("epsilon_r", [](auto& d) { d.sigma = 1.5; });
    check_refuted("epsilon_r", [](auto& d) { d.state_bound = 0.1; });
    check_refuted("gamma", [](auto& d) { d.gamma_fraction = 0.0; });
    check_refuted("gamma", [](auto& d) { d.gamma_fraction = 1.0; });
    check_refuted("gamma", [](auto& d) { d.gamma_fraction = 2.0; });
    check_refuted("epsilon", [](auto& d) { d.epsilon = 1.0; });
    check_refuted("epsilon", [](auto& d) { d.epsilon = -0.01; });
    check_refuted("2.24", [](auto& d) { d.q1 = 0.003; });
    check_refuted("2.28", [](auto& d) { d.q1 = 0.003; });
    check_refuted("2.26", [](auto& d) { d.state_bound = 0.99; });
  }
  // The two readings differ in the range of sigma.
  const auto wide = [](auto& d) { d.sigma = 0.8; };
  CHECK(verdict_of(evaluate(Theorem29Variant::printed, wide), "sigma") == Verdict::refuted);
  CHECK(verdict_of(evaluate(Theorem29Variant::errata, wide), "sigma") == Verdict::proved);
}

TEST_CASE("two enclosures with the same ends do not show that q1 <= q2; being the same number does") {
  auto input = input_from_decimals("0.0023", "0.05", "0.01");
  CHECK(verdict_of(theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input), "2.24") ==
        Verdict::proved);
  input.q1_equals_q2 = false;
  CHECK(verdict_of(theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input), "2.24") ==
        Verdict::undecided);
  input.q1_equals_q2 = true;
  input.q1 = Interval(1.0);
  CHECK_THROWS_AS((void)theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input),
                  std::invalid_argument);
}

TEST_CASE("q1 > q2 is evaluated as printed, with a note") {
  test::TestDesign design;
  design.q1 = 0.01;
  design.q1_equals_q2 = false;
  const auto theorem = theorems::evaluate_theorem_2_9(Theorem29Variant::printed, design.input());
  CHECK(is_finite(theorem.constants.lhs_2_43));
  const auto& notes = theorem.derivation.notes;
  CHECK(
      std::any_of(notes.begin(), notes.end(), [](const auto& note) { return note.find("q_1 > q_2") == 0; }));
}

TEST_CASE("q1 = 0: what divides by it is not applicable and decides nothing") {
  const std::set<std::string> divided = {
      "q",        "s",      "gamma", "beta", "one_minus_alpha", "epsilon_z", "delta_k",
      "delta_k2", "zeta_z", "eta",   "zeta", "lhs_2_43",        "lhs_2_44",  "initial_error_bound"};
  for (const Theorem29Variant variant : kVariants) {
    for (const Interval& q1 : {Interval(0.0), Interval::from_bounds(0.0, 1e-300)}) {
      test::TestDesign design;
      design.q1_equals_q2 = false;
      auto input = design.input();
      input.q1 = q1;
      input.initial_error = Interval(0.01);
      const auto theorem = theorems::evaluate_theorem_2_9(variant, input);
      for (const auto& quantity : theorem.derivation.quantities) {
        CAPTURE(quantity.name);
        const bool expected = divided.count(quantity.name) == 1;
        CHECK(quantity.not_applicable.has_value() == expected);
        CHECK(is_finite(quantity.value) != expected);
        if (expected) {
          CHECK(quantity.not_applicable->find("q_1") != std::string::npos);
        }
      }
      for (const char* id : {"2.43", "2.44", "2.45", "gamma"}) {
        CHECK(verdict_of(theorem, id) == Verdict::undecided);
        CHECK(find_condition(theorem.derivation, id).reason.find("a_2 = q_1") != std::string::npos);
      }
      // (2.24) asks for 0 < a_2 = q_1 itself: that is defined, and false at zero.
      const Verdict expected = q1.upper() > 0.0 ? Verdict::undecided : Verdict::refuted;
      CHECK(verdict_of(theorem, "2.24") == expected);
      CHECK(theorem.derivation.verdict == expected);
    }
  }
}

TEST_CASE("empty, infinite and NaN inputs never prove the theorem, nor a condition made of them") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array poisons = {
      Interval(), Interval::entire(), Interval(std::numeric_limits<double>::quiet_NaN()),
      Interval::from_bounds(1e-9, kInfinity), Interval::from_bounds(1e300, kInfinity)};
  const std::array members = {&theorems::Theorem29Input::q1,     &theorems::Theorem29Input::q2,
                              &theorems::Theorem29Input::r,      &theorems::Theorem29Input::state_bound,
                              &theorems::Theorem29Input::sigma,  &theorems::Theorem29Input::gamma_fraction,
                              &theorems::Theorem29Input::c1,     &theorems::Theorem29Input::c2,
                              &theorems::Theorem29Input::epsilon};
  for (const Theorem29Variant variant : kVariants) {
    for (const Interval& poison : poisons) {
      for (const auto member : members) {
        test::TestDesign design;
        auto input = design.input();
        input.q1_equals_q2 = false;
        input.q1 = Interval(0.001);
        input.*member = poison;
        input.initial_error = Interval(1e-30);
        const bool rejected =
            poison.lower() < 0.0 && (member == members[0] || member == members[1] || member == members[2]);
        if (rejected) {
          CHECK_THROWS_AS((void)theorems::evaluate_theorem_2_9(variant, input), std::invalid_argument);
          continue;
        }
        const auto theorem = theorems::evaluate_theorem_2_9(variant, input);
        CHECK(theorem.derivation.verdict != Verdict::proved);
        CHECK_FALSE(theorem.error_bound.has_value());
        if (member != members[8]) {
          CHECK(verdict_of(theorem, "2.43") == Verdict::undecided);
        } else {
          CHECK(verdict_of(theorem, "epsilon") == Verdict::undecided);
        }
      }
      auto input = test::TestDesign().input();
      if (!(poison.lower() >= 1.0)) {
        input.initial_error = poison;
        CHECK(verdict_of(theorems::evaluate_theorem_2_9(variant, input), "2.45") == Verdict::undecided);
      }
    }
  }
}

TEST_CASE("r <= 0, q2 <= 0 and q1 < 0 are refused") {
  for (const double bad : {0.0, -1.0}) {
    auto input = test::TestDesign().input();
    input.q1_equals_q2 = false;
    input.r = Interval(bad);
    CHECK_THROWS_AS((void)theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input),
                    std::invalid_argument);
    input = test::TestDesign().input();
    input.q1_equals_q2 = false;
    input.q2 = Interval(bad);
    CHECK_THROWS_AS((void)theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input),
                    std::invalid_argument);
  }
  auto input = test::TestDesign().input();
  input.q1_equals_q2 = false;
  input.q1 = Interval(-1e-300);
  CHECK_THROWS_AS((void)theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input),
                  std::invalid_argument);
}

TEST_CASE("an unknown quantity is an error") {
  const auto derivation =
      theorems::evaluate_theorem_2_9(Theorem29Variant::printed, test::TestDesign().input()).derivation;
  CHECK_THROWS_AS((void)find_quantity(derivation, "rho_6"), std::out_of_range);
}

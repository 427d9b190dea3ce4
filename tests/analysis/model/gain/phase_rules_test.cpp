// Rules attacked: the true value at random places and errors lies within base, slopes and remainders, whose
// sizes are taken at what the operands' deviations are there.
#include "analysis/model/gain/phase_rules.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/model/gain/frame_value.hpp"
#include "tests/analysis/model/phase_points.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;
using trackers::Instruction;
using trackers::Operation;

/// An operation of one or two operands; `low` to `high` are their bases in the middle of the cell.
struct RuleCase {
  Instruction instruction;
  std::function<double(double x, double z)> truth;
  double low, high, largest_deviation;
};

/// The largest share of its room that is reached.
double attack_rule(const RuleCase& rule, std::uint64_t stream) {
  test::Random random(stream);
  double reached = 0.0;
  std::int64_t bounded = 0;
  // Fewer would not come near the worst case, at whatever effort.
  const std::int64_t trials = std::max<std::int64_t>(800, test::effort(800));
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const double size = rule.largest_deviation * std::pow(10.0, random.uniform(-2.0, 0.0));
    const double width = trial % 2 == 0 ? 0.0 : 0.1 * (rule.high - rule.low);
    const test::PlainValue x = test::random_value(random, rule.low, rule.high, size, width);
    const test::PlainValue z = test::random_value(random, rule.low, rule.high, size, width);
    PhaseStep step = test::step_with_noise();
    PhaseRules rules(test::kPlainErrors, step);
    const PhaseValue result = rules.value_of(rule.instruction, {x.model(), z.model()});
    const test::PhasePoint point = test::random_point(random);
    const test::Miss miss =
        test::miss_of(result, test::sizes_at(step, point), point, rule.truth(x.at(point), z.at(point)));
    if (!(miss.room < 1e6)) {
      continue;  // the rule says nothing
    }
    ++bounded;
    REQUIRE(miss.far <= miss.room * (1.0 + 1e-9) + 1e-13);
    if (width == 0.0 && miss.room > 1e-9) {
      reached = std::max(reached, miss.far / miss.room);
    }
  }
  CHECK(bounded > trials / 4);
  return reached;
}

/// The size of the first remainder of an operation on x, or on x and z, for deviations of these sizes.
double size_for(const Instruction& instruction, const std::vector<double>& bases,
                const std::vector<double>& deviations) {
  PhaseStep step = test::step_with_noise();
  PhaseRules rules(test::kPlainErrors, step);
  std::vector<PhaseValue> registers;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    registers.push_back({BallModel(bases[i]), {}});
    if (deviations[i] != 0.0) {
      registers.back().slopes.emplace(0, BallModel(deviations[i]));
    }
  }
  (void)rules.value_of(instruction, registers);
  return test::sizes_at(step, {0.0, 0.0, {1.0, 0.0}, {0.0}})[1];
}

}  // namespace

TEST_CASE("every rule's remainder holds at random places and errors, and is nearly reached") {
  const rigor::BallModelScope scope(0, 0);
  const auto of = [](Operation operation, int second = -1) {
    return Instruction{operation, 0, second, -1, 0};
  };
  const auto power = [](int exponent) { return Instruction{Operation::power, 0, -1, -1, exponent}; };
  const std::vector<RuleCase> rules{
      {of(Operation::multiply, 1), [](double x, double z) { return x * z; }, -2.0, 2.0, 2.0},
      {of(Operation::multiply, 0), [](double x, double) { return x * x; }, -2.0, 2.0, 2.0},
      {of(Operation::divide, 1), [](double x, double z) { return x / z; }, 0.5, 2.0, 0.6},
      {of(Operation::divide, 1), [](double x, double z) { return x / z; }, -2.0, -0.5, 0.6},
      {power(2), [](double x, double) { return x * x; }, -2.0, 2.0, 2.0},
      {power(3), [](double x, double) { return x * x * x; }, -2.0, 2.0, 1.0},
      {power(5), [](double x, double) { return std::pow(x, 5); }, -1.0, 1.0, 0.5},
      {of(Operation::sin), [](double x, double) { return std::sin(x); }, -4.0, 4.0, 2.0},
      {of(Operation::cos), [](double x, double) { return std::cos(x); }, -4.0, 4.0, 2.0},
      {of(Operation::sin), [](double x, double) { return std::sin(x); }, -4.0, 4.0, 9.0},
      {of(Operation::cos), [](double x, double) { return std::cos(x); }, -4.0, 4.0, 9.0},
      {of(Operation::sqrt), [](double x, double) { return std::sqrt(x); }, 0.5, 2.0, 0.6},
      {of(Operation::exp), [](double x, double) { return std::exp(x); }, -1.0, 1.0, 1.0},
      {of(Operation::log), [](double x, double) { return std::log(x); }, 0.5, 2.0, 0.6},
      {of(Operation::tan), [](double x, double) { return std::tan(x); }, -0.8, 0.8, 0.6},
      {of(Operation::asin), [](double x, double) { return std::asin(x); }, -0.6, 0.6, 0.3},
      {of(Operation::acos), [](double x, double) { return std::acos(x); }, -0.6, 0.6, 0.3},
      {of(Operation::atan), [](double x, double) { return std::atan(x); }, -2.0, 2.0, 2.0},
      {of(Operation::atan2, 1), [](double y, double x) { return std::atan2(y, x); }, 0.3, 1.5, 0.8},
      {of(Operation::atan2, 1), [](double y, double x) { return std::atan2(y, x); }, -1.5, -0.3, 0.8},
      {of(Operation::atan2, 1), [](double y, double x) { return std::atan2(y, x); }, -1.0, 1.0, 0.8},
      {of(Operation::maximum, 1), [](double x, double z) { return std::max(x, z); }, -1.0, 1.0, 1.0},
      {of(Operation::minimum, 1), [](double x, double z) { return std::min(x, z); }, -1.0, 1.0, 1.0},
      {of(Operation::absolute), [](double x, double) { return std::fabs(x); }, -1.0, 1.0, 1.0}};
  for (std::size_t i = 0; i < rules.size(); ++i) {
    CAPTURE(i);
    const Operation operation = rules[i].instruction.operation;
    const bool has_two_kinks = operation == Operation::maximum || operation == Operation::minimum;
    CHECK(attack_rule(rules[i], i) > (has_two_kinks ? 0.6 : 0.9));  // which are seldom reached at once
  }
}

TEST_CASE("a limit that is not reached adds nothing, and one that is, what is beyond it") {
  const rigor::BallModelScope scope(0, 0);
  const Instruction clamped{Operation::clamp, 0, 1, 2, 0};
  const Instruction largest{Operation::maximum, 0, 1, -1, 0};
  CHECK(size_for(clamped, {0.5, -1.0, 1.0}, {0.4, 0.0, 0.0}) == 0.0);
  CHECK(size_for(largest, {0.5, 0.25}, {0.2, 0.0}) == 0.0);
  CHECK(size_for(largest, {0.5, 0.25}, {0.5, 0.0}) == doctest::Approx(0.25));
  CHECK(size_for(largest, {0.5, 0.5}, {0.3, 0.0}) == doctest::Approx(0.15));
}

TEST_CASE("where an operation may not be defined its remainder has no bound") {
  const rigor::BallModelScope scope(0, 0);
  const auto of = [](Operation operation) { return Instruction{operation, 0, -1, -1, 0}; };
  const Instruction quotient{Operation::divide, 1, 0, -1, 0};
  const Instruction angle{Operation::atan2, 0, 1, -1, 0};
  const Instruction limited{Operation::stays_within, 0, 1, 2, 0};
  CHECK(size_for(quotient, {1.0, 2.0}, {0.99, 0.0}) < 1e3);
  CHECK(size_for(quotient, {1.0, 2.0}, {1.0, 0.0}) == INFINITY);
  CHECK(size_for(quotient, {-1.0, 2.0}, {1.5, 0.0}) == INFINITY);
  CHECK(size_for(of(Operation::sqrt), {1.0}, {0.9}) < 1e3);
  CHECK_FALSE(size_for(of(Operation::sqrt), {1.0}, {1.01}) < INFINITY);
  CHECK_FALSE(size_for(of(Operation::log), {1.0}, {1.01}) < INFINITY);
  CHECK_FALSE(size_for(of(Operation::asin), {0.5}, {0.51}) < INFINITY);
  CHECK_FALSE(size_for(of(Operation::acos), {-0.5}, {0.51}) < INFINITY);
  CHECK_FALSE(size_for(of(Operation::tan), {1.5}, {0.1}) < INFINITY);
  // The cut of atan2 (y, x), and its centre.
  CHECK(size_for(angle, {0.5, -1.0}, {0.49, 0.1}) < 1e3);
  CHECK(size_for(angle, {0.5, -1.0}, {0.51, 0.1}) == INFINITY);
  CHECK(size_for(angle, {0.5, 1.0}, {0.6, 0.1}) < 1e3);
  CHECK(size_for(angle, {0.1, 0.5}, {0.4, 0.4}) == INFINITY);
  CHECK(size_for(limited, {0.5, -1.0, 1.0}, {0.49, 0.0, 0.0}) == 0.0);
  CHECK(size_for(limited, {0.5, -1.0, 1.0}, {0.51, 0.0, 0.0}) == INFINITY);
  CHECK(size_for(limited, {-0.5, -1.0, 1.0}, {0.51, 0.0, 0.0}) == INFINITY);
  CHECK(size_for(limited, {1.5, -1.0, 1.0}, {0.0, 0.0, 0.0}) == INFINITY);
  CHECK_THROWS_AS((void)size_for(limited, {0.5, -1.0, 1.0}, {0.1, 0.1, 0.0}), NoFrame);
  const Instruction chosen{Operation::choose, 0, 1, 2, 0};
  CHECK(size_for(chosen, {0.5, -1.0, 1.0}, {0.49, 0.0, 0.0}) == 0.0);
  CHECK(size_for(chosen, {-0.5, -1.0, 1.0}, {0.5, 0.0, 0.0}) == INFINITY);
  CHECK_THROWS_AS((void)size_for(chosen, {0.0, -1.0, 1.0}, {0.1, 0.0, 0.0}), NoFrame);
  CHECK(size_for(of(Operation::sign), {-0.5}, {0.4}) == 0.0);
  CHECK(size_for(of(Operation::sign), {0.5}, {0.6}) == INFINITY);
  const Instruction clamped{Operation::clamp, 0, 1, 2, 0};
  CHECK_THROWS_AS((void)size_for(clamped, {0.5, 1.0, -1.0}, {0.1, 0.0, 0.0}), NoFrame);  // not in order
  CHECK_THROWS_AS((void)size_for(clamped, {0.5, -1.0, 1.0}, {0.1, 0.1, 0.0}), NoFrame);
  // What is not known has no size either.
  CHECK_FALSE(size_for(of(Operation::exp), {0.5}, {NAN}) < INFINITY);
}

}  // namespace veritrack::model

// Rules one after the other: values of formulas at random places and errors lie within base, slopes and
// remainders.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <span>

#include "tests/analysis/model/phase_points.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using trackers::Instruction;
using trackers::Operation;

/// A formula of two operands, from operations at random.
trackers::StraightLineProgram random_formula(test::Random& random) {
  constexpr int kOperations = 8;
  constexpr std::array kOfOne{Operation::negate, Operation::sin,  Operation::cos,  Operation::exp,
                              Operation::atan,   Operation::sqrt, Operation::power};
  constexpr std::array kOfTwo{Operation::add,    Operation::subtract, Operation::multiply,
                              Operation::divide, Operation::divide,   Operation::atan2};
  trackers::StraightLineProgram program(2);
  for (int i = 0; i < kOperations; ++i) {
    const auto any = [&] {
      return static_cast<int>(random.below(static_cast<std::uint64_t>(program.registers())));
    };
    const int first = any();
    const int second = any();
    if (random.below(2) == 0) {
      const Operation operation = kOfOne[random.below(kOfOne.size())];
      program.append({operation, first, -1, -1, operation == Operation::power ? 3 : 0});
    } else {
      program.append(kOfTwo[random.below(kOfTwo.size())], first, second);
    }
  }
  program.add_result(program.registers() - 1);
  return program;
}

}  // namespace

TEST_CASE("formulas of several operations stay within their line and their remainders") {
  const rigor::BallModelScope scope(0, 0);
  test::Random random(100);
  std::int64_t bounded = 0;
  const std::int64_t trials = test::effort(1000);
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const trackers::StraightLineProgram program = random_formula(random);
    const test::PlainValue x = test::random_value(random, 0.5, 2.0, 0.1, 0.05);
    const test::PlainValue z = test::random_value(random, -2.0, 2.0, 0.1, 0.05);
    PhaseStep step = test::step_with_noise();
    PhaseRules rules(test::kPlainErrors, step);
    std::vector<PhaseValue> registers{x.model(), z.model()};
    for (const Instruction& each : program.instructions()) {
      registers.push_back(rules.value_of(each, registers));
    }
    const test::PhasePoint point = test::random_point(random);
    const std::vector<double> inputs{x.at(point), z.at(point)};
    std::vector<double> numbers;
    std::vector<double> results(1);
    program.run(std::span<const double>(inputs), numbers, std::span<double>(results));
    const std::vector<double> sizes = test::sizes_at(step, point);
    for (std::size_t r = 2; r < registers.size(); ++r) {
      const test::Miss miss = test::miss_of(registers[r], sizes, point, numbers[r]);
      if (miss.room < 1e3) {
        ++bounded;
        REQUIRE(miss.far <= miss.room * (1.0 + 1e-9) + 1e-12 * (1.0 + std::fabs(numbers[r])));
      }
    }
  }
  CHECK(bounded > 4 * trials);
}

}  // namespace veritrack::model

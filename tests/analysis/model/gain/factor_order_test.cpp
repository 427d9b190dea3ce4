#include "analysis/model/gain/factor_order.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <span>

namespace veritrack {

namespace {

using trackers::Operation;
using trackers::StraightLineProgram;

std::vector<double> run(const StraightLineProgram& program, const std::vector<double>& inputs,
                        std::vector<double>& registers) {
  std::vector<double> results(program.results().size());
  program.run(std::span<const double>(inputs), registers, std::span<double>(results));
  return results;
}

/// a (y - x) b / c, and a + b.
StraightLineProgram chain() {
  StraightLineProgram program(5);
  const int a = 0, b = 1, c = 2, x = 3, y = 4;
  const int e = program.append(Operation::subtract, y, x);
  const int product = program.append(Operation::multiply, program.append(Operation::multiply, a, e), b);
  program.add_result(program.append(Operation::divide, product, c));
  program.add_result(program.append(Operation::add, a, b));
  return program;
}

}  // namespace

TEST_CASE("the factor that vanishes comes last, and the function is the same") {
  const StraightLineProgram program = chain();
  std::vector<double> registers;
  run(program, {2.0, 3.0, 5.0, 0.7, 0.7000001}, registers);
  const StraightLineProgram ordered = model::with_vanishing_factors_last(program, {registers});
  const trackers::Instruction& last =
      ordered.instructions().at(static_cast<std::size_t>(ordered.results()[0] - ordered.inputs()));
  CHECK(last.operation == Operation::multiply);
  const trackers::Instruction& factor =
      ordered.instructions().at(static_cast<std::size_t>(last.second - ordered.inputs()));
  CHECK(factor.operation == Operation::subtract);
  std::mt19937 random(20261129);
  std::uniform_real_distribution<double> any(0.5, 2.0);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> inputs{any(random), any(random), any(random), any(random), any(random)};
    const auto before = run(program, inputs, registers);
    const auto after = run(ordered, inputs, registers);
    CHECK(after[0] == doctest::Approx(before[0]).epsilon(1e-14));
    CHECK(after[1] == before[1]);
  }
}

TEST_CASE("where no factor vanishes, nothing changes") {
  const StraightLineProgram program = chain();
  std::vector<double> registers;
  run(program, {2.0, 3.0, 5.0, 0.7, -0.7}, registers);
  const StraightLineProgram ordered = model::with_vanishing_factors_last(program, {registers});
  CHECK(ordered.instructions() == program.instructions());
  CHECK(ordered.results() == program.results());
}

}  // namespace veritrack

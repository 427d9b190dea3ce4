// Gates against all paths of random programs.
#include "analysis/model/gain/phase_gates.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

/// All paths by which a register reaches a result, as sets of registers (bits), which begin with itself.
std::vector<std::vector<std::uint64_t>> paths_of(const StraightLineProgram& program) {
  std::vector<std::vector<std::uint64_t>> paths(static_cast<std::size_t>(program.registers()));
  for (int r = program.registers(); r-- > 0;) {
    const std::uint64_t bit = std::uint64_t{1} << r;
    std::vector<std::uint64_t>& mine = paths[static_cast<std::size_t>(r)];
    for (const int result : program.results()) {
      if (result == r) {
        mine.push_back(bit);
      }
    }
    for (int i = 0; i < program.registers() - program.inputs(); ++i) {
      const Instruction& each = program.instructions()[static_cast<std::size_t>(i)];
      for (const int operand : {each.first, each.second, each.third}) {
        if (operand == r) {
          for (const std::uint64_t after : paths[static_cast<std::size_t>(program.inputs() + i)]) {
            mine.push_back(bit | after);
          }
        }
      }
    }
  }
  return paths;
}

/// The last register that is on all of them; -1 where there is no path.
int last_of_all(const std::vector<std::uint64_t>& paths) {
  std::uint64_t common = ~std::uint64_t{0};
  for (const std::uint64_t each : paths) {
    common &= each;
  }
  return paths.empty() ? -1 : 63 - __builtin_clzll(common);
}

StraightLineProgram random_program(test::Random& random) {
  const int inputs = 1 + static_cast<int>(random.below(3));
  StraightLineProgram program(inputs);
  const int operations = static_cast<int>(random.below(12));
  // Of the last registers mostly: then there are values through which much passes.
  const auto any = [&] {
    const auto count = static_cast<std::uint64_t>(program.registers());
    const std::uint64_t back = random.below(random.below(3) == 0 ? count : std::min<std::uint64_t>(count, 3));
    return static_cast<int>(count - 1 - back);
  };
  for (int i = 0; i < operations; ++i) {
    const int first = any();
    const int second = any();
    const int third = any();
    switch (random.below(3)) {
      case 0:
        program.append(Operation::sin, first);
        break;
      case 1:
        program.append(Operation::multiply, first, second);
        break;
      default:
        program.append(Operation::clamp, first, second, third);
    }
  }
  const std::uint64_t results = 1 + random.below(3);
  for (std::uint64_t i = 0; i < results; ++i) {
    program.add_result(any());
  }
  return program;
}

}  // namespace

TEST_CASE("the gate of a register is the last one on all of its paths to the results") {
  test::Random random(401);
  std::int64_t beyond = 0;
  for (std::int64_t trial = 0; trial < test::effort(2000); ++trial) {
    const StraightLineProgram program = random_program(random);
    const auto paths = paths_of(program);
    const std::vector<int> gates = gates_of(program);
    REQUIRE(gates.size() == paths.size());
    for (std::size_t r = 0; r < paths.size(); ++r) {
      CAPTURE(trial);
      REQUIRE(gates[r] == last_of_all(paths[r]));
      beyond += gates[r] > static_cast<int>(r) ? 1 : 0;
    }
  }
  CHECK(beyond > test::effort(2000));
}

TEST_CASE("gates of a step on paper") {
  // e = y sin theta is all that theta's sine and the sample do; both states have it.
  StraightLineProgram step(3);
  const int w = 0, theta = 1, y = 2;
  const int sine = step.append(Operation::sin, theta);
  const int e = step.append(Operation::multiply, y, sine);
  const int next_w = step.append(Operation::add, w, e);
  const int unused = step.append(Operation::cos, w);
  const int next_theta = step.append(Operation::add, theta, e);
  step.add_result(next_w);
  step.add_result(next_theta);
  const std::vector<int> gates = gates_of(step);
  const auto gate = [&](int r) { return gates[static_cast<std::size_t>(r)]; };
  CHECK(gate(sine) == e);
  CHECK(gate(y) == e);
  CHECK(gate(e) == e);
  CHECK(gate(w) == next_w);
  CHECK(gate(theta) == theta);
  CHECK(gate(unused) == -1);
}

}  // namespace veritrack::model

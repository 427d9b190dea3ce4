#include "analysis/model/gain/phase_gates.hpp"

#include <cstddef>

namespace veritrack::model {

using trackers::Instruction;

std::vector<int> gates_of(const trackers::StraightLineProgram& program) {
  const int registers = program.registers();
  const int exit = registers;
  std::vector<std::vector<int>> users(static_cast<std::size_t>(registers));
  for (const int result : program.results()) {
    users[static_cast<std::size_t>(result)].push_back(exit);
  }
  for (int i = 0; i < registers - program.inputs(); ++i) {
    const Instruction& each = program.instructions()[static_cast<std::size_t>(i)];
    for (const int operand : {each.first, each.second, each.third}) {
      if (operand >= 0) {
        users[static_cast<std::size_t>(operand)].push_back(program.inputs() + i);
      }
    }
  }
  // Immediate post-dominators, from the last register on; users come later.
  std::vector<int> next(static_cast<std::size_t>(registers) + 1, -1);
  next[static_cast<std::size_t>(exit)] = exit;
  for (int r = registers - 1; r >= 0; --r) {
    int common = -1;
    for (int user : users[static_cast<std::size_t>(r)]) {
      if (next[static_cast<std::size_t>(user)] < 0) {
        continue;  // does nothing
      }
      while (common >= 0 && common != user) {
        int& earlier = common < user ? common : user;
        earlier = next[static_cast<std::size_t>(earlier)];
      }
      common = user;
    }
    next[static_cast<std::size_t>(r)] = common;
  }
  std::vector<int> gates(static_cast<std::size_t>(registers), -1);
  for (int r = registers - 1; r >= 0; --r) {
    const int after = next[static_cast<std::size_t>(r)];
    gates[static_cast<std::size_t>(r)] = after == exit ? r
                                         : after < 0   ? -1
                                                       : gates[static_cast<std::size_t>(after)];
  }
  return gates;
}

}  // namespace veritrack::model

// The width of a register, and the instructions that use it: chosen when a program runs.
#pragma once

namespace veritrack::trackers {

/// Two, four or eight doubles a register.
enum class InstructionSet { sse2, avx2, avx512 };

/// True when this processor, and its operating system, have it.
[[nodiscard]] inline bool has(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse2:
      return true;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("fma") != 0;
  }
  return false;
}

/// The widest that this processor has.
[[nodiscard]] inline InstructionSet widest_instruction_set() {
  static const InstructionSet widest = has(InstructionSet::avx512) ? InstructionSet::avx512
                                       : has(InstructionSet::avx2) ? InstructionSet::avx2
                                                                   : InstructionSet::sse2;
  return widest;
}

}  // namespace veritrack::trackers

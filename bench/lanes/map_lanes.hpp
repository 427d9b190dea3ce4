// The error map of nine numbers in as many lanes as a register has, over doubles and over intervals: part of
// tracker_bench.cpp, in units for one set of instructions each.
#pragma once

#include <cstddef>

namespace veritrack::bench {

/// The operands of the map: the state, noise and design of tracker_bench.cpp, the same in every lane.
struct MapOperands {
  double state[9];   // NOLINT: plain
  double input[4];   // NOLINT
  double design[4];  // NOLINT
};

/// `count` times, one after the other, independent of each other; returns something of the last result. Those
/// over intervals need the upward mode.
using RunMap = double(const MapOperands& operands, std::size_t count);
RunMap run_doubles_sse2, run_doubles_avx2, run_doubles_avx512;
RunMap run_intervals_sse2, run_intervals_avx2, run_intervals_avx512;

}  // namespace veritrack::bench

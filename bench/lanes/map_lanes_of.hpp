// See map_lanes.hpp. For units with their own set of instructions.
#pragma once

#include "analysis/rigor/interval_lanes.hpp"
#include "bench/lanes/map_lanes.hpp"
#include "trackers/packed_sine_cosine.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::bench {

template <typename Scalar>
auto run_map(const MapOperands& operands, std::size_t count) {
  using namespace trackers;
  RotatingFrameState<Scalar> state;
  for (Eigen::Index i = 0; i < 9; ++i) {
    state(i) = Scalar(operands.state[i]);
  }
  const RotatingFrameInput<Scalar> input{Scalar(operands.input[0]), Scalar(operands.input[1]),
                                         Scalar(operands.input[2]), Scalar(operands.input[3])};
  const ToneModel<Scalar> design{Scalar(operands.design[0]), Scalar(operands.design[1]),
                                 Scalar(operands.design[2]), Scalar(operands.design[3])};
  RotatingFrameState<Scalar> next;
  for (std::size_t k = 0; k < count; ++k) {
    asm volatile("" : : "r"(&state) : "memory");  // as if the operands were others each time
    next = rotating_frame_map(state, input, design);
    asm volatile("" : : "r"(&next) : "memory");
  }
  return next;
}

template <int Lanes>
double run_doubles(const MapOperands& operands, std::size_t count) {
  return run_map<trackers::Packed<double, Lanes>>(operands, count)(0).lane(0);
}

template <int Lanes>
double run_intervals(const MapOperands& operands, std::size_t count) {
  double lower[8];  // NOLINT: plain
  double upper[8];  // NOLINT
  run_map<rigor::IntervalLanes<Lanes>>(operands, count)(0).store(lower, upper);
  return upper[0];
}

}  // namespace veritrack::bench

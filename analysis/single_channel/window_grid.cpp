#include "analysis/single_channel/window_grid.hpp"

#include <cmath>
#include <numbers>

#include "analysis/single_channel/window_grid_lanes.hpp"

namespace veritrack::single_channel::detail {

const GridFunctions& grid_functions_of(trackers::InstructionSet set) {
  static constexpr const GridFunctions& kGridSse2 = kGridFunctions<2>;
  return set == trackers::InstructionSet::avx512 ? kGridAvx512
         : set == trackers::InstructionSet::avx2 ? kGridAvx2
                                                 : kGridSse2;
}

const GridFunctions& grid_functions() {
  return grid_functions_of(trackers::widest_instruction_set());
}

PhaseGrid::PhaseGrid(const WindowRequest& request) : request_(request) {
  constexpr std::array<double, kGridFrequencies> kFrequencies = {0.0, 0.1, 0.5, 0.9, 1.0};
  constexpr int kSamples = kSettling + kLongestWindow;
  sine_.reserve(static_cast<std::size_t>(kSamples) * kGridPoints);
  cosine_.reserve(static_cast<std::size_t>(kSamples) * kGridPoints);
  for (int samples = 1 - kSettling; samples <= kLongestWindow; ++samples) {
    for (const double share : kFrequencies) {
      const double frequency =
          request.lowest_frequency + share * (request.highest_frequency - request.lowest_frequency);
      for (int i = 0; i < kGridPhases; ++i) {
        const double phase = std::numbers::pi * i / kGridPhases + samples * frequency;
        sine_.push_back(std::sin(phase));
        cosine_.push_back(std::cos(phase));
      }
    }
  }
}

}  // namespace veritrack::single_channel::detail

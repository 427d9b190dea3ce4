// The phase detector of a loop, found from the angles of its step (docs/gain-proof.md, section 7).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/linear/detector_loop.hpp"
#include "analysis/model/gain/loop_network.hpp"

namespace veritrack::model {

/// The loop about its detector; or why it has none, or not one.
struct LoopDetector {
  std::optional<linear::DetectorLoop> loop;
  std::string objection;
};

/// `steady`: of the states. Needs the upward rounding mode.
[[nodiscard]] LoopDetector detector_of(const LoopNetwork& network, const std::vector<SteadyValue>& steady);

}  // namespace veritrack::model

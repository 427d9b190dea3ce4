// Inputs beside the points where a comparison of a listing changes its truth.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "certificates/model/tie/evaluation.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

struct BranchPoints {
  std::vector<StepInput> steps;       ///< pairs: between the two, a comparison changes
  std::vector<std::size_t> changing;  ///< its register, for each of the steps
  int comparisons = 0;                ///< of the listing, without those that ask whether a value is a number
};

/// At most `count` inputs, in pairs that differ in one state or sample, by one unit in the last place. All
/// comparisons have their turn; those that are the same for many inputs that `draw` gives are passed over.
[[nodiscard]] BranchPoints steps_beside_branches(const trackers::code::Listing& listing,
                                                 const std::function<StepInput()>& draw, int count);

}  // namespace veritrack::certificates::tie

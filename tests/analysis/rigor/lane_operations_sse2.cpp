// Compiled for any processor.
#include "tests/analysis/rigor/lane_operations_of.hpp"

namespace veritrack::test {

void apply_sse2(const LaneOperands& operands, LaneResult* results) {
  apply_lanes<2>(operands, results);
}

}  // namespace veritrack::test

// Compiled for AVX2.
#include "tests/analysis/rigor/lane_operations_of.hpp"

namespace veritrack::test {

void apply_avx2(const LaneOperands& operands, LaneResult* results) {
  apply_lanes<4>(operands, results);
}

}  // namespace veritrack::test

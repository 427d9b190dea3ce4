// Compiled for AVX-512.
#include "tests/analysis/rigor/lane_operations_of.hpp"

namespace veritrack::test {

void apply_avx512(const LaneOperands& operands, LaneResult* results) {
  apply_lanes<8>(operands, results);
}

}  // namespace veritrack::test

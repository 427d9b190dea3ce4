// Compiled for AVX2.
#include "bench/lanes/map_lanes_of.hpp"

namespace veritrack::bench {

double run_doubles_avx2(const MapOperands& operands, std::size_t count) {
  return run_doubles<4>(operands, count);
}
double run_intervals_avx2(const MapOperands& operands, std::size_t count) {
  return run_intervals<4>(operands, count);
}

}  // namespace veritrack::bench

// Compiled for AVX-512.
#include "bench/lanes/map_lanes_of.hpp"

namespace veritrack::bench {

double run_doubles_avx512(const MapOperands& operands, std::size_t count) {
  return run_doubles<8>(operands, count);
}
double run_intervals_avx512(const MapOperands& operands, std::size_t count) {
  return run_intervals<8>(operands, count);
}

}  // namespace veritrack::bench

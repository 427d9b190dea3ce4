// Compiled for any processor.
#include "bench/lanes/map_lanes_of.hpp"

namespace veritrack::bench {

double run_doubles_sse2(const MapOperands& operands, std::size_t count) {
  return run_doubles<2>(operands, count);
}
double run_intervals_sse2(const MapOperands& operands, std::size_t count) {
  return run_intervals<2>(operands, count);
}

}  // namespace veritrack::bench

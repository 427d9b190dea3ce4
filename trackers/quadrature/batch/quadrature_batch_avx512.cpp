// Compiled for AVX-512.
#include "trackers/quadrature/batch/quadrature_lanes.hpp"

namespace veritrack::trackers::detail {

void run_groups_avx512(double* groups, const BatchSamples& samples, const BatchTargets& targets,
                       std::size_t first, std::size_t last) {
  run_groups<8>(groups, samples, targets, first, last);
}

}  // namespace veritrack::trackers::detail

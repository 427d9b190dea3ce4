// Compiled for SSE2.
#include "trackers/quadrature/batch/quadrature_lanes.hpp"

namespace veritrack::trackers::detail {

void run_groups_sse2(double* groups, const BatchSamples& samples, const BatchTargets& targets,
                     std::size_t first, std::size_t last) {
  run_groups<2>(groups, samples, targets, first, last);
}

}  // namespace veritrack::trackers::detail

// Compiled for SSE2.
#include "trackers/quadrature/batch/quadrature_lanes.hpp"

namespace veritrack::trackers::detail {

void run_groups_sse2(double* groups, const BatchSamples<double>& samples, const BatchTargets<double>& targets,
                     std::size_t first, std::size_t last) {
  run_groups<double, 2>(groups, samples, targets, first, last);
}

void run_groups_sse2(float* groups, const BatchSamples<float>& samples, const BatchTargets<float>& targets,
                     std::size_t first, std::size_t last) {
  run_groups<float, 4>(groups, samples, targets, first, last);
}

}  // namespace veritrack::trackers::detail

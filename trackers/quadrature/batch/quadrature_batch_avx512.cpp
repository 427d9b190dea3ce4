// Compiled for AVX-512.
#include "trackers/quadrature/batch/quadrature_lanes.hpp"

namespace veritrack::trackers::detail {

void run_groups_avx512(double* groups, const BatchSamples<double>& samples,
                       const BatchTargets<double>& targets, std::size_t first, std::size_t last) {
  run_groups<double, 8>(groups, samples, targets, first, last);
}

void run_groups_avx512(float* groups, const BatchSamples<float>& samples, const BatchTargets<float>& targets,
                       std::size_t first, std::size_t last) {
  run_groups<float, 16>(groups, samples, targets, first, last);
}

}  // namespace veritrack::trackers::detail

// The first set of the thesis, and the bins of tones by their definition.
#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "analysis/dft_block/lock_set.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::test {

inline constexpr double kPi = 3.141592653589793;

/// Set 1 of the thesis, in a band.
inline dft_block::LockProblem lock_problem(double low, double high, double noise, double slew) {
  return {rigor::Interval(5e-5),
          rigor::Interval(1e-3),
          rigor::Interval(2.5e-3),
          rigor::Interval(12.5 / 4096.0),
          2,
          rigor::Interval(1.0),
          rigor::Interval::from_bounds(low, high),
          rigor::Interval(noise),
          rigor::Interval(slew)};
}

/// The bins of a tone by (4.9), with complex numbers.
inline std::vector<trackers::DftBin<double>> tone_bins(double amplitude, double phase, double offset,
                                                       int half_width) {
  std::vector<trackers::DftBin<double>> bins;
  for (int m = -half_width; m <= half_width; ++m) {
    const std::complex<double> j(0.0, 1.0);
    const double d = offset - m;
    const std::complex<double> bin =
        amplitude / (4.0 * kPi) * std::exp(j * phase) *
        (std::fabs(d) < 1e-9 ? 2.0 * kPi : (std::exp(2.0 * kPi * j * offset) - 1.0) / (j * d));
    bins.push_back({bin.real(), bin.imag()});
  }
  return bins;
}

}  // namespace veritrack::test

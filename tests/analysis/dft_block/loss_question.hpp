// The question of a block tracker in Gaussian noise that its tests ask, and what they read out of an answer.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/dft_block/lock_loss.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::test {

inline constexpr double kVarianceOfBins = 12.5 / 4096.0;

/// Set 1 of the thesis in a narrow band, and bins of that deviation.
inline dft_block::LossQuestion loss_question(double deviation, double slew, double blocks) {
  using rigor::Interval;
  dft_block::LossQuestion result;
  result.problem = {Interval(5e-5),
                    Interval(1e-3),
                    Interval(2.5e-3),
                    Interval(kVarianceOfBins),
                    2,
                    Interval(1.0),
                    Interval::from_bounds(0.29, 0.31),
                    Interval(0.0),
                    Interval(slew)};
  result.deviation = Interval(deviation);
  result.blocks = Interval(blocks);
  result.amplitude_error = result.phase_error = result.offset_error = Interval(1e-3);
  return result;
}

/// A number of the evidence; not a number when there is none of that name.
inline double number_of(const theorems::Derivation& found, const std::string& name) {
  for (const auto& [key, value] : found.evidence.front().numbers) {
    if (key == name) {
      return value;
    }
  }
  return NAN;
}

/// The bins of a tone of amplitude 1 by (4.9), with complex numbers, in noise.
inline std::vector<trackers::DftBin<double>> noisy_bins(double phase, double offset, double deviation,
                                                        trackers::RandomStream& random) {
  std::vector<trackers::DftBin<double>> bins;
  const std::complex<double> j(0.0, 1.0);
  for (int m = -2; m <= 2; ++m) {
    const std::complex<double> bin = std::exp(j * phase) *
                                     (std::exp(2.0 * std::numbers::pi * j * offset) - 1.0) /
                                     (4.0 * std::numbers::pi * j * (offset - m));
    const double real = bin.real() + deviation * random.normal();
    bins.push_back({real, bin.imag() + deviation * random.normal()});
  }
  return bins;
}

}  // namespace veritrack::test

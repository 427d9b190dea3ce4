// The simulations of chapter 4 of B. F. La Scala's thesis (trackers/dft_block/dft_block_ekf.hpp): a target
// that sends a tone of M Hz passes a receiver in a straight line, in white Gaussian noise, T = 2048 samples a
// second, N = 400 s, M = 300, L = 2.
//
// Range sqrt(1 + (v tau)^2), amplitude 1 by range, both ends 10 dB down (Table 4.1). The phase received at
// time t is 2 pi M tau with tau + range / c = t. How large the Doppler shift is, M v / c, is unpublished.
// White noise makes the bins' real and imaginary parts independent and normal, with the variance
// sigma^2 / (2 T): they are drawn, and the tone's bins are transformed once from its samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trackers/dft_block/dft_block_ekf.hpp"

namespace veritrack::experiments {

inline constexpr int kSonarBlocks = 400;
inline constexpr int kSonarSamples = 2048;  // in a block
inline constexpr int kSonarCentre = 300;    // M
inline constexpr int kSonarHalfWidth = 2;   // L
inline constexpr int kSonarBins = 2 * kSonarHalfWidth + 1;

/// A block of the tone without noise.
struct SonarBlock {
  std::array<trackers::DftBin<double>, kSonarBins> bins{};
  double amplitude = 0.0;  ///< in the middle of the block, signal units
  double phase = 0.0;      ///< at its start, rad
  double offset = 0.0;     ///< mean frequency over the block, bins from M
};

/// The pass whose offset would go from `doppler` to -doppler far away; at its ends it is 0.949 of that, bins.
[[nodiscard]] std::vector<SonarBlock> sonar_pass(double doppler);

/// The first samples of a block, with noise: Figures 4.4, 4.7 and 4.10.
[[nodiscard]] std::vector<double> sonar_samples(double doppler, int block, int samples, double noise_variance,
                                                std::uint64_t seed);

/// Q = diag(q1, q2, q3), R = r / (2 T) I, no leak.
struct SonarDesign {
  double q1, q2, q3, r;
};

/// How the filter starts: from the first block by (4.35) and (4.36), or at the truth. P(1|0) = Q.
enum class SonarStart : std::uint8_t { initialisation, truth };

/// A run: per block the estimates x(k|k).
struct SonarRun {
  std::vector<double> offset;  ///< bins
  std::vector<double> power;   ///< 20 log10 of the amplitude, dB
  double start_error = 0.0;    ///< of the first offset, bins
};
[[nodiscard]] SonarRun sonar_run(const std::vector<SonarBlock>& pass, double noise_variance,
                                 const SonarDesign& design, SonarStart start, std::uint64_t seed);

/// For each of the seeds 1, ..., runs: the sums over the blocks of the squared errors, and whether it tracks.
struct SonarScores {
  std::vector<double> offset;    ///< bins^2
  std::vector<double> power;     ///< dB^2
  std::vector<bool> good_start;  ///< the first offset is within half a bin
  std::vector<bool> tracks;      ///< the last one is
};
[[nodiscard]] SonarScores sonar_scores(const std::vector<SonarBlock>& pass, double noise_variance,
                                       const SonarDesign& design, SonarStart start, int runs);

}  // namespace veritrack::experiments

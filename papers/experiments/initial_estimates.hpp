// How far the initial estimate (4.35) of the block tracker is off: chapter 4 of B. F. La Scala's thesis,
// section 4.5.2 (trackers/dft_block/block_dft.hpp), with T = 2048 and L = 2 as in Table 4.1.
#pragma once

#include "papers/experiments/repeated_runs.hpp"

namespace veritrack::experiments {

struct InitialEstimates {
  Summary error;       ///< of the offset, over the runs, bins
  double bound = 0.0;  ///< Cramer-Rao, of a standard error from the bins of one block, bins
};

/// Errors for a tone of the model (4.9) with a constant offset, |offset| <= 2 bins, in white Gaussian noise;
/// the amplitude squared over the variance of the samples is `decibels` dB. Seeds 1, ..., runs. The phase
/// does not matter: turning all bins changes neither (4.35) nor the law of the noise.
[[nodiscard]] InitialEstimates initial_estimates(double offset, double decibels, int runs);

}  // namespace veritrack::experiments

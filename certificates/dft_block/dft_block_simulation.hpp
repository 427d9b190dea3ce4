// Simulated runs of a design of the block tracker, for its figure. Nothing here is proved.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

struct BlockRun {
  double offset = 0.0;               ///< of the tone at the start, bins
  std::vector<double> offset_error;  ///< of the estimate after each block, bins
};

/// P(k+1|k) of (x1, phase at the start of the block, offset) in exact lock on that tone, after many blocks.
/// Nearest rounding must hold.
[[nodiscard]] Eigen::Matrix3d steady_covariance(const BlockTables& tables, double amplitude, double offset);

/// The ends of runs from a grid of starts, on one tone without noise.
struct StartsOnATone {
  double amplitude = 1.0, offset = 0.0;  ///< of the tone, signal units and bins
  std::vector<double> offset_errors;     ///< at the start, of all starts, bins
  std::vector<double> phase_errors;      ///< likewise, at the middle of the first block, rad
  std::vector<std::vector<double>>
      runs;  ///< of each start, offset error in the first prediction and after each block
};

/// `columns` offset errors between -reach and reach, `rows` phase errors of a whole turn, started with the
/// amplitude of the tone and the covariance of the steady state, run for `blocks` blocks. The tone is that of
/// the false locks where they are proved, otherwise in the middle of the assumed ones. Nearest rounding is
/// opened here.
[[nodiscard]] StartsOnATone simulate_starts(const Certificate& certificate, double reach, int columns,
                                            int rows, int blocks);

/// Tones at both ends and in the middle of the assumed offsets, which move by the assumed slew within them;
/// noise of the assumed length in random directions, or Gaussian; starts with the assumed errors, in the
/// steady state. Nearest rounding is opened here.
[[nodiscard]] std::vector<BlockRun> simulate_blocks(const Certificate& certificate);

}  // namespace veritrack::certificates

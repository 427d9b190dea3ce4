// The design file of the tracker "dft-block-ekf".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificates/design/design.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// [design]: Q = diag(q1, q2, q3), R = r I, the bins M - L ... M + L.
struct BlockDesignTable {
  Number q1;          ///< of x1, signal units
  Number q2;          ///< of the phase, rad^2
  Number q3;          ///< of the offset, bins^2
  Number r;           ///< of the real and of the imaginary part of a bin, signal units^2
  Number half_width;  ///< L
  std::optional<Number>
      block_length;  ///< T, samples: where the noise is that of the samples, or a recording is followed
  std::optional<Number> centre;  ///< M: where a recording is followed
};

/// [assume]
struct BlockAssumptions {
  std::array<Number, 2>
      amplitude;  ///< [lowest, highest], constant, signal units; the same where one is given
  bool one_amplitude = true;
  std::array<Number, 2> offset;            ///< [lowest, highest], bins
  Number noise;                            ///< in all bins of a block together, signal units; a bound
  std::optional<GaussianNoise> gaussian;   ///< of the samples, in place of the bound
  std::optional<Number> blocks;            ///< within which lock is not to be lost, with Gaussian noise
  Number slew;                             ///< of the offset, bins per block
  Number initial_amplitude_error;          ///< of x1, relative to the tone's
  Number initial_phase_error;              ///< at the middle of the first block, rad
  Number initial_offset_error;             ///< bins
  std::vector<Number> initial_covariance;  ///< nine, row by row; none: the steady state
};

/// [require]
struct BlockRequirements {
  std::optional<Number> offset_error_below;                ///< bins, in every block
  std::optional<Number> settles_within;                    ///< blocks
  std::optional<Number> settled_below;                     ///< bins
  std::optional<Number> probability_of_losing_lock_below;  ///< within `blocks`, in Gaussian noise
};

/// [simulate]: the runs of the figure.
struct BlockSimulation {
  std::int64_t blocks = 60;
  std::uint64_t seed = 1;
};

struct BlockTables {
  BlockDesignTable design;
  BlockAssumptions assume;
  BlockRequirements require;
  BlockSimulation simulate;
};

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const BlockTables& block_tables(const Design& design) {
  return tables_of<BlockTables>(design);
}

}  // namespace veritrack::certificates

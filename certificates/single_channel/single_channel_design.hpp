// The design file of the tracker "single-channel-ekf".
#pragma once

#include <array>
#include <optional>

#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// [design] of the single-channel tracker: Q = diag(q1, q1, q2) in one of three readings.
struct SingleChannelDesignTable {
  enum class ProcessNoise { frequency_only, identity, diagonal };
  ProcessNoise process_noise = ProcessNoise::identity;
  std::optional<std::array<Number, 2>> variances;  ///< {q1, q2}, with ProcessNoise::diagonal only
  std::optional<Number> q;                         ///< with the other two, unless lambda is given
  std::optional<Number> r;                         ///< signal units squared, unless lambda is given
  std::optional<Number> lambda;                    ///< r/q: then q = 1 and r = lambda
  Number epsilon;
};

/// The tables of a design file for the tracker "single-channel-ekf".
struct SingleChannelEkfTables {
  SingleChannelDesignTable design;
  Assumptions assume;
  Requirements require;
  SimulationSettings simulate;
};

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const SingleChannelEkfTables& single_channel_tables(const Design& design) {
  return tables_of<SingleChannelEkfTables>(design);
}

}  // namespace veritrack::certificates

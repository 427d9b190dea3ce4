// The design file of the tracker "kkl-observer".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// [design] of the KKL observer.
struct KklDesignTable {
  std::vector<Number> lambda;  ///< filter rates, 1/s: four or more, positive and distinct
  std::optional<Number> ell;   ///< of (9) of the paper; none: the proved one
  /// s, between samples of a program that takes its input to be straight between them; none: continuous time
  std::optional<Number> sampling_interval;
};

/// The disturbance added to the signal: known only by a bound, or a sinusoid of at least that frequency.
struct KklDisturbance {
  std::optional<Number> bound;      ///< signal units
  std::optional<Number> amplitude;  ///< signal units, of the sinusoid
  std::optional<Number> frequency;  ///< rad/s, of the sinusoid
};

/// [assume] of the KKL observer.
struct KklAssumptions {
  std::array<Number, 2> frequency;  ///< [lowest, highest], rad/s
  std::array<Number, 2> amplitude;  ///< [lowest, highest], signal units
  std::optional<KklDisturbance> disturbance;
};

/// [require] of the KKL observer, from the settling time on.
struct KklRequirements {
  std::optional<Number> frequency_error_below;  ///< rad/s
  std::optional<Number> amplitude_error_below;  ///< signal units
  std::optional<Number> settles_within;         ///< s
};

/// The tables of a design file for the tracker "kkl-observer".
struct KklObserverTables {
  KklDesignTable design;
  KklAssumptions assume;
  KklRequirements require;
};

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const KklObserverTables& kkl_observer_tables(const Design& design) {
  return tables_of<KklObserverTables>(design);
}

}  // namespace veritrack::certificates

// The design file of the tracker "vibration-regulator".
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// [plant]: A_1 x(k+1) = B_1 u(k) in samples back, A_1 = 1 + a_1 q^-1 + ..., B_1 = b_0 + b_1 q^-1 + ...
struct PlantTable {
  std::vector<Number> a;  ///< a_1, ..., a_p
  std::vector<Number> b;  ///< b_0, ..., b_{p-1}, output per input; b_0 is not 0
};

/// [design]: the tracker whose frequencies the regulator uses, a design of its own.
struct RegulatorDesignTable {
  Design frequency_tracker;
};

/// [require] of the regulator.
struct RegulatorRequirements {
  std::optional<Number> attenuation_above;  ///< dB, in the long run
  std::optional<Number> attenuated_within;  ///< samples, after which it is always above that
  std::optional<Number> output_below;       ///< for ever, units of the output
  std::optional<Number> input_below;        ///< for ever, units of the input
};

/// [simulate]: the closed loop of the figure.
struct RegulatorSimulation {
  std::int64_t samples = 1000;
  std::uint64_t seed = 1;
};

/// The tables of a design file for the tracker "vibration-regulator".
struct RegulatorTables {
  PlantTable plant;
  RegulatorDesignTable design;
  RegulatorRequirements require;
  RegulatorSimulation simulate;
};

/// The largest order of a plant.
inline constexpr int kMostPlantOrder = 8;

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const RegulatorTables& regulator_tables(const Design& design) {
  return tables_of<RegulatorTables>(design);
}

}  // namespace veritrack::certificates

// How the modes of a loop move with one of its parameters. Not proved.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/tuning.hpp"
#include "certificates/model/changed_loop.hpp"

namespace veritrack::certificates {

struct RootLocus {
  struct Point {
    double value = 0.0;
    Multipliers multipliers;  ///< the largest one first; empty where the loop has no steady state

    [[nodiscard]] bool is_stable() const {
      return !multipliers.empty() && std::abs(multipliers.front()) < 1.0;
    }
  };
  struct Range {
    double from = 0.0, to = 0.0;
  };

  std::string parameter;
  double given = 0.0;         ///< the value of the design
  double frequency = 0.0;     ///< of the signal, rad/sample
  bool is_in_frame = false;   ///< else over the phase: sizes of multipliers only
  bool is_average = false;    ///< what turns with the signal is left out
  std::vector<Point> points;  ///< in order; evenly spaced, or by ratio where all values are above 0
  std::vector<Range> stable;  ///< to six digits
};

/// At the middle of the assumed band. Throws RequestError for a parameter that the model does not have, or a
/// loop of which no modes are found at any of the values.
[[nodiscard]] RootLocus root_locus(const ModelTables& tables, const FreeParameter& over);

}  // namespace veritrack::certificates

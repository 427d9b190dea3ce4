// Which operation of a step is undefined: a denominator that can vanish, a limit that can be left. A
// diagnosis for messages, which proves nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/step/tube_step.hpp"
#include "trackers/model/straight_line_program.hpp"

namespace veritrack::model {

/// The number of the instruction that makes a result or limit of the program unknown although its operands
/// are known, or -1 when all are known. `registers` are those of a run.
template <typename Scalar, typename IsKnown>
[[nodiscard]] int first_unknown(const trackers::StraightLineProgram& program,
                                const std::vector<Scalar>& registers, const IsKnown& is_known) {
  const auto known = [&](int place) { return is_known(registers[static_cast<std::size_t>(place)]); };
  int place = -1;
  for (const std::vector<int>* list : {&program.results(), &program.limits()}) {
    for (const int result : *list) {
      place = place < 0 && !known(result) ? result : place;
    }
  }
  while (place >= program.inputs()) {
    const trackers::Instruction& made =
        program.instructions()[static_cast<std::size_t>(place) - static_cast<std::size_t>(program.inputs())];
    int earlier = -1;
    for (const int operand : {made.third, made.second, made.first}) {
      earlier = operand >= 0 && !known(operand) ? operand : earlier;
    }
    if (earlier < 0) {
      return place - program.inputs();
    }
    place = earlier;
  }
  return -1;
}

/// The operation of a step that may be undefined in a tube.
struct UndefinedOperation {
  int instruction = -1;  ///< of the step
  /// The largest radius that was tried for which bounds at points define every operation; 0: none.
  double defined_radius = 0.0;
};

/// Uses bounds over the ball at some phases of the middle frequency of the tube; empty when they define every
/// operation. `noise`: |v| is at most this, signal units. Not for tubes that bound a covariance.
[[nodiscard]] std::optional<UndefinedOperation> find_undefined(const TrackerModel& model, const Tube& tube,
                                                               double radius, double noise);

}  // namespace veritrack::model

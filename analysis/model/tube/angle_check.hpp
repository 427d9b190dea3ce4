// Whether a recursion knows its angles modulo 2 pi only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::model {

/// The value that is not the same after a whole turn; empty when every one is. Checked by the form of the
/// program: an angle, or a sum of whole multiples of angles, may stand in sin, cos and tan and in the next
/// value of an angle, which must turn as the angle does; nothing else may depend on whole turns, nor may the
/// frequency. `constants` are the values of the constants, among which whole multiples are found.
[[nodiscard]] std::string angle_objection(const trackers::Recursion& recursion,
                                          const std::vector<rigor::Interval>& constants);

/// The first value that is not the same after a whole turn, as angle_objection finds it.
struct TurnObjection {
  int state = -1;  ///< whose next value it is; -1: the frequency
  int place = -1;  ///< the register of the program in which it depends on whole turns for the first time
};
/// Empty when everything is the same. The sizes must fit.
[[nodiscard]] std::optional<TurnObjection> find_turn_objection(const trackers::Recursion& recursion,
                                                               const std::vector<rigor::Interval>& constants);

/// Whether the results of a program (inputs: constants, amplitude, phase) have the period 2 pi in the phase,
/// by the same check.
[[nodiscard]] bool is_periodic(const trackers::StraightLineProgram& signal,
                               const std::vector<rigor::Interval>& constants);

}  // namespace veritrack::model

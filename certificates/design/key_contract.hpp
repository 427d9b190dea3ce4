// What a key of a design file is to the contract that the file is: that under [assume] the tracker does what
// [require] asks. `veritrack diff` finds by it whether a contract asks for less than another one.
#pragma once

#include <span>
#include <string_view>

namespace veritrack::certificates {

/// Which of two values of a key makes the stronger contract: it asks for more, or assumes less.
enum class Stronger {
  unknown,         ///< nobody has said: every change counts as one for the worse
  neither,         ///< it is no part of the contract: what the engineer chooses, or a simulation
  only_equal,      ///< another value is another contract: a unit, a tracker, a recursion
  larger,          ///< a number; left out, it asks for nothing or covers nothing but zero
  smaller,         ///< likewise
  wider,           ///< a range that holds the other one; a number is a range of one
  larger_of_each,  ///< names with numbers, such as the deviations of a start
  as_it_is_used,   ///< names with formulas; `only_equal` for those that other assumptions use, else `neither`
  inner_design     ///< a design in the design, of which each key has its own
};

/// What a number of a key measures, so that numbers in Hz and in rad/sample can be compared.
enum class Measure { plain, frequency, slew, samples };

/// A member of a key whose value is an inline table.
struct MemberContract {
  std::string_view name;
  Stronger stronger = Stronger::unknown;
};

struct KeyContract {
  Stronger stronger = Stronger::unknown;
  Measure measure = Measure::plain;
  /// Of inline tables whose members differ in direction. Two values with different members are different in
  /// kind, and no member that is not listed here has a direction.
  std::span<const MemberContract> members = {};
};

/// The contract of a key, such as "noise" in the table "assume", of the design files for a tracker; `unknown`
/// for what is no key of theirs.
[[nodiscard]] KeyContract contract_of(std::string_view tracker, std::string_view table, std::string_view key);

}  // namespace veritrack::certificates

// The role of a key in the contract of a design file: under [assume] the tracker meets [require]. `veritrack
// diff` uses it to find whether a contract asks for less than another one.
#pragma once

#include <span>
#include <string_view>

namespace veritrack::certificates {

/// The rule that decides which of two values of a key makes the stronger contract: it asks for more, or
/// assumes less.
enum class Stronger {
  unknown,         ///< not declared: every change counts as one for the worse
  neither,         ///< not part of the contract: a choice of the engineer, or a simulation
  only_equal,      ///< another value is another contract: a unit, a tracker, a recursion
  larger,          ///< a number; left out, it asks for nothing or covers nothing but zero
  smaller,         ///< likewise
  wider,           ///< a range that contains the other one; a number is a range of one
  larger_of_each,  ///< names with numbers, such as the deviations of a start
  as_it_is_used,   ///< names with formulas; `only_equal` for those that other assumptions use, else `neither`
  inner_design     ///< a design in the design; each of its keys has its own rule
};

/// The quantity of a key's number, so that numbers in Hz and in rad/sample can be compared.
enum class Measure { plain, frequency, slew, samples };

/// A member of a key whose value is an inline table.
struct MemberContract {
  std::string_view name;
  Stronger stronger = Stronger::unknown;
};

struct KeyContract {
  Stronger stronger = Stronger::unknown;
  Measure measure = Measure::plain;
  /// For inline tables whose members differ in direction. Two values with different members are different in
  /// kind, and a member that is not listed here has no direction.
  std::span<const MemberContract> members = {};
};

/// The contract of a key, such as "noise" in the table "assume", of the design files for a tracker; `unknown`
/// for a key that they do not have.
[[nodiscard]] KeyContract contract_of(std::string_view tracker, std::string_view table, std::string_view key);

}  // namespace veritrack::certificates

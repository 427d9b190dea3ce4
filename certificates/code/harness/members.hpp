// The numbers that a program keeps: members of its object, and variables outside functions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/code/harness/candidates.hpp"
#include "certificates/code/harness/declarations.hpp"

namespace veritrack::certificates::code {

/// A number, as an expression of the harness.
struct Member {
  std::string expression;  ///< pll.config->dt
  std::string name;        ///< dt
  std::string type;
  DeclarationPlace place;
  std::optional<double> value;  ///< a constant that it is initialized with, or that an init function assigns
  int depth = 0;                ///< members on the way
};

/// Numbers in the object, called `object` in the harness, two structures deep; and, where `step` has no
/// object or the file keeps others, the variables of the file.
[[nodiscard]] std::vector<Member> members_of(const Declarations& declarations, const std::string& object,
                                             const std::string& object_type, const std::string& file);

}  // namespace veritrack::certificates::code

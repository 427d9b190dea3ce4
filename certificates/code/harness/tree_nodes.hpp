// What nodes of clang's syntax trees have in common.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "certificates/code/harness/declarations.hpp"

namespace veritrack::certificates::code {

/// The type of a declaration or an expression, without names of typedefs where clang knows better, and
/// without namespaces that have no name; empty: it has none.
[[nodiscard]] std::string type_of_node(const nlohmann::json& node);

/// Where a declaration stands: of a macro, where it is used.
[[nodiscard]] DeclarationPlace place_of_node(const nlohmann::json& node);

}  // namespace veritrack::certificates::code

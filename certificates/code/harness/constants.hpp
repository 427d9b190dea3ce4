// Constant expressions in clang's syntax trees.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace veritrack::certificates::code {

/// The value of an expression of literals, in double precision; none for others.
[[nodiscard]] std::optional<double> constant_value(const nlohmann::json& expression);

}  // namespace veritrack::certificates::code

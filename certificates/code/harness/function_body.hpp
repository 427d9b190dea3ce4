// What the body of a function does with its parameters, its object, and variables outside.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "certificates/code/harness/declarations.hpp"

namespace veritrack::certificates::code {

/// Adds what the statements in `body` write, call and use to `function`.
void read_body(const nlohmann::json& body, Function& function);

}  // namespace veritrack::certificates::code

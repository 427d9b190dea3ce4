// The section of a document on the code that its recursion is made of.
#pragma once

#include <string>

#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// "## The code": files, compiler, states and the listing; empty for a recursion that is written down.
/// `is_rounded`: statements are about the program's arithmetic; otherwise `no_rounding` says why not.
[[nodiscard]] std::string model_code_section(const ModelTables& tables, bool is_rounded,
                                             const std::string& no_rounding);

}  // namespace veritrack::certificates

// [code]: the recursion of a model is that of functions in C or C++.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "certificates/code/compilation.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

[[nodiscard]] BoundTable code_keys(code::CodeTable& target);

/// Where there is [code], compiles it and fills the recursion in; otherwise the objection to a key that is
/// missing. Throws InputError, at a place of the design or of a source file.
[[nodiscard]] std::optional<TableObjection> complete_from_code(ModelTable& model,
                                                               const std::filesystem::path& design_file);

}  // namespace veritrack::certificates

// What a harness is written around: the likeliest functions and numbers of a file.
#pragma once

#include <string>
#include <vector>

#include "certificates/code/harness/declarations.hpp"
#include "certificates/code/harness/harness.hpp"

namespace veritrack::certificates::code {

/// Chooses the step, or takes the one called `function`, and what belongs to it. `file` is the file as clang
/// names it, `text` what it holds. Throws InputError, at a place of the file, that says why no function is a
/// step.
[[nodiscard]] HarnessPlan harness_plan(const Declarations& declarations, const std::string& file,
                                       const std::string& text, const std::string& function);

/// The headers that declare all that the harness uses; empty when they do not, so that it has to include the
/// file itself.
[[nodiscard]] std::vector<std::string> headers_that_declare(const HarnessPlan& plan,
                                                            const Declarations& declarations,
                                                            const std::string& file);

}  // namespace veritrack::certificates::code

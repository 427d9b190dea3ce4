// The languages in which the step of a tracker can be shown.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates {

/// The language. `formulas` is that of the design file; the last two are C in one format of numbers, which
/// computes what a certificate in this arithmetic is about.
enum class CodeLanguage { formulas, c, python, octave, single_precision_c, double_precision_c };

/// The names by which a user asks for them: "formulas", "c", "python", "octave".
[[nodiscard]] const std::vector<std::string>& code_language_names();
/// Empty for another name.
[[nodiscard]] std::optional<CodeLanguage> code_language(std::string_view name);

}  // namespace veritrack::certificates

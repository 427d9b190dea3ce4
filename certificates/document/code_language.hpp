// The languages in which the step of a tracker can be shown.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates {

/// The language. `formulas` is that of the design file.
enum class CodeLanguage { formulas, c, python, octave };

/// The names by which a user asks for them: "formulas", "c", "python", "octave".
[[nodiscard]] const std::vector<std::string>& code_language_names();
/// Empty for another name.
[[nodiscard]] std::optional<CodeLanguage> code_language(std::string_view name);

}  // namespace veritrack::certificates

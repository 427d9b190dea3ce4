#include "certificates/document/code_language.hpp"

#include <algorithm>
#include <cstddef>

namespace veritrack::certificates {

const std::vector<std::string>& code_language_names() {
  static const std::vector<std::string> names{"formulas", "c", "python", "octave"};
  return names;
}

std::optional<CodeLanguage> code_language(std::string_view name) {
  const std::vector<std::string>& names = code_language_names();
  const auto found = std::find(names.begin(), names.end(), name);
  return found != names.end() ? std::optional(static_cast<CodeLanguage>(found - names.begin()))
                              : std::nullopt;
}

}  // namespace veritrack::certificates

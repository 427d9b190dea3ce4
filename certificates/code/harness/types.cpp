#include "certificates/code/harness/types.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace veritrack::certificates::code {

namespace {

std::string trimmed_type(std::string text) {
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

}  // namespace

std::string bare_type(std::string type) {
  constexpr std::array<std::string_view, 6> kWords{"const ", "volatile ", "struct ",
                                                   "class ", "union ",    "enum "};
  bool has_changed = true;
  while (has_changed) {
    has_changed = false;
    type = trimmed_type(type);
    for (const std::string_view word : kWords) {
      if (type.starts_with(word)) {
        type.erase(0, word.size());
        has_changed = true;
      }
    }
    for (const std::string_view end :
         {"*", "&", " const", "*const", "*restrict", "*volatile", "__restrict"}) {
      if (type.ends_with(end) && type.size() > end.size()) {
        type.erase(type.size() - end.size());
        has_changed = true;
      }
    }
  }
  return type;
}

bool is_pointer(const std::string& type) {
  // Not a pointer to a pointer or a function, nor an array.
  return std::count(type.begin(), type.end(), '*') == 1 && type.find_first_of("([&") == std::string::npos;
}

bool is_reference(const std::string& type) {
  return type.ends_with("&") && !type.ends_with("&&") && type.find_first_of("(*[") == std::string::npos;
}

bool is_writable(const std::string& type) {
  return (is_pointer(type) || is_reference(type)) && type.find("const ") != 0 &&
         type.find(" const *") == std::string::npos && type.find(" const &") == std::string::npos;
}

bool is_number_type(const std::string& type) {
  const std::string bare = type.find_first_of("*&[(") == std::string::npos ? bare_type(type) : std::string();
  return bare == "float" || bare == "double";
}

}  // namespace veritrack::certificates::code

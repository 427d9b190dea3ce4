// Types of C and C++, as clang spells them.
#pragma once

#include <string>

namespace veritrack::certificates::code {

/// A type without const, volatile, struct, class, enum, and what points or refers to it.
[[nodiscard]] std::string bare_type(std::string type);
[[nodiscard]] bool is_number_type(const std::string& type);
/// A pointer or a reference through which may be written.
[[nodiscard]] bool is_writable(const std::string& type);
[[nodiscard]] bool is_pointer(const std::string& type);
[[nodiscard]] bool is_reference(const std::string& type);

}  // namespace veritrack::certificates::code

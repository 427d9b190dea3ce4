// Certified sets as certificates write them, and what is said of those that are refused: for tests.
#pragma once

#include <array>
#include <string>

namespace veritrack::checker::set_test {

/// A matrix of hexadecimal numbers.
using Rows = std::array<std::array<std::string, 3>, 3>;

inline std::string json_of(const Rows& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += (text.empty() ? "[\"" : ",[\"") + row[0] + "\",\"" + row[1] + "\",\"" + row[2] + "\"]";
  }
  return "[" + text + "]";
}

inline bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace veritrack::checker::set_test

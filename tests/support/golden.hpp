// Golden files: a document as it was when it was last reviewed and accepted.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace veritrack::test {

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE_MESSAGE(file.good(), "cannot read " << path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Compares `text` with the golden file. VERITRACK_UPDATE_GOLDEN=1 writes it instead: review the difference
/// before committing it.
inline void check_golden(const std::string& text, const std::string& path) {
  if (std::getenv("VERITRACK_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  const std::string expected = read_file(path);
  if (text == expected) {
    return;
  }
  std::size_t at = 0;
  while (at < text.size() && at < expected.size() && text[at] == expected[at]) {
    ++at;
  }
  const std::size_t line_start = at == 0 ? 0 : expected.rfind('\n', at - 1) + 1;
  FAIL("differs from " << path << " at byte " << at << "\nexpected: " << expected.substr(line_start, 200)
                       << "\nfound:    " << text.substr(line_start, 200));
}

}  // namespace veritrack::test

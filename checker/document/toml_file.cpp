#include "checker/document/toml_file.hpp"

#include <cctype>
#include <sstream>

namespace veritrack::checker {

TomlFile::TomlFile(const std::string& text) : table_(toml::parse(text)) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines_.push_back(line);
  }
}

// Columns count characters, as UTF-8 writes them.
std::string TomlFile::literal(const toml::node& number) const {
  const toml::source_position begin = number.source().begin;
  if (begin.line < 1 || begin.line > lines_.size()) {
    return "";
  }
  const std::string& line = lines_[begin.line - 1];
  std::size_t at = 0;
  for (toml::source_index column = 1; column < begin.column && at < line.size(); ++column) {
    do {
      ++at;
    } while (at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80U);
  }
  std::size_t end = at;
  while (end < line.size() && (std::isalnum(static_cast<unsigned char>(line[end])) != 0 || line[end] == '.' ||
                               line[end] == '+' || line[end] == '-' || line[end] == '_')) {
    ++end;
  }
  return line.substr(at, end - at);
}

std::string TomlFile::text(const toml::node& value) const {
  if (value.is_number()) {
    return literal(value);
  }
  return value.is_string() ? value.as_string()->get() : "";
}

}  // namespace veritrack::checker

// A TOML file with its numbers as they are written.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace veritrack::checker {

class TomlFile {
 public:
  /// Throws toml::parse_error.
  explicit TomlFile(const std::string& text);

  [[nodiscard]] const toml::table& table() const { return table_; }
  /// A number as it is written: toml++ reports only its place.
  [[nodiscard]] std::string literal(const toml::node& number) const;
  /// A string, or a number as it is written; empty for anything else.
  [[nodiscard]] std::string text(const toml::node& value) const;

 private:
  toml::table table_;
  std::vector<std::string> lines_;
};

}  // namespace veritrack::checker

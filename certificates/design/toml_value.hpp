// One value of a TOML file: read with its position, and refused with a message that states what is allowed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "certificates/design/design.hpp"
#include "certificates/design/toml_source.hpp"

namespace veritrack::certificates {

/// A predicate on the number in an interval: true only when certain. Called with the rounding mode held.
using RealPredicate = bool (*)(const rigor::Interval&);

/// A value and the allowed values. Refers to the source: must not outlive it.
class TomlValue {
 public:
  /// `path` as in "design.q1"; `allowed` completes "allowed: ...".
  TomlValue(const TomlSource& source, const toml::node& node, std::string path, std::string_view allowed)
      : source_(&source), node_(&node), path_(std::move(path)), allowed_(allowed) {}

  /// The number, when `is_allowed` holds for its interval. Integers are numbers; hexadecimal, octal and
  /// binary integers, inf and nan are not. Throws InputError otherwise. Needs the upward rounding mode.
  [[nodiscard]] Number real(RealPredicate is_allowed) const;
  /// As real, for decimal integers only.
  [[nodiscard]] Number whole_number(RealPredicate is_allowed) const;
  /// A decimal integer in [lowest, highest]. Throws InputError otherwise.
  [[nodiscard]] std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  /// One line of text of 1 to `limit` bytes. Throws InputError otherwise.
  [[nodiscard]] std::string line_of_text(std::size_t limit) const;
  /// A string of at most `limit` bytes that may have many lines, or a number as it is written. Escapes are
  /// not allowed, so that every character has its place in the file. Throws InputError otherwise.
  [[nodiscard]] SourceText source_text(std::size_t limit) const;
  /// The keys of a table and their values, in the order of the file. Throws InputError when it is not a
  /// table.
  [[nodiscard]] std::vector<std::pair<SourceText, TomlValue>> members() const;
  [[nodiscard]] bool is_string() const noexcept { return node_->is_string(); }
  [[nodiscard]] bool is_table() const noexcept { return node_->is_table(); }
  [[nodiscard]] bool is_array() const noexcept { return node_->is_array(); }
  [[nodiscard]] bool is_number() const noexcept { return node_->is_number(); }
  /// The values of a table that has exactly these keys, in the order of `names`. Throws InputError otherwise.
  [[nodiscard]] std::vector<TomlValue> entries(std::span<const std::string_view> names) const;
  /// The elements of an array of exactly `count`. Throws InputError otherwise.
  [[nodiscard]] std::vector<TomlValue> elements(std::size_t count) const;
  /// The elements of an array of `fewest` to `most`. Throws InputError otherwise.
  [[nodiscard]] std::vector<TomlValue> elements(std::size_t fewest, std::size_t most) const;
  /// The values of an inline table that has exactly these keys, in their order; empty when it has others.
  /// Throws InputError when it is not a table.
  [[nodiscard]] std::optional<std::vector<TomlValue>> fields(const std::vector<std::string_view>& keys) const;

  /// The value of `table`.`key` in the same file; empty when the file does not have it.
  [[nodiscard]] std::optional<TomlValue> elsewhere(std::string_view table, std::string_view key,
                                                   std::string_view allowed) const;

  /// The table as if it were a file. Throws InputError when it is not a table.
  [[nodiscard]] TomlSource as_file() const;

  [[nodiscard]] Position position() const;
  /// `path` is `found`; allowed: ... Throws InputError.
  [[noreturn]] void refuse(std::string_view found) const;
  /// Refuses the value by its kind.
  [[noreturn]] void refuse_kind() const;

 private:
  /// The text in the file, for numbers only: the characters of the value.
  [[nodiscard]] std::string_view number_text() const;

  const TomlSource* source_;
  const toml::node* node_;
  std::string path_;
  std::string_view allowed_;
};

}  // namespace veritrack::certificates

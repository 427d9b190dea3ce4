// The format of a design file: its keys, each declared once with its name, its allowed values, its reader and
// its default; and the tables that a tracker has.
#pragma once

#include <any>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/design.hpp"
#include "certificates/design/key_contract.hpp"
#include "certificates/design/toml_value.hpp"

namespace veritrack::certificates {

/// The assumption when a key is left out.
struct Absence {
  enum class Rule { is_an_error, is_nothing, is_default };
  Rule rule = Rule::is_an_error;
  std::string_view default_toml;  ///< for is_default: the value, as TOML
};

/// A key of the table that fills a Target.
template <typename Target>
struct Key {
  std::string_view name;
  std::string_view allowed;  ///< completes "allowed: ..."
  /// Checks the value and stores it. Throws InputError. Needs the upward rounding mode.
  void (*read)(const TomlValue& value, Target& target);
  Absence absence;
  KeyContract contract = {};
};

/// A key together with the place that it fills.
struct BoundKey {
  std::string_view name;
  std::string_view allowed;
  std::function<void(const TomlValue&)> read;
  Absence absence;
  KeyContract contract = {};
};

/// A table of the file, e.g. [design], and the place that it fills.
struct BoundTable {
  std::string_view name;
  std::vector<BoundKey> keys;
};

/// The table of that name with these keys, filling `target`, which must outlive it.
template <typename Target, typename Keys>
[[nodiscard]] BoundTable bound_table(std::string_view name, const Keys& keys, Target& target) {
  BoundTable table{name, {}};
  for (const Key<Target>& key : std::span<const Key<Target>>(keys)) {
    table.keys.push_back({key.name, key.allowed,
                          [read = key.read, &target](const TomlValue& value) { read(value, target); },
                          key.absence, key.contract});
  }
  return table;
}

/// A fault that concerns several keys.
struct TableObjection {
  std::string_view table;              ///< where the message points
  std::string message;                 ///< what is wrong, what is allowed
  std::optional<Position> position{};  ///< where, when not at the beginning of the table
};

namespace code {
struct CodeWriter;
}

/// The tables of a tracker's design file.
struct DesignFormat {
  std::string_view tracker;    ///< as the key `tracker` names it
  std::any (*empty_tables)();  ///< what Design::tables then holds
  /// The tables in the order of a design file, filling what empty_tables made.
  std::vector<BoundTable> (*bind_tables)(std::any& tables);
  /// Whether the keys go together, once all are read; null when they always do.
  std::optional<TableObjection> (*objection)(const std::any& tables) = nullptr;
  /// Fills in what other files say, named from the folder of the design, before `objection`; null when none
  /// does. Throws InputError.
  std::optional<TableObjection> (*complete)(std::any& tables,
                                            const std::filesystem::path& design_file) = nullptr;
  /// Writes designs for files of code (certificates/code/harness/new_code.hpp); null when it has no [code].
  const code::CodeWriter* code_writer = nullptr;
};

/// The text to add to a list of all trackers that this build knows: how to get the others, if there are any.
[[nodiscard]] std::string_view others_are_left_out();

/// The formats of all trackers (certificates/trackers.def).
[[nodiscard]] std::span<const DesignFormat* const> design_formats();

}  // namespace veritrack::certificates

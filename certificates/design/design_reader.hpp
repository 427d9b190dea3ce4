// Reading design files: TOML text to a Design, or an InputError that states the fault, its place, and what is
// allowed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "certificates/design/design.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/toml_value.hpp"

namespace veritrack::certificates {

/// Reads a design from TOML text of at most 1 MiB; `file_name` is for messages. Every number keeps the
/// tightest interval that contains the decimal written and the double nearest to it, and every limit on a
/// number is met by that whole interval. Keys that the file leaves out have their defaults, with position
/// {0, 0}. Throws InputError. Holds its own rounding mode.
[[nodiscard]] Design read_design(std::string_view text, std::string_view file_name);

/// A design inside another one's file: a table with `tracker` and the tables of that tracker. It has no name
/// and no source. Throws InputError. Needs the upward rounding mode.
[[nodiscard]] Design read_inner_design(const TomlValue& table);

/// The text of a design file. Throws InputError when it is missing, not a regular file, unreadable, or larger
/// than 1 MiB (which is checked before reading).
[[nodiscard]] std::string read_design_text(const std::filesystem::path& path);

/// read_design of read_design_text.
[[nodiscard]] Design read_design_file(const std::filesystem::path& path);

}  // namespace veritrack::certificates

// Where the results of a design go when nobody says: a folder named after the design file.
#pragma once

#include <filesystem>

namespace veritrack::cli {

/// `parent`/<name of the design file>. Throws certificates::OutputError when that folder holds the results of
/// another design file of the same name, which still exists: they are not overwritten.
[[nodiscard]] std::filesystem::path default_folder(const std::filesystem::path& parent,
                                                   const std::filesystem::path& design);

/// Notes in the folder which design file its contents are of, as a path from the folder. Throws
/// certificates::OutputError.
void mark_folder(const std::filesystem::path& folder, const std::filesystem::path& design);

}  // namespace veritrack::cli

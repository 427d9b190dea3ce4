// The hidden files beside an output while it is written, and those that a killed process leaves.
#pragma once

#include <filesystem>

namespace veritrack::certificates {

/// The pattern, for mkostemp(3), of the file in which the content of `target` is gathered.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target);

/// The name under which the previous file at the target is kept until all outputs have their names.
[[nodiscard]] std::filesystem::path name_of_previous(const std::filesystem::path& temporary);

/// Removes the hidden files beside `target` on which no process works any more. A process holds a lock,
/// flock(2), on each of its own, which ends with it; where the file system has no locks, nothing is removed.
void remove_abandoned_files(const std::filesystem::path& target);

}  // namespace veritrack::certificates

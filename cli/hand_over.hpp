// Commands that another program carries out, as git runs git-x: its words are handed over unread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"

namespace veritrack::cli {

/// The other words, when the first that is not --quiet is the command; nothing otherwise.
[[nodiscard]] std::optional<std::vector<std::string>> words_after(const std::string& command, int argc,
                                                                  char** argv);

/// veritrack reproduce: by veritrack-reproduce beside this program. Returns only if it cannot be run, which
/// is said.
[[nodiscard]] ExitStatus run_reproduce(const std::vector<std::string>& words);
/// veritrack sweep: many designs, by the package for Python. Likewise.
[[nodiscard]] ExitStatus run_sweep(const std::vector<std::string>& words);

}  // namespace veritrack::cli

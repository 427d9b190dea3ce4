// Shell completions and manual pages, generated from the commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::cli {

/// The shells that completions are written for.
[[nodiscard]] std::vector<std::string> shell_names();

/// The script that completes the program's commands, options and choices in that shell, one of shell_names().
[[nodiscard]] std::string completions(const CLI::App& app, std::string_view shell);

/// The manual page of the program, for man.
[[nodiscard]] std::string manual_page(const CLI::App& app);

}  // namespace veritrack::cli

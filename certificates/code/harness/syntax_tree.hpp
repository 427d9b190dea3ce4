// The declarations of a file of C or C++, as clang's JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates::code {

/// The declarations at the top of a syntax tree that clang has dumped as JSON, without those of the system's
/// headers. Each place in it has its `file` and its `line`, which clang leaves out where they repeat. Throws
/// std::invalid_argument for a text that is no such tree.
[[nodiscard]] std::vector<nlohmann::json> own_declarations_in(std::string_view dump,
                                                              const std::filesystem::path& source);

/// Those of a file, which clang reads with these arguments. Throws InputError, at a place of the file.
[[nodiscard]] std::vector<nlohmann::json> own_declarations(const std::filesystem::path& source,
                                                           const std::vector<std::string>& arguments);

}  // namespace veritrack::certificates::code

// The files of the code that a certificate is about.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// The files of the member "code" of a design: those that the design file names, and those that they include.
std::vector<const Tree*> code_files(const Tree& code);

/// Objects unless each file that the design's member "code" names is there, named from the folder of the
/// design file, and has the SHA-256 that stands behind its name. Nothing for a design without code.
void compare_code_files(const Tree& design, const std::filesystem::path& folder, Objections& objections);

/// Whether the member of a design with code, "model.step", is what its functions say in place of the design
/// file, or what the compiler made of them.
bool is_from_code(const std::string& path);

}  // namespace veritrack::checker

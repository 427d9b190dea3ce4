// The design file beside a certificate: are they about the same design?
#pragma once

#include <filesystem>
#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// Objects unless the file has the SHA-256 that the certificate names, every value of the certificate's
/// design is the one in the file, decimal by decimal, or the default of a key that the file leaves out, and
/// every value of the file is in the certificate. [simulate] is left aside: nothing that is verified rests on
/// it. Throws Malformed for what is not TOML.
/// `folder`: that of the file, where the files of its code are.
void compare_with_design_file(const Tree& certificate, const std::string& file, Objections& objections,
                              const std::filesystem::path& folder = ".");

}  // namespace veritrack::checker

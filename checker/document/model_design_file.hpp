// The design file of a tracker that is written down as a recursion: its formulas, as texts, and what may be
// written in more than one way.
#pragma once

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"
#include "checker/document/toml_file.hpp"

namespace veritrack::checker {

/// Objects unless the file says what the certificate's design says, text by text: all that is verified rests
/// on. Units of states and where simulations start are left aside.
/// `part`: the table of the file that is the design.
void compare_model_design(const Tree& design, const TomlFile& file, const toml::table& part,
                          Objections& objections);

}  // namespace veritrack::checker

// The design file of a tracker that is given as a recursion: its formulas, as texts, and the values that may
// be written in more than one way.
#pragma once

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"
#include "checker/document/toml_file.hpp"

namespace veritrack::checker {

/// Objects unless the file agrees with the certificate's design, text by text, in everything that the
/// verification rests on. Units of states and starts of simulations are left aside. `part`: the table of the
/// file that is the design.
void compare_model_design(const Tree& design, const TomlFile& file, const toml::table& part,
                          Objections& objections);

}  // namespace veritrack::checker

// The code of a design: its files, and the listing that the recursion is compared with.
#pragma once

#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// Objects unless the recursion in the member "model" of the design is that of the listing in its member
/// "code". Throws Malformed or FormulaError.
void check_code(const Tree& design, Objections& objections);

/// " of the listing of `step` and `frequency` in pll.c (SHA-256 0123456789abcdef...), angles modulo 2 pi":
/// what a sentence about exact arithmetic is about; empty for a design without code.
std::string words_of_code(const Tree& design);

}  // namespace veritrack::checker

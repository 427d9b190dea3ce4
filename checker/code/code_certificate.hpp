// The code of a design: its files, and the listing that the recursion is compared with.
#pragma once

#include <optional>
#include <string>

#include "checker/code/listing.hpp"
#include "checker/code/listing_rounding.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// A listing that was compared with the recursion.
struct CheckedCode {
  CodeListing listing;
  std::optional<ListedAngles> angles;  ///< what bounds on rounding rest on; nothing where there are none
  Ball turned;  ///< the angle of the samples as the program has it is off by this much, rad
};

/// Objects unless the recursion in the member "model" of the design is that of the listing in its member
/// "code". Throws Malformed or FormulaError.
CheckedCode check_code(const Tree& design, Objections& objections);

/// The arithmetic that a sentence is about: "In exact arithmetic", of a design with code " of the listing of
/// `step` and `frequency` in pll.c (SHA-256 0123456789abcdef...), angles modulo 2 pi, begun
/// in the ranges that the wraps keep them in"; or that of the
/// program, rounded.
std::string words_of_arithmetic(const Tree& design, bool is_rounded);

}  // namespace veritrack::checker

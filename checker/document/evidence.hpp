// Numbers as the evidence of a certificate writes them: exactly, as hexadecimal floating-point numbers.
#pragma once

#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

/// The evidence of this name in a derivation, or none.
const Tree* find_evidence(const Tree& derivation, const std::string& name);

/// A hexadecimal number. Throws std::invalid_argument for another text.
Ball exact_number(const Tree& number);
/// The ends of an enclosure.
Ball low_of(const Tree& enclosure);
Ball high_of(const Tree& enclosure);
/// An array of three arrays of three numbers.
Matrix3 exact_matrix(const Tree& rows);

}  // namespace veritrack::checker

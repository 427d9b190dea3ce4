// A recursion's formulas as IEEE operations, in the order in which they are written.
#pragma once

#include <optional>

#include "checker/code/listing.hpp"
#include "checker/code/listing_rounding.hpp"
#include "checker/document/json_tree.hpp"

namespace veritrack::checker {

/// What formulas compute in a format.
struct WrittenFormulas {
  CodeListing listing;
  ListedAngles known;
};

/// From the member "model" of a design: sums and products associate from the left, x^n is ((x*x)*x)..., a
/// number is rounded to the format, parameters are computed from their formulas, a function is that of the
/// library, and the next value x of an angle becomes x - T*rint(x*(1/T)) with the turn T. Throws FormulaError
/// or Malformed.
WrittenFormulas written_formulas(const Tree& model, ListedFormat format);

/// The format that the member "arithmetic" names; nothing where it is exact. Throws Malformed for another.
std::optional<ListedFormat> written_format(const Tree& model);

}  // namespace veritrack::checker

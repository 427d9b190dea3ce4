// Formulas as IEEE operations, in the order in which they are written.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/model/code/listing_rounding.hpp"
#include "certificates/model/language/constants.hpp"
#include "certificates/model/language/expression.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::language {

/// A recursion as it is written.
struct WrittenRecursion {
  std::vector<NamedFormula> parameters;
  std::vector<Definition> step;  ///< without outer wraps of angles
  std::vector<std::string> states, samples, angles;
  Expression frequency;
};

/// The program of a recursion, in which numbers are inputs, and what bounds on its rounding rest on.
struct WrittenListing {
  trackers::code::Listing listing;
  std::map<int, std::string> names;  ///< of registers that parameters and lines have given a name to
  model::code::WrittenFacts facts;
};

/// The program in a format: sums and products associate from the left, x^n is ((x*x)*x)..., a number is the
/// nearest one of the format, parameters are computed from their formulas, a function is that of the library
/// in the format, and the next value of an angle is x - T*rint(x*(1/T)) with the turn T. Needs formulas that
/// compile.
[[nodiscard]] WrittenListing written_listing(const WrittenRecursion& recursion,
                                             trackers::code::Format format);

/// The same program with its numbers as constants, to be run.
[[nodiscard]] trackers::code::Listing with_constants(const WrittenListing& written);

}  // namespace veritrack::certificates::language

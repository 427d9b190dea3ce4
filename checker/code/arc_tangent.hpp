// A register that a certificate takes for the arc tangent of both samples, though the program computes it by
// operations of its own.
#pragma once

#include "checker/code/listing.hpp"
#include "checker/document/statement.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

struct ListedArcTangent {
  int place = -1;
  Ball error;    ///< rad
  Ball largest;  ///< rad
};

/// Objects unless everything else knows the samples by that register, which is within `error` of atan2(second
/// sample, first) modulo whole turns and no larger than `largest`: in the program's arithmetic, for all
/// samples of single precision of which the larger is between 2^-40 and 2^40.
void check_arc_tangent(const CodeListing& listing, const ListedArcTangent& arc, Objections& objections);

}  // namespace veritrack::checker

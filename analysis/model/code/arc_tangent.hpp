// A function of the program that is an arc tangent of its two samples, nearly: a polynomial by octants, say.
#pragma once

#include <optional>

#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

/// A register that all other operations know the samples by.
struct ArcTangent {
  int value = -1;
  double error = 0.0;    ///< |value - atan2(second sample, first)| modulo whole turns, rad, at most
  double largest = 0.0;  ///< |value|, rad, at most
};

/// Its bounds hold for all samples of which the larger has a size of 2^-40 to 2^40, and count the rounding;
/// they are multiples of 1e-4. Nothing where there is no such register, it is an arc tangent of the library,
/// or is further than 0.1 rad from one. Needs the upward rounding mode.
[[nodiscard]] std::optional<ArcTangent> arc_tangent(const trackers::code::Listing& listing);

/// The listing with an atan2 of the samples there.
[[nodiscard]] trackers::code::Listing with_arc_tangent(trackers::code::Listing listing,
                                                       const ArcTangent& arc);

}  // namespace veritrack::model::code

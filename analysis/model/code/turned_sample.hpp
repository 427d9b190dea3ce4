// The angle of a sample that is turned back by an angle of the program: its rounding is relative to the
// length of the sample.
#pragma once

#include <optional>

#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

/// The register t of atan2(b*cos(t) - a*sin(t), a*cos(t) + b*sin(t)), where a and b are the two samples.
[[nodiscard]] std::optional<int> turned_back_by(const trackers::code::Listing& listing,
                                                const trackers::code::Instruction& arc);

/// What the angle of the computed vector is off, before atan2 is rounded, rad. `of_turn`: what the angle t is
/// off; `of_functions`: what its sine and cosine are off from those of the computed t; `least`: the sample is
/// at least as long. Infinite where no bound is known. Needs the upward rounding mode.
[[nodiscard]] double error_of_turned_sample(trackers::code::Format format, double of_turn,
                                            double of_functions, double least);

}  // namespace veritrack::model::code

// The direction of two samples that are turned back by an angle of the program.
#pragma once

#include <optional>

#include "checker/code/listing.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// The register t where this one is atan2(b*cos(t) - a*sin(t), a*cos(t) + b*sin(t)) of the two samples a, b.
std::optional<int> angle_of_turned_pair(const CodeListing& listing, int place);

/// At least what the direction of the computed vector is off, rad: of sines that are off by `of_sine` besides
/// what t is off, and samples whose vector is at least that long. Everything where no bound is known.
Ball error_of_turned_pair(ListedFormat format, const Ball& of_angle, const Ball& of_sine, const Ball& least);

}  // namespace veritrack::checker

// The usual measures of the linear recursion of a tracker's errors, as a table. Not proved.
#pragma once

#include <optional>
#include <string>

#include "analysis/linear/detector_loop.hpp"
#include "analysis/linear/loop_response.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// Modes, the response to a step of the frequency over so many samples, white noise, and where it has one
/// detector its margins. Frequencies and times in Hz and seconds, too, where there is a rate.
[[nodiscard]] std::string linear_loop_table(const linear::LinearLoop& loop, std::size_t samples,
                                            const std::optional<linear::DetectorLoop>& detector,
                                            const std::optional<Number>& sample_rate);

}  // namespace veritrack::certificates

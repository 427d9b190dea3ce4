// A regulator that runs on a frequency tracker: its certificate, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind regulator_tracker();

}  // namespace veritrack::checker

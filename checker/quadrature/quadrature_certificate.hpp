// The quadrature tracker: its certificate, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind quadrature_tracker();

}  // namespace veritrack::checker

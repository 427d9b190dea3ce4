// The KKL observer: its certificate, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind kkl_observer_tracker();

}  // namespace veritrack::checker

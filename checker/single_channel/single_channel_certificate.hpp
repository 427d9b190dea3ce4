// The single-channel tracker: its certificate, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind single_channel_tracker();

}  // namespace veritrack::checker

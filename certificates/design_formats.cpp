// The formats of the design files of all trackers.
#include <array>

#include "certificates/design/design_format.hpp"

namespace veritrack::certificates {

#define VERITRACK_TRACKER(column) [[nodiscard]] const DesignFormat& column##_format();
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER

std::span<const DesignFormat* const> design_formats() {
  static const std::array formats{
#define VERITRACK_TRACKER(column) &column##_format(),
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER
  };
  return formats;
}

}  // namespace veritrack::certificates

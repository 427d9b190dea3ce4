// The formats of the design files of all trackers.
#include <algorithm>
#include <any>
#include <array>
#include <vector>

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

std::string_view others_are_left_out() {
#ifdef VERITRACK_SOME_TRACKERS
  return " in this build, which knows some trackers: `make programs` builds it for all";
#else
  return "";
#endif
}

KeyContract contract_of(std::string_view tracker, std::string_view table, std::string_view key) {
  for (const DesignFormat* format : design_formats()) {
    if (format->tracker != tracker) {
      continue;
    }
    std::any tables = format->empty_tables();
    for (const BoundTable& bound : format->bind_tables(tables)) {
      const auto found = std::find_if(bound.keys.begin(), bound.keys.end(),
                                      [&](const BoundKey& each) { return each.name == key; });
      if (bound.name == table && found != bound.keys.end()) {
        return found->contract;
      }
    }
  }
  return {};
}

}  // namespace veritrack::certificates

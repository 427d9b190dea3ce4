// The kinds of trackers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

#define VERITRACK_TRACKER(column) [[nodiscard]] const TrackerKind& column##_kind();
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER

std::span<const TrackerKind* const> tracker_kinds() {
  static const std::array kinds{
#define VERITRACK_TRACKER(column) &column##_kind(),
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER
  };
  return kinds;
}

const TrackerKind& kind_of(const Design& design) {
  const auto kinds = tracker_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const TrackerKind* kind) { return kind->name == design.tracker; });
  if (found == kinds.end()) {
    throw std::logic_error("no kind of tracker is called \"" + design.tracker + "\"");
  }
  return **found;
}

std::string names_of_kinds(bool (*has)(const TrackerKind& kind)) {
  std::vector<std::string_view> names;
  for (const TrackerKind* kind : tracker_kinds()) {
    if (has(*kind)) {
      names.push_back(kind->name);
    }
  }
  return fmt::format("{}", fmt::join(names, " or "));
}

}  // namespace veritrack::certificates

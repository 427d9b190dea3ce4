#include "checker/registry.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "checker/document/parts.hpp"

namespace veritrack::checker {

#define CHECKER_TRACKER(column) TrackerKind column##_tracker();
#include "checker/trackers.def"
#undef CHECKER_TRACKER

void verify_tracker(const Tree& certificate, bool all_boxes, Verification& result) {
  static const std::array kinds{
#define CHECKER_TRACKER(column) column##_tracker(),
#include "checker/trackers.def"
#undef CHECKER_TRACKER
  };
  const std::string& name = certificate.at("design").at("tracker").text();
  const auto* const kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const TrackerKind& known) { return known.name == name; });
  if (kind == kinds.end()) {
    std::string why = kUnknown;
#ifdef VERITRACK_SOME_TRACKERS
    why += " in this build, which knows some trackers: `make programs` builds it for all";
#endif
    result.parts.push_back({"tracker " + name, {why}});
    return;
  }
  kind->verify(certificate, all_boxes, result);
}

}  // namespace veritrack::checker

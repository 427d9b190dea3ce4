#include "certificates/document/tuning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "certificates/design/request_error.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

std::string trackers_with_tuning() {
  return names_of_kinds([](const TrackerKind& kind) { return kind.tune != nullptr; });
}

bool can_be_tuned(const Design& design) {
  return kind_of(design).tune != nullptr;
}

std::span<const std::string_view> tuning_objectives(const Design& design) {
  return kind_of(design).tuning_objectives;
}

TuningResult tune(const Design& design, const TuningRequest& request) {
  const TrackerKind& kind = kind_of(design);
  if (kind.tune == nullptr) {
    throw std::logic_error("nothing can be tuned of the tracker " + design.tracker);
  }
  const auto& known = kind.tuning_objectives;
  if (!request.objective.empty() && std::find(known.begin(), known.end(), request.objective) == known.end()) {
    throw RequestError(fmt::format("veritrack tune: the tracker {} has no objective {}; allowed: {}",
                                   design.tracker, request.objective, fmt::join(known, ", ")));
  }
  return kind.tune(design, request);
}

}  // namespace veritrack::certificates

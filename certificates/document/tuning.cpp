#include "certificates/document/tuning.hpp"

#include <stdexcept>

#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

std::string trackers_with_tuning() {
  return names_of_kinds([](const TrackerKind& kind) { return kind.tune != nullptr; });
}

bool can_be_tuned(const Design& design) {
  return kind_of(design).tune != nullptr;
}

TuningResult tune(const Design& design) {
  const TrackerKind& kind = kind_of(design);
  if (kind.tune == nullptr) {
    throw std::logic_error("nothing can be tuned of the tracker " + design.tracker);
  }
  return kind.tune(design);
}

}  // namespace veritrack::certificates

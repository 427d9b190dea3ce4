#include "certificates/document/tuning.hpp"

#include <fmt/format.h>

#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

TuningResult tune(const Design& design) {
  const TrackerKind& kind = kind_of(design);
  if (kind.tune == nullptr) {
    return {std::nullopt,
            fmt::format("Nothing can be tuned of the tracker {}; tuning needs the tracker {}.", kind.name,
                        names_of_kinds([](const TrackerKind& other) { return other.tune != nullptr; }))};
  }
  return kind.tune(design);
}

}  // namespace veritrack::certificates

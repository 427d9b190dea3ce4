#include "certificates/document/tuning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

std::optional<FreeParameter> free_parameter(std::string_view words) {
  const std::size_t equals = words.find('=');
  const std::size_t colon = words.find(':', equals == std::string_view::npos ? words.size() : equals);
  if (colon == std::string_view::npos || equals == 0) {
    return std::nullopt;
  }
  FreeParameter parameter{std::string(words.substr(0, equals)),
                          rigor::nearest_double(words.substr(equals + 1, colon - equals - 1)),
                          rigor::nearest_double(words.substr(colon + 1))};
  const bool is_range = parameter.low < parameter.high && std::isfinite(parameter.high - parameter.low);
  return is_range ? std::optional(std::move(parameter)) : std::nullopt;
}

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
  if (kind.names_parameters && request.over.empty()) {
    throw RequestError(
        "veritrack tune needs to know which parameters may change, and from where to where: --over "
        "NAME=LOW:HIGH for each",
        "tracker");
  }
  if (!kind.names_parameters && !request.over.empty()) {
    throw RequestError(
        fmt::format("veritrack tune: --over is for parameters that a design file names; those of the tracker "
                    "{} are known, and all of them may change",
                    design.tracker),
        "tracker");
  }
  return kind.tune(design, request);
}

}  // namespace veritrack::certificates

#include "certificates/model/root_locus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

// Steps between the values, and on the way to a border: over the phase each takes a simulation.
constexpr int kIntervals = 60;
constexpr int kHalvings = 20;
constexpr int kIntervalsOverPhase = 30;
constexpr int kHalvingsOverPhase = 8;

using Found = std::function<std::optional<Multipliers>(double value)>;

std::size_t place_of(const ModelTables& tables, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& parameter : tables.model.parameters) {
    if (parameter.name.text == name) {
      return names.size();
    }
    names.push_back(parameter.name.text);
  }
  throw RequestError(fmt::format("--over {}: no such parameter; allowed: {}", name, fmt::join(names, ", ")),
                     "model.parameters");
}

/// The way in which modes are found at some value: in the frame of the signal, or over the phase.
ChangedLoop form_of(ChangedLoop loop, const model::TrackerModel& tracker, double value) {
  if (!loop.in_frame(value)) {
    for (const model::ProposedVector& vector : model::possible_vectors(tracker)) {
      ChangedLoop other = loop;
      other.vector = vector;
      if (other.in_frame(value)) {
        return other;
      }
    }
  }
  return loop;
}

/// Where a loop becomes stable or unstable between two values.
double border(const Found& found, int halvings, RootLocus::Point stable, RootLocus::Point unstable) {
  const bool by_ratio = stable.value > 0.0 && unstable.value > 0.0;
  for (int i = 0; i < halvings; ++i) {
    const double middle =
        by_ratio ? std::sqrt(stable.value * unstable.value) : 0.5 * (stable.value + unstable.value);
    RootLocus::Point point{middle, found(middle).value_or(Multipliers())};
    (point.is_stable() ? stable : unstable) = std::move(point);
  }
  return stable.value;
}

std::vector<RootLocus::Range> stable_ranges(const Found& found, int halvings,
                                            const std::vector<RootLocus::Point>& points) {
  std::vector<RootLocus::Range> ranges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_stable()) {
      continue;
    }
    const bool begins = i == 0 || !points[i - 1].is_stable();
    if (begins) {
      ranges.push_back({i == 0 ? points[i].value : border(found, halvings, points[i], points[i - 1]), 0.0});
    }
    const bool ends = i + 1 == points.size() || !points[i + 1].is_stable();
    if (ends) {
      ranges.back().to =
          i + 1 == points.size() ? points[i].value : border(found, halvings, points[i], points[i + 1]);
    }
  }
  return ranges;
}

}  // namespace

RootLocus root_locus(const ModelTables& tables, const FreeParameter& over) {
  const rigor::UpwardRounding upward;
  ChangedLoop loop{&tables, place_of(tables, over.name)};
  const Model model = make_model(tables.model, tables.assume.signal);
  RootLocus locus;
  locus.parameter = over.name;
  locus.given = model.constants[loop.parameter].nearest;
  locus.frequency = rigor::midpoint(band_of(tables.assume));
  locus.is_average = model.recursion.samples == 1;
  loop = form_of(loop, proved_model(model, tables.assume), locus.given);
  locus.is_in_frame = loop.in_frame(locus.given) || loop.in_frame(over.low) || loop.in_frame(over.high);
  const int intervals = locus.is_in_frame ? kIntervals : kIntervalsOverPhase;
  const auto value_at = [&](int i) {
    const double share = static_cast<double>(i) / intervals;
    return i == 0           ? over.low
           : i == intervals ? over.high
           : over.low > 0.0 ? over.low * std::pow(over.high / over.low, share)
                            : over.low + share * (over.high - over.low);
  };
  const Found found = [&](double value) {
    return locus.is_in_frame ? loop.in_frame(value) : loop.over_phase(value);
  };
  bool is_any = false;
  for (int i = 0; i <= intervals; ++i) {
    locus.points.push_back({value_at(i), found(value_at(i)).value_or(Multipliers())});
    is_any = is_any || !locus.points.back().multipliers.empty();
  }
  if (!is_any) {
    throw RequestError(
        fmt::format("--over {}: at none of the values a steady state of the loop was found", over.name),
        "model.start");
  }
  locus.stable = stable_ranges(found, locus.is_in_frame ? kHalvings : kHalvingsOverPhase, locus.points);
  return locus;
}

}  // namespace veritrack::certificates

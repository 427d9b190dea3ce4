#include "certificates/model/loop_stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "certificates/model/changed_loop.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::certificates {

namespace {

/// Whether it only converts a unit of the frequency, such as the time between samples: its sign is right.
bool is_of_unit(const Model& model, std::size_t parameter) {
  const auto& instructions = model.recursion.frequency.instructions();
  const auto place = static_cast<int>(parameter);
  return std::any_of(instructions.begin(), instructions.end(), [&](const trackers::Instruction& each) {
    return each.first == place || each.second == place;
  });
}

/// Between a stable and an unstable value.
double crossing(const ChangedLoop& loop, double stable, double unstable) {
  constexpr int kSteps = 30;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = std::copysign(std::sqrt(stable * unstable), stable);
    (loop.is_stable(middle) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace

std::vector<StabilityLimit> stability_limits(const ModelTables& tables,
                                             const std::optional<model::ProposedVector>& vector) {
  constexpr double kFactor = 1.25;
  constexpr int kSteps = 31;  // to a factor of 1000
  std::vector<StabilityLimit> limits;
  const Model model = make_model(tables.model, tables.assume.signal);
  for (std::size_t i = 0; i < tables.model.parameters.size(); ++i) {
    const ChangedLoop loop{&tables, i, vector};
    const double value = model.constants[i].nearest;
    const std::string& name = tables.model.parameters[i].name.text;
    if (value == 0.0) {
      continue;
    }
    if (!is_of_unit(model, i) && loop.is_stable(-value)) {
      limits.push_back({name, value, -value, StabilityLimit::Stable::at});
      continue;
    }
    using enum StabilityLimit::Stable;
    const bool is_negative = value < 0.0;
    double last_down = value;
    double last_up = value;
    for (int step = 0; step < kSteps; ++step) {
      const double down = last_down / kFactor;
      const double up = last_up * kFactor;
      if (loop.is_stable(down)) {
        limits.push_back({name, value, crossing(loop, down, last_down), is_negative ? above : below});
        break;
      }
      if (loop.is_stable(up)) {
        limits.push_back({name, value, crossing(loop, up, last_up), is_negative ? below : above});
        break;
      }
      last_down = down;
      last_up = up;
    }
  }
  return limits;
}

}  // namespace veritrack::certificates

#include "certificates/model/loop_stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/model/gain/steady_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/spectral_radius.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

/// The largest multiplier of the linear recursion, with another value of a parameter; empty where it has no
/// steady state.
std::optional<double> radius_with(ModelTables tables, const std::optional<model::ProposedVector>& vector,
                                  std::size_t parameter, double value) {
  tables.model.parameters[parameter].formula.text = fmt::format("{:.17g}", value);
  const Model model = make_model(tables.model, tables.assume.signal);
  const model::TrackedTone tone = proposed_tone(model, tables.assume);
  const model::TrackerModel tracker = proved_model(model, tables.assume);
  const rigor::Interval band = band_of(tables.assume);
  const double omega = rigor::midpoint(band);
  const auto steady = model::proposed_steady_state(tracker, tone.start, omega, omega + 1e-3, vector);
  if (!steady) {
    return std::nullopt;
  }
  const Eigen::MatrixXd slope = model::step_residual(tracker, *steady, omega).slope;
  const rigor::NearestRounding nearest;
  return rigor::spectral_radius(slope);
}

/// The loop with other values of a parameter.
struct ChangedLoop {
  const ModelTables* tables;
  std::optional<model::ProposedVector> vector;
  std::size_t parameter = 0;

  [[nodiscard]] bool is_stable(double value) const {
    const auto radius = radius_with(*tables, vector, parameter, value);
    return radius && *radius < 1.0;
  }
};

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
    const ChangedLoop loop{&tables, vector, i};
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

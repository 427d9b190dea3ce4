#include "certificates/model/changed_loop.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/spectral_radius.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kStepOfFrequency = 1e-3;  // rad/sample, for slopes

ModelTables with_value(ModelTables tables, std::size_t parameter, double value) {
  tables.model.parameters[parameter].formula.text = fmt::format("{:.17g}", value);
  return tables;
}

}  // namespace

std::optional<Multipliers> ChangedLoop::in_frame(double value) const {
  const ModelTables changed = with_value(*tables, parameter, value);
  const Model model = make_model(changed.model, changed.assume.signal);
  const model::TrackedTone tone = proposed_tone(model, changed.assume);
  const model::TrackerModel tracker = proved_model(model, changed.assume);
  const double omega = rigor::midpoint(band_of(changed.assume));
  try {
    const auto steady =
        model::proposed_steady_state(tracker, tone.start, omega, omega + kStepOfFrequency, vector);
    if (!steady) {
      return std::nullopt;
    }
    const Eigen::MatrixXd slope = model::step_residual(tracker, *steady, omega).slope;
    const rigor::NearestRounding nearest;
    return rigor::eigenvalues_by_size(slope);
  } catch (const model::NoFrame&) {
    return std::nullopt;
  }
}

std::optional<Multipliers> ChangedLoop::over_phase(double value) const {
  const ModelTables changed = with_value(*tables, parameter, value);
  const Model model = make_model(changed.model, changed.assume.signal);
  const rigor::Interval band = band_of(changed.assume);
  const rigor::NearestRounding nearest;
  const double omega = rigor::midpoint(band);
  constexpr double kShare = 0.1;  // of the frequency: more is another lock
  const auto cell =
      model::propose_floquet_cell(proposed_tone(model, changed.assume), model::FloquetGauge::by_mode, omega,
                                  omega + 1e-6, kShare * std::fabs(omega));
  return cell ? std::optional(model::floquet_multipliers(*cell)) : std::nullopt;
}

bool ChangedLoop::is_stable(double value) const {
  const auto multipliers = in_frame(value);
  return multipliers && std::abs(multipliers->front()) < 1.0;
}

}  // namespace veritrack::certificates

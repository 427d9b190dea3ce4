#include "analysis/model/set/set_search.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/model/step/undefined_operation.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

using rigor::Interval;

BandSettings settings_of(const TrackedTone& tone, const SetTask& task, double low, double high) {
  BandSettings settings;
  settings.deadline = task.deadline;
  settings.tube.shape.deadline = task.deadline;
  settings.tube.steady_state.deadline = task.deadline;
  settings.tube.fine_curve = task.with_curve;
  settings.tube.shape.objective = task.objective;
  settings.tube.shape.start = task.deviations;
  // For the largest noise it would be the given one.
  settings.tube.shape.noise = task.noise + (task.largest_noise ? 0.0 : error_from_amplitude(tone));
  settings.tube.shape.slew = task.slew;
  settings.tube.shape.largest_reach = task.largest_error;
  // A lock on a harmonic is off by half of the frequency or more; a bias may be a tenth.
  settings.tube.steady_state.largest_mean_error = std::max(0.5 * (high - low), 0.25 * low);
  return settings;
}

std::string words_of_undefined(const TrackedTone& tone, const TrackerModel& model, const TubeProposal& cell,
                               double radius, double noise) {
  const auto found = find_undefined(model, *cell.tube, radius, noise);
  const auto number = static_cast<std::size_t>(found ? found->instruction : 0);
  if (!found || number >= tone.objections.size()) {
    return {};
  }
  const double reach = cell.worth.reach / cell.worth.level;
  std::string text = fmt::format(", where {} with frequency errors up to about {:.2g} rad/sample",
                                 tone.objections[number], reach * radius);
  if (found->defined_radius > 0.0) {
    return text + fmt::format(", and not with those up to about {:.2g},", reach * found->defined_radius);
  }
  return text + ", and with much smaller ones, too,";
}

std::string place_of_cell(const TubeProposal& cell) {
  return fmt::format("between {:.6g} and {:.6g} rad/sample", cell.frequency - cell.half_width,
                     cell.frequency + cell.half_width);
}

bool covers(const std::vector<ProvedTube>& tubes, double low, double high) {
  const rigor::UpwardRounding upward;
  double known = low;
  for (const ProvedTube& proved : tubes) {
    const Interval from = Interval(proved.tube.frequency) - Interval(proved.tube.half_width);
    const Interval to = Interval(proved.tube.frequency) + Interval(proved.tube.half_width);
    if (!(from.upper() <= known)) {
      return false;
    }
    known = std::max(known, to.lower());
  }
  return !tubes.empty() && known >= high;
}

void widen(Tube& tube) {
  constexpr double kShare = 0x1p-40;
  tube.half_width += kShare * tube.half_width + 0x1p-50 * tube.frequency;
}

double with_room(double shrinking) {
  constexpr double kShare = 0.1;
  return shrinking - kShare * (1.0 - shrinking);
}

bool is_locked(const TrackerModel& model, const Tube& tube, double radius) {
  const Interval error = bound_errors(model, tube, radius, {64, 1}).error;
  return rigor::is_finite(error) && -error.lower() < tube.frequency && error.upper() < tube.frequency;
}

}  // namespace veritrack::model

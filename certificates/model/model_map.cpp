#include "certificates/model/model_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "analysis/model/tube/angle_check.hpp"
#include "analysis/model/tube/tube_errors.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

constexpr std::size_t kMostMappedStates = 4;

/// States that the estimated frequency is computed from.
std::set<std::size_t> states_of_frequency(const trackers::Recursion& recursion) {
  const trackers::StraightLineProgram& program = recursion.frequency;
  std::vector<char> is_used(static_cast<std::size_t>(program.registers()), 0);
  is_used[static_cast<std::size_t>(program.results().front())] = 1;
  for (std::size_t i = program.instructions().size(); i-- > 0;) {
    if (is_used[static_cast<std::size_t>(program.inputs()) + i] != 0) {
      const trackers::Instruction& instruction = program.instructions()[i];
      for (const int operand : {instruction.first, instruction.second, instruction.third}) {
        if (operand >= 0) {
          is_used[static_cast<std::size_t>(operand)] = 1;
        }
      }
    }
  }
  std::set<std::size_t> states;
  for (std::size_t i = 0; i < static_cast<std::size_t>(recursion.states); ++i) {
    if (is_used[static_cast<std::size_t>(recursion.constants) + i] != 0) {
      states.insert(i);
    }
  }
  return states;
}

std::size_t state_called(const Model& model, const std::string& name, const char* option) {
  const auto found = std::find(model.states.begin(), model.states.end(), name);
  if (found == model.states.end()) {
    throw RequestError(fmt::format("{} {}: no such state; nearest: {}; allowed: {}", option, name,
                                   nearest_key(name, model.states), fmt::join(model.states, ", ")),
                       "model.states");
  }
  return static_cast<std::size_t>(found - model.states.begin());
}

/// The two states that deviate. By default the one from which the frequency is read, and an angle or, where
/// there is none, the first other state.
std::array<std::size_t, 2> mapped_states(const Model& model, const ModelMapRequest& request) {
  std::optional<std::size_t> x;
  std::optional<std::size_t> y;
  if (request.x) {
    x = state_called(model, *request.x, "--x");
  }
  if (request.y) {
    y = state_called(model, *request.y, "--y");
  }
  if (x && y && *x == *y) {
    throw RequestError(fmt::format("--x and --y are both {}; allowed: two different states", *request.x));
  }
  if (!y) {
    for (const std::size_t state : states_of_frequency(model.recursion)) {
      if (!y && state != x.value_or(SIZE_MAX)) {
        y = state;
      }
    }
  }
  for (const bool by_angle : {true, false}) {
    for (std::size_t state = 0; state < model.states.size(); ++state) {
      const bool is_free = state != x.value_or(SIZE_MAX) && state != y.value_or(SIZE_MAX);
      if (is_free && (!by_angle || model.recursion.is_angle[state])) {
        if (!x) {
          x = state;
        } else if (!y) {
          y = state;
        }
      }
    }
  }
  return {x.value(), y.value()};
}

/// The frequency at which starts are followed.
void choose_frequency(ModelMap& map, const ModelAssumptions& assume, const ModelMapRequest& request) {
  const Interval band = band_of(assume);
  if (request.frequency) {
    map.frequency_text = *request.frequency;
  } else {
    // With few digits, unless the band is narrower than that.
    map.frequency_text = fmt::format("{:.6g}", rigor::midpoint(band));
    if (!rigor::is_subset(rigor::parse_decimal(map.frequency_text), band)) {
      map.frequency_text = fmt::format("{}", rigor::midpoint(band));
    }
  }
  try {
    map.frequency = rigor::parse_decimal(map.frequency_text);
  } catch (const rigor::NumberFormatError&) {
    throw RequestError(
        fmt::format("--at {}: no number; allowed: a frequency in rad/sample", map.frequency_text));
  }
  const bool is_inside = map.frequency.lower() >= band.lower() && map.frequency.upper() <= band.upper() &&
                         map.frequency.lower() > 0.0 &&
                         rigor::certainly_less(Interval(map.frequency.upper()), rigor::pi());
  if (!is_inside) {
    throw RequestError(
        fmt::format("--at {}: not in the assumed band; allowed: {} to {} rad/sample, above 0 and "
                    "below pi",
                    map.frequency_text, rigor::to_decimal(band.lower(), 6, rigor::Direction::up),
                    rigor::to_decimal(band.upper(), 6, rigor::Direction::down)),
        "assume.frequency");
  }
}

std::string unit_of(const ModelTable& table, const std::string& state, bool is_angle) {
  for (const NamedText& unit : table.units) {
    if (unit.name.text == state) {
      return unit.formula.text;
    }
  }
  return is_angle ? "rad" : "";
}

/// Larger than the certified set by this factor, where no range is given.
constexpr double kTimesCertified = 10.0;

double range_of(const MappedState& state, const std::optional<double>& given, bool is_angle,
                const char* option) {
  if (given) {
    if (!(*given > 0.0) || !std::isfinite(*given)) {
      throw RequestError(fmt::format("{} {}: no range; allowed: a number above 0", option, *given));
    }
    return *given;
  }
  const double range = kTimesCertified * state.certified;
  return is_angle ? std::min(range, std::numbers::pi) : range;
}

/// The tube about the frequency; empty, and the reason, when none is proved.
std::optional<model::ProvedTube> tube_about(const Interval& frequency, const model::TrackedTone& tone,
                                            const model::TrackerModel& tracker, double noise,
                                            std::string& reason) {
  const model::SetTask task{.name = "starts",
                            .objective = model::is_disturbed(tracker, noise)
                                             ? model::ShapeObjective::largest_noise
                                             : model::ShapeObjective::largest_starts,
                            .noise = noise,
                            .with_curve = true,
                            .deviations = {}};
  constexpr double kShare = 1e-4;  // of the frequency: narrow
  const double middle = rigor::midpoint(frequency);
  const double half = std::min(kShare * middle, 0.25 * (std::numbers::pi - middle));
  const model::TubeSet set = model::prove_set(tone, tracker, middle - half, middle + half, task);
  for (const model::ProvedTube& proved : set.tubes) {
    const Interval low = Interval(proved.tube.frequency) - Interval(proved.tube.half_width);
    const Interval high = Interval(proved.tube.frequency) + Interval(proved.tube.half_width);
    if (low.upper() <= frequency.lower() && frequency.upper() <= high.lower()) {
      return proved;
    }
  }
  reason = "no tube is proved about this frequency";
  if (!set.reasons.empty()) {
    reason += ": " + set.reasons.front();
  }
  return std::nullopt;
}

double size_of_range(const Interval& range) {
  return rigor::is_finite(range) ? rigor::magnitude(range) : INFINITY;
}

}  // namespace

std::size_t ModelMap::proved() const {
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [](const model::CapturedCell& cell) { return cell.is_proved; }));
}

std::size_t ModelMap::unfinished() const {
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [](const model::CapturedCell& cell) { return cell.is_unfinished; }));
}

std::size_t ModelMap::simulated_only() const {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (!cells[cell].is_proved && simulated.locks(cell)) {
      ++count;
    }
  }
  return count;
}

std::size_t ModelMap::longest() const {
  std::size_t most = 0;
  for (const model::CapturedCell& cell : cells) {
    most = cell.is_proved ? std::max(most, cell.samples) : most;
  }
  return most;
}

namespace {

/// Throws RequestError for a design without a map.
void require_mappable(const ModelTables& tables, const Model& model, const ModelMapRequest& request) {
  if (model.states.size() > kMostMappedStates || model.states.size() < 2) {
    throw RequestError(fmt::format("{} states; a map follows starts of at least 2 and at most {} states",
                                   model.states.size(), kMostMappedStates),
                       tables.model.ekf ? "model.ekf.states" : "model.states");
  }
  if (is_constant_in_range(tables.assume)) {
    throw RequestError(
        "a constant amplitude in a range: a map is for the tubes of one part of the range; allowed: one "
        "amplitude, or [least, largest] of amplitudes that may differ from sample to sample",
        "assume.amplitude");
  }
  if (request.with_noise && tables.assume.gaussian) {
    throw RequestError(
        "--noise: Gaussian noise has no bound; allowed: a map without noise, or a design whose noise has a "
        "bound",
        "assume.noise");
  }
}

/// Simulated, and those that lock proved.
void follow_starts(ModelMap& map, const model::CaptureProblem& problem, const search::Deadline& deadline,
                   const CertifyProgress& progress) {
  constexpr int kSimulatedPhases = 8;
  map.simulated_samples = 10'000;
  map.simulated = model::simulate_starts(problem, map.grid, kSimulatedPhases, map.simulated_samples);
  std::vector<char> wanted(map.grid.cells(), 0);
  for (std::size_t cell = 0; cell < wanted.size(); ++cell) {
    wanted[cell] = map.simulated.locks(cell) ? 1 : 0;  // the others would only take time
  }
  model::CaptureOptions options;
  options.most_samples = std::min<std::size_t>(2 * map.simulated.longest + 64, 6'000);
  options.most_steps = 40'000;
  options.rings = 3;
  options.deadline = deadline;
  constexpr double kTolerance = 0.05;
  options.tolerance = kTolerance * (1.0 - map.tube.shrinking.back());
  const auto report = [&](double share) {
    if (progress) {
      progress({share, 0.0, 0});
    }
  };
  map.cells = model::prove_captured(problem, map.grid, wanted, options, report);
}

}  // namespace

ModelMapResult map_model(const Design& design, const ModelMapRequest& request,
                         const CertifyProgress& progress) {
  const rigor::UpwardRounding upward;
  const ModelTables& tables = model_tables(design);
  const ModelAssumptions& assume = tables.assume;
  const Model model = make_model(tables.model, assume.signal);
  require_mappable(tables, model, request);
  ModelMap map;
  choose_frequency(map, assume, request);
  map.noise = request.with_noise ? assume.noise.value.upper() : 0.0;
  const std::array<std::size_t, 2> states = mapped_states(model, request);
  const model::TrackerModel tracker = proved_model(model, assume);
  ModelMapResult result;
  // prove_set relies on both; so does a count of angles modulo 2 pi.
  result.reason = model::angle_objection(model.recursion, tracker.constants);
  if (result.reason.empty() && !model::is_periodic(model.signal, tracker.constants)) {
    result.reason = "the signal is not known to have the period 2 pi in its phase";
  }
  if (!result.reason.empty()) {
    return result;
  }
  std::optional<model::ProvedTube> tube =
      tube_about(map.frequency, proposed_tone(model, assume), tracker, map.noise, result.reason);
  if (!tube) {
    return result;
  }
  map.tube = *std::move(tube);
  const model::CaptureProblem problem{&tracker, &map.tube.tube, map.tube.levels.front(), map.frequency,
                                      map.noise};
  const auto name_of = [&](std::size_t state) {
    return MappedState{model.states[state],
                       unit_of(tables.model, model.states[state], model.recursion.is_angle[state]), 0.0};
  };
  map.x = name_of(states[0]);
  map.y = name_of(states[1]);
  const auto axes = model::edge_of_section(problem, states[0], 1.0, states[1], 1.0, 4);
  map.x.certified = std::fabs(axes[0][0]);
  map.y.certified = std::fabs(axes[1][1]);
  const double x_range = range_of(map.x, request.x_range, model.recursion.is_angle[states[0]], "--x-range");
  const double y_range = range_of(map.y, request.y_range, model.recursion.is_angle[states[1]], "--y-range");
  constexpr int kEdgePoints = 180;
  map.edge =
      model::edge_of_section(problem, states[0], map.x.certified, states[1], map.y.certified, kEdgePoints);
  constexpr int kDefaultCells = 21;
  map.grid =
      model::capture_grid(states[0], x_range, states[1], y_range, request.cells.value_or(kDefaultCells));
  follow_starts(map, problem, request.deadline, progress);
  const model::ErrorGrid grid;
  map.frequency_error =
      size_of_range(bound_errors(tracker, map.tube.tube, map.tube.levels.front(), grid).error);
  map.settled_error = size_of_range(bound_errors(tracker, map.tube.tube, map.tube.levels.back(), grid).error);
  map.settling_samples = samples_until(map.tube, map.tube.levels.size() - 1);
  result.found = std::move(map);
  return result;
}

}  // namespace veritrack::certificates

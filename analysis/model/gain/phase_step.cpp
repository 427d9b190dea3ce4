#include "analysis/model/gain/phase_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/basis_inverse.hpp"
#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/phase_gates.hpp"
#include "analysis/model/gain/phase_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;
using trackers::Instruction;

namespace {

/// Runs programs over values with slopes.
class PhaseRun {
 public:
  PhaseRun(std::size_t states, std::size_t channels, PhaseStep& step)
      : states_(states), rules_(states, step) {
    for (std::size_t c = 0; c < channels; ++c) {
      step.inputs.push_back({true, {}, {}});
    }
    step_ = &step;
  }

  /// The results of a program. `has_gates`: of the step.
  std::vector<PhaseValue> run(const trackers::StraightLineProgram& program, std::vector<PhaseValue> registers,
                              bool has_gates) {
    const std::vector<int> gates = has_gates ? gates_of(program) : std::vector<int>();
    std::map<int, int> gate_of_input;
    for (const Instruction& each : program.instructions()) {
      const auto place = static_cast<int>(registers.size());
      const std::size_t before = step_->inputs.size();
      registers.push_back(rules_.value_of(each, registers));
      if (!has_gates) {
        continue;
      }
      const int gate = gates[static_cast<std::size_t>(place)];
      for (std::size_t i = before; i < step_->inputs.size(); ++i) {
        gate_of_input[static_cast<int>(i)] = gate;
      }
      if (gate == place) {
        close(registers.back(), place, gate_of_input);
      }
    }
    for (const int limit : program.limits()) {
      // Their remainders come into nothing else: into a form of their own they come, and are 0 there, or
      // infinite.
      rules_.form_of(registers[static_cast<std::size_t>(limit)]);
    }
    std::vector<PhaseValue> results;
    for (const int result : program.results()) {
      results.push_back(registers[static_cast<std::size_t>(result)]);
    }
    return results;
  }

  PhaseRules& rules() { return rules_; }

 private:
  /// Takes the remainders of this gate out of its value, and gives it one input in their place.
  void close(PhaseValue& value, int gate, const std::map<int, int>& gate_of_input) {
    PhaseInput input;
    for (auto slope = value.slopes.begin(); slope != value.slopes.end();) {
      const int number = slope->first - static_cast<int>(states_);
      const auto found = gate_of_input.find(number);
      if (found != gate_of_input.end() && found->second == gate) {
        input.sources.push_back({number, rigor::magnitude(slope->second.range())});
        slope = value.slopes.erase(slope);
      } else {
        ++slope;
      }
    }
    if (input.sources.empty()) {
      return;
    }
    const auto number = static_cast<int>(step_->inputs.size());
    step_->inputs.push_back(std::move(input));
    step_->gates.push_back(number);
    value.slopes.emplace(number + static_cast<int>(states_), BallModel(1.0));
  }

  std::size_t states_;
  PhaseStep* step_ = nullptr;
  PhaseRules rules_;
};

/// The basis as a curve, row by row.
Tube curve_of_basis(const FloquetCell& cell) {
  Tube series;
  series.turns.assign(cell.basis.size(), 0);
  series.curve = cell.basis;
  return series;
}

std::vector<BallModel> basis_at(const FloquetCell& cell, const BallModel& phase, const BallModel& z) {
  return tube_at(curve_of_basis(cell), phase, z).curve;
}

/// A remainder by which a result still has a slope is an input with a column, whatever its gate was: a wrong
/// gate costs room and never correctness.
void add_open_remainders(const std::vector<PhaseValue>& results, std::size_t states, PhaseStep& step) {
  for (const PhaseValue& each : results) {
    for (const auto& slope : each.slopes) {
      const int input = slope.first - static_cast<int>(states);
      const bool is_known = input < 0 || step.inputs[static_cast<std::size_t>(input)].is_noise ||
                            std::find(step.gates.begin(), step.gates.end(), input) != step.gates.end();
      if (!is_known) {
        step.gates.push_back(input);
      }
    }
  }
}

PhaseValue constant_value(const Interval& constant) {
  return {BallModel(constant), {}};
}

/// The one state of which a frequency without remainders is a multiple, and the factor; or none. `values`:
/// constants and states.
std::optional<std::pair<std::size_t, Interval>> frequency_state(const TrackerModel& tracker,
                                                                std::vector<PhaseValue> values) {
  const std::size_t n = static_cast<std::size_t>(tracker.recursion->states);
  for (std::size_t i = 0; i < n; ++i) {
    values[values.size() - n + i].slopes = {{static_cast<int>(i), BallModel(1.0)}};
  }
  PhaseStep unused;
  const PhaseValue result = PhaseRun(n, 0, unused).run(tracker.recursion->frequency, values, false).front();
  std::optional<std::pair<std::size_t, Interval>> found;
  for (const auto& [input, slope] : result.slopes) {
    if (static_cast<std::size_t>(input) >= n || found) {
      return std::nullopt;
    }
    found.emplace(static_cast<std::size_t>(input), slope.range());
  }
  return found;
}

/// The derivatives of a curve by the frequency at a phase that does not change with it, times `factor`.
std::vector<BallModel> per_frequency(const Tube& curve, double half_width, const BallModel& phase,
                                     const BallModel& z, double factor) {
  std::vector<BallModel> slopes;
  const BallModel per_z(Interval(factor) / Interval(half_width));
  for (const BallModel& each : curve_slope_at(curve, phase, z)) {
    slopes.push_back(each * per_z);
  }
  return slopes;
}

std::vector<PhaseValue> states_in_basis(const std::vector<BallModel>& curve,
                                        const std::vector<BallModel>& basis) {
  const std::size_t n = curve.size();
  std::vector<PhaseValue> states;
  for (std::size_t i = 0; i < n; ++i) {
    PhaseValue state{curve[i], {}};
    for (std::size_t j = 0; j < n; ++j) {
      state.slopes.emplace(static_cast<int>(j), basis[i * n + j]);
    }
    states.push_back(std::move(state));
  }
  return states;
}

/// The slopes of the new states, and what else comes into them, in the basis at the end of the step.
/// `basis_slope`: of its derivative by the frequency, row by row.
void change_basis(const std::vector<PhaseValue>& next, std::size_t channels, std::vector<BallModel> basis,
                  const std::vector<BallModel>& basis_slope, PhaseStep& step) {
  const std::size_t n = next.size();
  const auto slopes_by = [&](std::size_t key) {
    std::vector<BallModel> column;
    for (const PhaseValue& each : next) {
      const auto found = each.slopes.find(static_cast<int>(key));
      column.push_back(found == each.slopes.end() ? BallModel(0.0) : found->second);
    }
    return column;
  };
  std::vector<std::vector<BallModel>> by_state;
  std::vector<std::vector<BallModel>> units(n, std::vector<BallModel>(n));
  std::vector<std::vector<BallModel>> changes(n);
  for (std::size_t j = 0; j < n; ++j) {
    by_state.push_back(slopes_by(j));
    units[j][j] = BallModel(1.0);
    for (std::size_t i = 0; i < n; ++i) {
      changes[j].push_back(basis_slope[i * n + j]);
    }
  }
  std::vector<std::vector<BallModel>*> sides{&step.residual, &step.slew};
  for (std::size_t j = 0; j < n; ++j) {
    sides.push_back(&by_state[j]);
    sides.push_back(&units[j]);
    sides.push_back(&changes[j]);
  }
  for (std::size_t c = 0; c < channels; ++c) {
    sides.push_back(&(step.columns[static_cast<int>(c)] = slopes_by(n + c)));
  }
  for (const int gate : step.gates) {
    sides.push_back(&(step.columns[gate] = slopes_by(n + static_cast<std::size_t>(gate))));
  }
  solve_in_basis(std::move(basis), sides);
  step.matrix.assign(n, std::vector<BallModel>(n));
  step.inverse = step.matrix;
  step.basis_slope = step.matrix;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      step.matrix[i][j] = by_state[j][i];
      step.inverse[i][j] = units[j][i];
      step.basis_slope[i][j] = changes[j][i];
    }
  }
}

/// What the program is off in this step while its states are within their room, which is a condition on forms
/// of their own.
void add_rounding(const TrackerModel& tracker, const std::vector<PhaseValue>& states, PhaseRules& rules,
                  PhaseStep& step) {
  const ProgramRounding& program = *tracker.rounding;
  std::vector<Interval> ranges;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double room = program.room[i];
    const auto form = static_cast<std::size_t>(rules.form_of(states[i]));
    if (std::isfinite(room)) {
      step.forms[form].direct.push_back({static_cast<int>(step.inputs.size()), 1.0});
      step.inputs.push_back(
          {false,
           [form, room](const std::vector<double>& bounds) { return bounds[form] < room ? 0.0 : INFINITY; },
           {}});
    }
    ranges.push_back(states[i].base.range() + Interval::from_bounds(-room, room));
  }
  step.rounding.assign(states.size() + 1, 0.0);
  if (!program.of_step) {
    return;
  }
  const double most = 2.0 * tracker.amplitude.upper();
  step.rounding = program.of_step(ranges, Interval::from_bounds(-most, most));
}

}  // namespace

PhaseStep phase_step(const TrackerModel& tracker, const FloquetCell& cell, const TubeCell& part) {
  const std::size_t n = cell.states();
  const auto channels = static_cast<std::size_t>(tracker.recursion->samples);
  const CellPlace place = place_of(part);
  const BallModel omega = frequency_at(cell.curve, place.z);
  const BallModel next_phase = place.phase + omega;
  const std::vector<BallModel> there = tube_at(cell.curve, next_phase, place.z).curve;

  PhaseStep step;
  PhaseRun run(n, channels, step);
  std::vector<PhaseValue> values;
  for (const Interval& constant : tracker.constants) {
    values.push_back(constant_value(constant));
  }
  const std::vector<PhaseValue> states =
      states_in_basis(tube_at(cell.curve, place.phase, place.z).curve, basis_at(cell, place.phase, place.z));
  values.insert(values.end(), states.begin(), states.end());
  if (tracker.rounding != nullptr) {
    add_rounding(tracker, states, run.rules(), step);
  }
  step.frequency_state = frequency_state(tracker, values);
  std::vector<PhaseValue> error = run.run(tracker.recursion->frequency, values, false);
  const std::vector<BallModel> signal =
      model::run(tracker, *tracker.signal, {BallModel(tracker.amplitude), next_phase});
  for (std::size_t c = 0; c < channels; ++c) {
    values.push_back({signal[c], {{static_cast<int>(n + c), BallModel(1.0)}}});
  }
  const std::vector<PhaseValue> next = run.run(tracker.recursion->step, values, true);
  error.front().base -= omega;
  step.bias = error.front().base;
  run.rules().form_of(error.front());
  add_open_remainders(next, n, step);
  for (std::size_t i = 0; i < n; ++i) {
    step.residual.push_back(next[i].base - there[i]);
  }
  const double half_width = cell.curve.half_width;
  step.slew = per_frequency(cell.curve, half_width, next_phase, place.z, -1.0);
  change_basis(next, channels, basis_at(cell, next_phase, place.z),
               per_frequency(curve_of_basis(cell), half_width, next_phase, place.z, 1.0), step);
  return step;
}

}  // namespace veritrack::model

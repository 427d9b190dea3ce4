#include "analysis/model/gain/phase_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/phase_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;
using trackers::Instruction;

namespace {

/// For each register the last value before the exit through which all that it does to the results passes;
/// -1 of a register that does nothing.
std::vector<int> gates_of(const trackers::StraightLineProgram& program) {
  const int registers = program.registers();
  const int exit = registers;
  std::vector<std::vector<int>> users(static_cast<std::size_t>(registers));
  for (const int result : program.results()) {
    users[static_cast<std::size_t>(result)].push_back(exit);
  }
  for (int i = 0; i < registers - program.inputs(); ++i) {
    const Instruction& each = program.instructions()[static_cast<std::size_t>(i)];
    for (const int operand : {each.first, each.second, each.third}) {
      if (operand >= 0) {
        users[static_cast<std::size_t>(operand)].push_back(program.inputs() + i);
      }
    }
  }
  // Immediate post-dominators, from the last register on; users come later.
  std::vector<int> next(static_cast<std::size_t>(registers) + 1, -1);
  next[static_cast<std::size_t>(exit)] = exit;
  for (int r = registers - 1; r >= 0; --r) {
    int common = -1;
    for (int user : users[static_cast<std::size_t>(r)]) {
      if (next[static_cast<std::size_t>(user)] < 0) {
        continue;  // does nothing
      }
      while (common >= 0 && common != user) {
        int& earlier = common < user ? common : user;
        earlier = next[static_cast<std::size_t>(earlier)];
      }
      common = user;
    }
    next[static_cast<std::size_t>(r)] = common;
  }
  std::vector<int> gates(static_cast<std::size_t>(registers), -1);
  for (int r = registers - 1; r >= 0; --r) {
    const int after = next[static_cast<std::size_t>(r)];
    gates[static_cast<std::size_t>(r)] = after == exit ? r
                                         : after < 0   ? -1
                                                       : gates[static_cast<std::size_t>(after)];
  }
  return gates;
}

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
    if (!program.limits().empty()) {
      throw NoFrame("a limit beside the results");
    }
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

std::vector<BallModel> basis_at(const FloquetCell& cell, const BallModel& phase, const BallModel& z) {
  Tube series;
  series.turns.assign(cell.basis.size(), 0);
  series.curve = cell.basis;
  return tube_at(series, phase, z).curve;
}

/// P^-1 applied to vectors, by elimination.
class Inverse {
 public:
  Inverse(std::vector<BallModel> basis, std::size_t n) : n_(n), a_(std::move(basis)) {}

  /// Solves for all right sides at once, in place.
  void solve(const std::vector<std::vector<BallModel>*>& sides) {
    for (std::size_t p = 0; p < n_; ++p) {
      std::size_t pivot = p;
      for (std::size_t i = p + 1; i < n_; ++i) {
        pivot = weight(i, p) > weight(pivot, p) ? i : pivot;
      }
      for (std::size_t j = 0; j < n_; ++j) {
        std::swap(at(p, j), at(pivot, j));
      }
      for (auto* side : sides) {
        std::swap((*side)[p], (*side)[pivot]);
      }
      const BallModel reciprocal = BallModel(1.0) / at(p, p);
      for (std::size_t i = 0; i < n_; ++i) {
        if (i == p) {
          continue;
        }
        const BallModel factor = at(i, p) * reciprocal;
        for (std::size_t j = p; j < n_; ++j) {
          at(i, j) -= factor * at(p, j);
        }
        for (auto* side : sides) {
          (*side)[i] -= factor * (*side)[p];
        }
      }
      for (std::size_t j = p; j < n_; ++j) {
        at(p, j) = at(p, j) * reciprocal;
      }
      for (auto* side : sides) {
        (*side)[p] = (*side)[p] * reciprocal;
      }
    }
  }

 private:
  BallModel& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
  /// How far an entry is from 0, relative to its row: states have units.
  double weight(std::size_t i, std::size_t p) {
    double row = 0.0;
    for (std::size_t j = p; j < n_; ++j) {
      row = std::max(row, std::fabs(at(i, j).constant()));
    }
    const Interval range = at(i, p).range();
    return is_empty(range) ? 0.0 : rigor::mignitude(range) / row;
  }

  std::size_t n_;
  std::vector<BallModel> a_;
};

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

}  // namespace

PhaseStep phase_step(const TrackerModel& tracker, const FloquetCell& cell, const TubeCell& part) {
  const std::size_t n = cell.states();
  const auto channels = static_cast<std::size_t>(tracker.recursion->samples);
  const CellPlace place = place_of(part);
  const BallModel omega = frequency_at(cell.curve, place.z);
  const BallModel next_phase = place.phase + omega;
  const std::vector<BallModel> here = tube_at(cell.curve, place.phase, place.z).curve;
  const std::vector<BallModel> there = tube_at(cell.curve, next_phase, place.z).curve;
  const std::vector<BallModel> basis = basis_at(cell, place.phase, place.z);

  PhaseStep step;
  PhaseRun run(n, channels, step);
  std::vector<PhaseValue> values;
  for (const Interval& constant : tracker.constants) {
    values.push_back(constant_value(constant));
  }
  for (std::size_t i = 0; i < n; ++i) {
    PhaseValue state{here[i], {}};
    for (std::size_t j = 0; j < n; ++j) {
      state.slopes.emplace(static_cast<int>(j), basis[i * n + j]);
    }
    values.push_back(std::move(state));
  }
  std::vector<PhaseValue> error = run.run(tracker.recursion->frequency, values, false);
  const std::vector<BallModel> signal =
      model::run(tracker, *tracker.signal, {BallModel(tracker.amplitude), next_phase});
  for (std::size_t c = 0; c < channels; ++c) {
    values.push_back({signal[c], {{static_cast<int>(n + c), BallModel(1.0)}}});
  }
  std::vector<PhaseValue> next = run.run(tracker.recursion->step, values, true);
  error.front().base -= omega;
  step.bias = error.front().base;
  run.rules().form_of(error.front());

  add_open_remainders(next, n, step);

  // In the basis at the end of the step.
  const auto slopes_by = [&](int key) {
    std::vector<BallModel> column;
    for (const PhaseValue& each : next) {
      const auto found = each.slopes.find(key);
      column.push_back(found == each.slopes.end() ? BallModel(0.0) : found->second);
    }
    return column;
  };
  std::vector<std::vector<BallModel>> by_state;
  for (std::size_t j = 0; j < n; ++j) {
    by_state.push_back(slopes_by(static_cast<int>(j)));
  }
  for (std::size_t i = 0; i < n; ++i) {
    step.residual.push_back(next[i].base - there[i]);
  }
  std::vector<std::vector<BallModel>*> sides{&step.residual};
  for (auto& column : by_state) {
    sides.push_back(&column);
  }
  for (std::size_t c = 0; c < channels; ++c) {
    sides.push_back(&(step.columns[static_cast<int>(c)] = slopes_by(static_cast<int>(n + c))));
  }
  for (const int gate : step.gates) {
    sides.push_back(&(step.columns[gate] = slopes_by(static_cast<int>(n) + gate)));
  }
  Inverse(basis_at(cell, next_phase, place.z), n).solve(sides);
  step.matrix.assign(n, std::vector<BallModel>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      step.matrix[i][j] = by_state[j][i];
    }
  }
  return step;
}

}  // namespace veritrack::model

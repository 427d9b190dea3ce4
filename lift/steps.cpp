#include "lift/steps.hpp"

#include <algorithm>
#include <set>

#include "lift/cell_names.hpp"

namespace veritrack::lift {

namespace {

/// Cells that are followed have to repeat their values after this many steps; those that do not become
/// states.
constexpr std::size_t kMostPositions = 64;
constexpr int kMostBefore = 1000;

}  // namespace

Steps::Steps(Executor& executor, const llvm::Function& setup, const llvm::Function& step,
             const llvm::Function& frequency)
    : executor_(&executor), step_(&step), frequency_(&frequency) {
  executor.construct_globals();
  (void)executor.call(setup, {});
  setup_conditions_ = executor.conditions();
  after_setup_ = memory().contents();
  objects_ = memory().objects();
  for (const llvm::Argument& argument : step.args()) {
    if (!argument.getType()->isFloatTy() && !argument.getType()->isDoubleTy()) {
      throw LiftError("an argument of step that is no number; allowed: one or two of float or double");
    }
    samples_.push_back(graph().input(memory().format_of(argument.getType())));
  }
  if (samples_.empty() || samples_.size() > 2) {
    throw LiftError("step has " + std::to_string(samples_.size()) + " arguments; allowed: one sample or two");
  }
}

Orbit Steps::orbit() {
  std::optional<std::vector<Followed>> values = repeating();
  while (!values) {
    values = repeating();
  }
  values_ = *values;
  Orbit result{samples_, states_, {}, steps_before_};
  for (const Followed& at : values_) {
    result.positions.push_back(position(at));
  }
  return result;
}

Orbit Steps::orbit_of_states() {
  while (values_.size() > 1) {
    for (const auto& [spot, cell] : values_.front()) {
      const bool settles =
          std::all_of(values_.begin(), values_.end(),
                      [&, at = spot, &is = cell](const Followed& each) { return each.at(at) == is; });
      if (!settles) {
        make_state(spot, cell);
      }
    }
    const Orbit found = orbit();
    if (found.positions.size() == 1) {
      return found;
    }
  }
  return orbit();
}

std::string Steps::name_of(Spot spot) {
  return cell_name(memory().object(spot.first), spot.second);
}

/// The values of the followed cells in steps that repeat for ever; nothing where one more cell has to be a
/// state.
std::optional<std::vector<Steps::Followed>> Steps::repeating() {
  std::vector<Followed> values{{}};
  while (values.size() <= kMostPositions) {
    Followed next = values.back();
    const std::size_t known = next.size() + states_.size();
    if (!run_step(values.back(), next)) {
      return std::nullopt;
    }
    if (next.size() + states_.size() != known) {
      values = {next};  // what was found before holds for fewer states
      continue;
    }
    const auto first = std::find(values.begin(), values.end(), next);
    if (first != values.end()) {
      return from_setup({first, values.end()});
    }
    values.push_back(std::move(next));
  }
  follow_less(values);
  return std::nullopt;
}

/// The same values, from the one on that the program comes to first.
std::optional<std::vector<Steps::Followed>> Steps::from_setup(std::vector<Followed> values) {
  Followed at;
  for (const auto& [spot, cell] : values.front()) {
    const Cells& cells = *after_setup_[static_cast<std::size_t>(spot.first)];
    const auto was = cells.find(spot.second);
    const auto* number = cell.value.as<Register>();
    const auto start = number == nullptr ? std::nullopt : start_of(spot, cell.size);
    if (was != cells.end() && was->second.size == cell.size) {
      const auto* old = was->second.value.as<Register>();
      at[spot] =
          number == nullptr || old == nullptr
              ? was->second
              : Cell{cell.size, Register{graph().reinterpreted(old->number, graph().format(number->number))}};
    } else if (start) {
      at[spot] = {cell.size, Register{graph().constant(graph().format(number->number), *start)}};
    }
  }
  for (steps_before_ = 0; steps_before_ < kMostBefore; ++steps_before_) {
    const auto first = std::find(values.begin(), values.end(), at);
    if (first != values.end()) {
      std::rotate(values.begin(), first, values.end());
      return values;
    }
    Followed next = at;
    const std::size_t states = states_.size();
    if (!run_step(at, next) || states_.size() != states) {
      return std::nullopt;
    }
    at = std::move(next);
  }
  throw LiftError("modes do not settle");
}

/// The cell with the most values becomes a state.
void Steps::follow_less(const std::vector<Followed>& values) {
  Spot most;
  std::size_t count = 0;
  for (const auto& [spot, cell] : values.back()) {
    std::vector<Cell> seen;
    for (const Followed& each : values) {
      if (std::find(seen.begin(), seen.end(), each.at(spot)) == seen.end()) {
        seen.push_back(each.at(spot));
      }
    }
    if (seen.size() > count) {
      count = seen.size();
      most = spot;
    }
  }
  make_state(most, values.back().at(most));
}

void Steps::set(const Followed& followed) {
  memory().restore(after_setup_);
  for (const auto& [spot, cell] : followed) {
    memory().put(spot.first, spot.second, cell);
  }
  for (const auto& [spot, state] : states_) {
    memory().put(spot.first, spot.second, {state.bytes, Register{state.input}});
  }
}

/// The cells of objects that setup has left, where a call has changed them.
std::map<Spot, Cell> Steps::changed_by(const llvm::Function& function, const std::vector<Value>& arguments,
                                       Value& result) {
  const Memory::Contents before = memory().contents();
  result = executor_->call(function, arguments);
  std::map<Spot, Cell> changed;
  for (int object = 0; object < objects_; ++object) {
    static const Cells none;
    const auto& old = before[static_cast<std::size_t>(object)];
    if (old == memory().contents()[static_cast<std::size_t>(object)]) {
      continue;
    }
    for (const auto& [offset, cell] : memory().cells(object)) {
      const auto was = old->find(offset);
      if (was == old->end() || !(was->second == cell)) {
        changed[{object, offset}] = cell;
      }
    }
  }
  return changed;
}

std::map<Spot, Cell> Steps::changed_by_step() {
  std::vector<Value> arguments;
  for (const int sample : samples_) {
    arguments.emplace_back(Register{sample});
  }
  Value nothing;
  return changed_by(*step_, arguments, nothing);
}

/// Runs a step; false when a cell that was followed has become a state.
bool Steps::run_step(const Followed& followed, Followed& next) {
  set(followed);
  for (const auto& [spot, cell] : changed_by_step()) {
    if (states_.contains(spot) || cell.value.is_undefined()) {
      continue;  // what is undefined may be what it was
    }
    if (is_followed(cell.value)) {
      next[spot] = cell;
      continue;
    }
    make_state(spot, cell);
    if (followed.contains(spot)) {
      return false;
    }
  }
  require_whole(next);
  return true;
}

/// Whether no sample is below a value.
bool Steps::is_followed(const Value& value) {
  if (const auto* number = value.as<Register>()) {
    return graph().is_free_of_inputs(number->number);
  }
  const auto* address = value.as<Address>();
  return (address != nullptr && address->index < 0) || value.as<FunctionAddress>() != nullptr;
}

void Steps::make_state(Spot spot, const Cell& cell) {
  const auto* number = cell.value.as<Register>();
  if (number == nullptr) {
    throw LiftError("the pointer " + name_of(spot) +
                    " changes from step to step; allowed: pointers that setup has set, or that take at most "
                    "64 values one after the other");
  }
  StateCell state;
  state.bytes = cell.size;
  state.start = start_of(spot, cell.size);
  const auto [known, is_new] = inputs_.try_emplace(spot, -1);
  if (is_new) {
    known->second = graph().input(graph().format(number->number));
  }
  state.input = known->second;
  states_[spot] = state;
}

std::optional<std::uint64_t> Steps::start_of(Spot spot, std::int64_t bytes) {
  const auto& cells = *after_setup_[static_cast<std::size_t>(spot.first)];
  const auto cell = cells.find(spot.second);
  if (cell != cells.end() && cell->second.size == bytes) {
    const auto* number = cell->second.value.as<Register>();
    const bool is_known = number != nullptr && graph().is_free_of_inputs(number->number);
    return is_known ? std::optional(graph().computed_here(number->number)) : std::nullopt;
  }
  for (std::int64_t at = spot.second; at < spot.second + bytes; ++at) {
    const auto behind = cells.upper_bound(at);
    if (behind == cells.begin() || std::prev(behind)->first + std::prev(behind)->second.size <= at) {
      return std::nullopt;  // setup has not set this byte
    }
  }
  return memory().known_bits(cells, spot.second, bytes);
}

/// Cells that are kept from step to step are written as a whole.
void Steps::require_whole(const Followed& followed) {
  const auto require = [&](Spot spot, std::int64_t bytes) {
    const Cells& cells = memory().cells(spot.first);
    const auto cell = cells.find(spot.second);
    if (cell == cells.end() || cell->second.size != bytes) {
      throw LiftError("memory is used in pieces of two sizes in " + name_of(spot));
    }
  };
  for (const auto& [spot, state] : states_) {
    require(spot, state.bytes);
  }
  for (const auto& [spot, cell] : followed) {
    if (!states_.contains(spot)) {
      require(spot, cell.size);
    }
  }
}

Position Steps::position(const Followed& followed) {
  Position result;
  result.conditions = setup_conditions_;
  executor_->conditions().clear();
  set(followed);
  Value estimate;
  if (const auto changed = changed_by(*frequency_, {}, estimate); !changed.empty()) {
    throw LiftError("frequency changes " + name_of(changed.begin()->first) +
                    "; allowed: a function that only reads");
  }
  const auto* number = estimate.as<Register>();
  if (number == nullptr || !graph().format(number->number).is_float) {
    throw LiftError(
        "frequency returns no number that is defined; allowed: float frequency(void), in rad/sample");
  }
  result.frequency = number->number;
  set(followed);
  (void)changed_by_step();
  for (const auto& [spot, state] : states_) {
    const auto* next = memory().cells(spot.first).at(spot.second).value.as<Register>();
    result.next[spot] =
        next == nullptr ? -1 : graph().reinterpreted(next->number, graph().format(state.input));
  }
  const std::vector<Condition>& more = executor_->conditions();
  result.conditions.insert(result.conditions.end(), more.begin(), more.end());
  return result;
}

}  // namespace veritrack::lift

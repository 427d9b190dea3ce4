#include "lift/lifted.hpp"

#include <llvm/IR/DebugInfoMetadata.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lift/cell_names.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::Listing;

/// Modes that are set in the first steps have settled after this many.
constexpr int kMostSettling = 64;

/// An object and an offset.
using Place2 = std::pair<int, std::int64_t>;

/// The function of a harness, by the name that the source gives it.
const llvm::Function& function_called(const llvm::Module& module, const std::string& name) {
  for (const llvm::Function& function : module) {
    const llvm::DISubprogram* source = function.getSubprogram();
    const bool is_it = function.getName() == name ||
                       (source != nullptr && source->getName() == name &&
                        (source->getScope() == nullptr || llvm::isa<llvm::DIFile>(source->getScope())));
    if (is_it && !function.isDeclaration()) {
      return function;
    }
  }
  throw LiftError("no function is called " + name +
                  "; allowed: files that define setup, step and frequency, e.g. " +
                  "void setup(void) {...}  void step(float y) {...}  float frequency(void) {...}");
}

class Search {
 public:
  explicit Search(Executor& executor)
      : executor_(&executor),
        step_(&function_called(executor.module(), "step")),
        frequency_(&function_called(executor.module(), "frequency")) {
    executor.construct_globals();
    (void)executor.call(function_called(executor.module(), "setup"), {});
    base_ = executor.memory().contents();
    objects_ = executor.memory().objects();
    for (const llvm::Argument& argument : step_->args()) {
      if (!argument.getType()->isFloatTy() && !argument.getType()->isDoubleTy()) {
        throw LiftError("an argument of step that is no number; allowed: one or two of float or double");
      }
      samples_.push_back(executor.graph().input(executor.memory().format_of(argument.getType())));
    }
    if (samples_.empty() || samples_.size() > 2) {
      throw LiftError("step has " + std::to_string(samples_.size()) +
                      " arguments; allowed: one sample or two");
    }
  }

  [[nodiscard]] Listing found() {
    while (grows()) {
    }
    return listing();
  }

 private:
  struct Found {
    int input = -1;
    int next = -1;
    std::uint64_t start = 0;
  };

  [[nodiscard]] Graph& graph() { return executor_->graph(); }
  [[nodiscard]] Memory& memory() { return executor_->memory(); }

  void set_states() {
    memory().restore(base_);
    for (const auto& [place, state] : states_) {
      const Cells& cells = memory().cells(place.first);
      const auto cell = cells.find(place.second);
      memory().put(place.first, place.second, {cell->second.size, Register{state.input}});
    }
  }

  /// Runs a step; true when it changes a cell that is no state yet.
  [[nodiscard]] bool grows() {
    executor_->conditions().clear();
    set_states();
    for (auto& [place, state] : states_) {
      state.next = state.input;  // unless the step changes it
    }
    std::vector<Value> arguments;
    for (const int sample : samples_) {
      arguments.emplace_back(Register{sample});
    }
    const Memory::Contents before = memory().contents();
    (void)executor_->call(*step_, arguments);
    const Memory::Contents after = memory().contents();
    bool has_grown = false;
    for (int object = 0; object < objects_; ++object) {
      for (const auto& [offset, cell] : *after[static_cast<std::size_t>(object)]) {
        const Cells& old = *before[static_cast<std::size_t>(object)];
        const auto was = old.find(offset);
        if (was == old.end() || was->second == cell) {
          continue;
        }
        has_grown = take({object, offset}, was->second, cell) || has_grown;
      }
    }
    return has_grown;
  }

  /// A cell that the step has changed; true when it becomes a state, or settles.
  [[nodiscard]] bool take(Place2 place, const Cell& was, const Cell& is) {
    const auto known = states_.find(place);
    const auto* next = is.value.as<Register>();
    if (known != states_.end()) {
      if (next == nullptr) {
        throw LiftError(name_of(place) + " is not defined after a step");
      }
      known->second.next = next->number;
      return false;
    }
    const auto* old = was.value.as<Register>();
    if (next == nullptr || old == nullptr) {
      if (is.value.is_undefined()) {
        return false;
      }
      throw LiftError("the pointer " + cell_name(memory().object(place.first), place.second) +
                      " changes from step to step; allowed: pointers that setup has set");
    }
    const bool is_mode = !graph().format(next->number).is_float && graph().is_known(next->number);
    if (is_mode && ++settling_[place] <= kMostSettling) {
      memory().restore(base_);
      memory().put(place.first, place.second, is);
      base_ = memory().contents();
      return true;
    }
    if (was.size != is.size) {
      throw LiftError("memory is read in pieces of two sizes in " + memory().object(place.first).name);
    }
    std::uint64_t start = 0;
    if (graph().is_free_of_inputs(old->number)) {
      start = graph().computed_here(old->number);
    }
    Found state;
    state.input = graph().input(graph().format(next->number));
    state.start = start;
    states_[place] = state;
    return true;
  }

  /// What the registers need: a mark for each.
  void mark(int value, std::vector<bool>& marked) {
    if (value < 0 || marked[static_cast<std::size_t>(value)]) {
      return;
    }
    marked[static_cast<std::size_t>(value)] = true;
    for (const int operand : graph().at(value).operands) {
      mark(operand, marked);
    }
  }

  [[nodiscard]] std::string name_of(Place2 place) {
    return cell_name(memory().object(place.first), place.second);
  }

  [[nodiscard]] Listing listing() {
    std::vector<Condition> conditions = executor_->conditions();
    executor_->conditions().clear();
    set_states();
    const Value estimate = executor_->call(*frequency_, {});
    const auto* frequency = estimate.as<Register>();
    if (frequency == nullptr || !graph().format(frequency->number).is_float) {
      throw LiftError(
          "frequency returns no number that is defined; allowed: float frequency(void), in rad/sample");
    }
    conditions.insert(conditions.end(), executor_->conditions().begin(), executor_->conditions().end());
    std::vector<bool> marked(graph().size(), false);
    mark(frequency->number, marked);
    for (const Condition& condition : conditions) {
      mark(condition.must_be_zero, marked);
    }
    bool grows = true;
    std::set<Place2> needed;
    while (grows) {
      grows = false;
      for (const auto& [place, state] : states_) {
        if (marked[static_cast<std::size_t>(state.input)] && needed.insert(place).second) {
          mark(state.next, marked);
          grows = true;
        }
      }
    }
    for (const int sample : samples_) {
      marked[static_cast<std::size_t>(sample)] = true;
    }
    return written(frequency->number, conditions, marked, needed);
  }

  [[nodiscard]] Listing written(int frequency, const std::vector<Condition>& conditions,
                                const std::vector<bool>& marked, const std::set<Place2>& needed) {
    Listing listing;
    listing.files = executor_->files();
    listing.tables = graph().tables();
    std::map<int, int> number{{-1, -1}};
    for (std::size_t value = 0; value < marked.size(); ++value) {
      if (!marked[value]) {
        continue;
      }
      Instruction instruction = graph().at(static_cast<int>(value));
      for (int& operand : instruction.operands) {
        operand = number.at(operand);
      }
      if (instruction.operation == Operation::input) {
        instruction.bits = 0;
      }
      number[static_cast<int>(value)] = static_cast<int>(listing.instructions.size());
      listing.instructions.push_back(instruction);
    }
    for (const llvm::Argument& argument : step_->args()) {
      const std::string name = argument.getName().str();
      listing.sample_names.push_back(name.empty() ? "y" + std::to_string(argument.getArgNo() + 1) : name);
      listing.samples.push_back(number.at(samples_[argument.getArgNo()]));
    }
    for (const auto& [place, state] : states_) {
      if (needed.contains(place)) {
        listing.states.push_back(
            {name_of(place), number.at(state.input), number.at(state.next), state.start});
      }
    }
    listing.frequency = number.at(frequency);
    for (const Condition& condition : conditions) {
      listing.obligations.push_back({number.at(condition.must_be_zero), condition.why, condition.place});
    }
    if (listing.states.empty()) {
      throw LiftError("the frequency does not depend on anything that step changes");
    }
    return listing;
  }

  Executor* executor_;
  const llvm::Function* step_;
  const llvm::Function* frequency_;
  Memory::Contents base_;  ///< after setup
  int objects_ = 0;        ///< that are there after setup
  std::vector<int> samples_;
  std::map<Place2, Found> states_;
  std::map<Place2, int> settling_;
};

}  // namespace

Listing lifted(Executor& executor) {
  return Search(executor).found();
}

}  // namespace veritrack::lift

#include "lift/lifted.hpp"

#include <llvm/IR/DebugInfoMetadata.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lift/cell_names.hpp"
#include "lift/obligations.hpp"
#include "lift/renaming.hpp"
#include "lift/steps.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::Listing;

/// The function of a harness, by the name that the source gives it; one that other files see comes first.
const llvm::Function& function_called(const llvm::Module& module, const std::string& name) {
  std::vector<const llvm::Function*> found;
  for (const llvm::Function& function : module) {
    const llvm::DISubprogram* source = function.getSubprogram();
    const bool is_it = function.getName() == name ||
                       (source != nullptr && source->getName() == name &&
                        (source->getScope() == nullptr || llvm::isa<llvm::DIFile>(source->getScope())));
    if (is_it && !function.isDeclaration()) {
      found.push_back(&function);
    }
  }
  const auto hidden = std::stable_partition(
      found.begin(), found.end(), [](const llvm::Function* each) { return !each->hasLocalLinkage(); });
  if (found.empty()) {
    throw LiftError("no function is called " + name +
                    "; allowed: files that define setup, step and frequency, e.g. " +
                    "void setup(void) {...}  void step(float y) {...}  float frequency(void) {...}");
  }
  if (hidden - found.begin() > 1 || (hidden == found.begin() && found.size() > 1)) {
    throw LiftError("several functions are called " + name + "; allowed: one");
  }
  return *found.front();
}

/// The name without its last index: ring.past of ring.past_3.
std::string without_index(const std::string& name) {
  for (std::size_t at = name.rfind('_'); at != std::string::npos && at > 0; at = name.rfind('_', at - 1)) {
    const std::size_t end = std::min(name.find('.', at), name.size());
    const bool is_index =
        end > at + 1 && std::all_of(name.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                    name.begin() + static_cast<std::ptrdiff_t>(end),
                                    [](char letter) { return letter >= '0' && letter <= '9'; });
    if (is_index) {
      return name.substr(0, at) + name.substr(end);
    }
  }
  return name;
}

/// A state of the listing: its cell before the first position, and the one after its step.
struct Named {
  Spot before, after;
  std::string name;
};

class Writer {
 public:
  Writer(Executor& executor, const llvm::Function& step, const Orbit& orbit)
      : executor_(&executor), step_(&step), orbit_(&orbit) {
    const std::size_t count = orbit.positions.size();
    needed_ = needed_states(executor, orbit);
    std::vector<std::vector<Required>> required;
    for (std::size_t p = 0; p < count; ++p) {
      required.push_back(obligations_of(executor.graph(), orbit.positions[p], needed_[(p + 1) % count]));
    }
    std::map<Spot, Spot> names;
    if (count > 1) {
      names = renamings(executor, orbit, needed_, required).front();
    }
    required_ = required.front();
    for (const Spot& spot : needed_.front()) {
      states_.push_back({spot, count > 1 ? names.at(spot) : spot, ""});
      states_.back().name = name_of(states_.back());
    }
    if (states_.empty()) {
      throw LiftError("the frequency does not depend on anything that step changes");
    }
  }

  [[nodiscard]] Listing written() {
    const Position& position = orbit_->positions.front();
    std::vector<int> roots = orbit_->samples;
    roots.push_back(position.frequency);
    for (const Named& state : states_) {
      roots.push_back(orbit_->states.at(state.before).input);
      roots.push_back(position.next.at(state.after));
    }
    for (const Required& required : required_) {
      roots.push_back(required.must_be_zero);
    }
    write_operations(needed_by(executor_->graph(), roots));
    write_inputs();
    for (const Named& state : states_) {
      const StateCell& cell = orbit_->states.at(state.before);
      if (!cell.start) {
        throw LiftError(state.name + " is read before anything has set it; allowed: all states set in setup");
      }
      listing_.states.push_back(
          {state.name, number_.at(cell.input), number_.at(position.next.at(state.after)), *cell.start});
    }
    listing_.frequency = number_.at(position.frequency);
    for (const Required& required : required_) {
      listing_.obligations.push_back(
          {number_.at(required.must_be_zero), required.condition->why, required.condition->place});
    }
    listing_.files = executor_->files();
    listing_.steps_before = orbit_->steps_before;
    return std::move(listing_);
  }

 private:
  /// The cell's name; that of a value which moves through a ring has its age.
  [[nodiscard]] std::string name_of(const Named& state) {
    const std::string cell = cell_name(executor_->memory().object(state.before.first), state.before.second);
    const int age = state.before == state.after ? 0 : age_of(*orbit_, state.before);
    const std::string name = without_index(cell) + "_" + std::to_string(age) + "_ago";
    if (age > 0 && taken_.insert(name).second) {
      return name;
    }
    std::string free = cell;
    for (int i = 2; !taken_.insert(free).second; ++i) {  // static variables of several functions
      free = cell + "_" + std::to_string(i);
    }
    return free;
  }

  void write_operations(const std::vector<bool>& needed) {
    const Graph& graph = executor_->graph();
    std::map<int, int> tables;
    for (std::size_t value = 0; value < needed.size(); ++value) {
      if (!needed[value]) {
        continue;
      }
      Instruction instruction = graph.at(static_cast<int>(value));
      for (int& operand : instruction.operands) {
        operand = number_.at(operand);
      }
      if (instruction.operation == Operation::input) {
        instruction.bits = 0;
      }
      if (instruction.table >= 0) {
        const auto [table, is_new] =
            tables.try_emplace(instruction.table, static_cast<int>(listing_.tables.size()));
        if (is_new) {
          listing_.tables.push_back(graph.tables()[static_cast<std::size_t>(instruction.table)]);
          if (graph.tables_of_library().contains(instruction.table)) {
            listing_.library_tables.push_back(table->second);
          }
        }
        instruction.table = table->second;
      }
      number_[static_cast<int>(value)] = static_cast<int>(listing_.instructions.size());
      listing_.instructions.push_back(instruction);
    }
  }

  void write_inputs() {
    for (const llvm::Argument& argument : step_->args()) {
      const std::string name = argument.getName().str();
      listing_.sample_names.push_back(name.empty() ? "y" + std::to_string(argument.getArgNo() + 1) : name);
      listing_.samples.push_back(number_.at(orbit_->samples[argument.getArgNo()]));
    }
  }

  Executor* executor_;
  const llvm::Function* step_;
  const Orbit* orbit_;
  std::vector<std::set<Spot>> needed_;
  std::vector<Required> required_;
  std::vector<Named> states_;
  std::set<std::string> taken_;
  std::map<int, int> number_{{-1, -1}};
  Listing listing_;
};

}  // namespace

Listing lifted(Executor& executor) {
  const llvm::Function& setup = function_called(executor.module(), "setup");
  const llvm::Function& step = function_called(executor.module(), "step");
  const llvm::Function& frequency = function_called(executor.module(), "frequency");
  Steps steps(executor, setup, step, frequency);
  const Orbit orbit = steps.orbit();
  try {
    return Writer(executor, step, orbit).written();
  } catch (const StepsDiffer& error) {
    const std::string text = error.what();
    try {
      const Orbit without = steps.orbit_of_states();
      return Writer(executor, step, without).written();
    } catch (const LiftError&) {
      throw LiftError(text);  // e.g. an index cannot be a state
    }
  }
}

}  // namespace veritrack::lift

// The steps of a program from `setup` on, until they repeat: which cells are states, and what a step makes of
// them.
#pragma once

#include <llvm/IR/Function.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lift/executor.hpp"
#include "lift/memory.hpp"

namespace veritrack::lift {

/// A place in memory: an object and an offset.
using Spot = std::pair<int, std::int64_t>;

/// A cell that holds a number which depends on the samples.
struct StateCell {
  int input = -1;  ///< the register that holds it before a step
  std::int64_t bytes = 0;
  std::optional<std::uint64_t> start;  ///< after `setup`, where that is defined
};

/// A step with certain values of the cells that are followed.
struct Position {
  std::map<Spot, int> next;  ///< the registers of the states after the step; -1: undefined
  int frequency = -1;        ///< of the states before the step
  std::vector<Condition> conditions;
};

/// What does not depend on the samples (modes, indices of rings, counters, gains that settle) is followed;
/// its values repeat after the last position.
struct Orbit {
  std::vector<int> samples;
  std::map<Spot, StateCell> states;
  std::vector<Position> positions;
  int steps_before = 0;  ///< the first steps, which are not among the positions
};

/// Runs a program with symbols. All functions throw LiftError.
class Steps {
 public:
  Steps(Executor& executor, const llvm::Function& setup, const llvm::Function& step,
        const llvm::Function& frequency);

  [[nodiscard]] Orbit orbit();
  /// The cells that have been followed and do not settle become states: then there is one position.
  [[nodiscard]] Orbit orbit_of_states();

 private:
  using Followed = std::map<Spot, Cell>;

  [[nodiscard]] Graph& graph() { return executor_->graph(); }
  [[nodiscard]] Memory& memory() { return executor_->memory(); }
  [[nodiscard]] std::string name_of(Spot spot);
  [[nodiscard]] std::optional<std::vector<Followed>> repeating();
  [[nodiscard]] std::optional<std::vector<Followed>> from_setup(std::vector<Followed> values);
  void follow_less(const std::vector<Followed>& values);
  void set(const Followed& followed);
  [[nodiscard]] std::map<Spot, Cell> changed_by(const llvm::Function& function,
                                                const std::vector<Value>& arguments, Value& result);
  [[nodiscard]] std::map<Spot, Cell> changed_by_step();
  [[nodiscard]] bool run_step(const Followed& followed, Followed& next);
  [[nodiscard]] bool is_followed(const Value& value);
  void make_state(Spot spot, const Cell& cell);
  [[nodiscard]] std::optional<std::uint64_t> start_of(Spot spot, std::int64_t bytes);
  void require_whole(const Followed& followed);
  [[nodiscard]] Position position(const Followed& followed);

  Executor* executor_;
  const llvm::Function* step_;
  const llvm::Function* frequency_;
  Memory::Contents after_setup_;
  std::vector<Condition> setup_conditions_;
  int objects_ = 0;  ///< that are there after setup
  std::vector<int> samples_;
  std::map<Spot, StateCell> states_;
  std::map<Spot, int> inputs_;
  std::vector<Followed> values_;  ///< of the last orbit
  int steps_before_ = 0;
};

}  // namespace veritrack::lift

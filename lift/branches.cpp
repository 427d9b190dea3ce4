// Where ways part, and where they meet.
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>

#include <algorithm>
#include <utility>

#include "lift/executor.hpp"

namespace veritrack::lift {

namespace {

/// How often a loop whose condition depends on the state is followed; then it has to have ended.
constexpr int kTurns = 2;
/// The same for a loop that also ends by itself, e.g. a search in a table.
constexpr int kTurnsOfKnown = 64;

}  // namespace

const Executor::Shape& Executor::shape_of(const llvm::Function& function) {
  const auto [place, is_new] = shapes_.try_emplace(&function);
  Shape& shape = place->second;
  if (!is_new) {
    return shape;
  }
  // The analysis wants a function that it may change, and does not change it.
  const llvm::PostDominatorTree tree(
      const_cast<llvm::Function&>(function));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  llvm::DominatorTree dominators(
      const_cast<llvm::Function&>(function));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const llvm::LoopInfo loops(dominators);
  for (const llvm::BasicBlock& block : function) {
    const auto* node = tree.getNode(&block);
    const auto* above = node == nullptr ? nullptr : node->getIDom();
    shape.meets[&block] = above == nullptr ? nullptr : above->getBlock();
    if (const llvm::Loop* loop = loops.getLoopFor(&block)) {
      shape.loop[&block].insert(loop->block_begin(), loop->block_end());
    }
    std::set<const llvm::BasicBlock*>& seen = shape.reaches[&block];
    std::vector<const llvm::BasicBlock*> open{&block};
    while (!open.empty()) {
      const llvm::BasicBlock* from = open.back();
      open.pop_back();
      for (const llvm::BasicBlock* next : llvm::successors(from)) {
        if (seen.insert(next).second) {
          open.push_back(next);
        }
      }
    }
  }
  return shape;
}

void Executor::require_zero(int condition, const std::string& why, int of) {
  int all = condition;
  for (const int step : path_) {
    all = graph_.both(all, step);
  }
  if (!graph_.is_known(all) || graph_.bits(all) != 0) {
    // A known value may be used where no operation is left.
    const bool is_known = of >= 0 && graph_.is_known(of);
    conditions_.push_back({condition, path_, is_known ? -1 : of, why, graph_.place()});
  }
}

/// The values of a block that depend on where it is entered from.
void Executor::enter(Frame& frame, const llvm::BasicBlock& block, const llvm::BasicBlock& from) {
  std::vector<std::pair<const llvm::PHINode*, Value>> entered;
  for (const llvm::PHINode& phi : block.phis()) {
    entered.emplace_back(&phi, operand(frame, phi.getIncomingValueForBlock(&from)));
  }
  for (auto& [phi, value] : entered) {
    frame.values[phi] = std::move(value);
  }
}

/// What a condition without inputs is: of known numbers, or of results of the library, by the library of this
/// machine, with the condition to be shown.
std::optional<bool> Executor::decided(int condition) {
  if (graph_.is_known(condition)) {
    return graph_.bits(condition) != 0;
  }
  if (!graph_.is_free_of_inputs(condition)) {
    return std::nullopt;
  }
  const bool holds = graph_.computed_here(condition) != 0;
  require_zero(holds ? graph_.negated(condition) : condition,
               "a comparison of results of the library in the set-up");
  return holds;
}

/// The arms that the program may take; the last one has no condition.
std::vector<Executor::Arm> Executor::undecided(const std::vector<Arm>& arms) {
  std::vector<Arm> open;
  for (Arm arm : arms) {
    const std::optional<bool> holds = arm.condition < 0 ? true : decided(arm.condition);
    if (holds && !*holds) {
      continue;
    }
    arm.condition = holds ? -1 : arm.condition;
    open.push_back(arm);
    if (holds) {
      break;
    }
  }
  const auto is_last = [&](const Arm& arm) { return arm.target == open.back().target; };
  return std::all_of(open.begin(), open.end(), is_last) ? std::vector<Arm>{{-1, open.back().target}} : open;
}

const llvm::BasicBlock* Executor::leave_loop(Frame& frame, const std::vector<Arm>& arms,
                                             const llvm::BasicBlock* block) {
  if (arms.size() != 2) {
    throw LiftError("a switch on the state decides whether a loop ends; allowed: if");
  }
  const llvm::BasicBlock* yes = arms[0].target;
  const llvm::BasicBlock* no = arms[1].target;
  const Shape& shape = shape_of(*frame.function);
  const auto goes_on = [&](const llvm::BasicBlock* from) {
    return from == block || shape.reaches.at(from).contains(block);
  };
  const bool leaves_by_no = goes_on(yes) && (!goes_on(no) || no == shape.meets.at(block));
  require_zero(leaves_by_no ? arms[0].condition : graph_.negated(arms[0].condition), "a loop has ended");
  return leaves_by_no ? no : yes;
}

/// Whether a branch on the state has kept the program in a loop for long enough.
bool Executor::has_to_leave(const Frame& frame, const llvm::BasicBlock* block) {
  const Shape& shape = shape_of(*frame.function);
  const auto visits = frame.visits.find(block);
  if (visits == frame.visits.end() || !shape.reaches.at(block).contains(block)) {
    return false;
  }
  const auto loop = shape.loop.find(block);
  const bool ends_by_itself =
      loop != shape.loop.end() &&
      std::any_of(frame.known_exits.begin(), frame.known_exits.end(), [&](const llvm::BasicBlock* exit) {
        const auto successors = llvm::successors(exit);
        return loop->second.contains(exit) &&
               std::any_of(successors.begin(), successors.end(),
                           [&](const auto* to) { return !loop->second.contains(to); });
      });
  return visits->second >= (ends_by_itself ? kTurnsOfKnown : kTurns);
}

/// One way, to where all meet.
Executor::Way Executor::follow(Frame& frame, const llvm::BasicBlock& from, const llvm::BasicBlock& target) {
  enter(frame, target, from);
  const Ended ended = run(frame, &target, shape_of(*frame.function).meets.at(&from));
  if (ended == Ended::dead) {
    require_zero(graph_.bit(true), "the program does not end here");
  }
  return {ended, frame.values, memory_.contents(), frame.result};
}

Executor::Way Executor::follow_arms(Frame& frame, const llvm::BasicBlock& from, llvm::ArrayRef<Arm> arms) {
  if (arms.size() == 1) {
    return follow(frame, from, *arms.front().target);
  }
  const Frame before = frame;
  const Memory::Contents contents = memory_.contents();
  const int condition = arms.front().condition;
  path_.push_back(condition);
  Way yes = follow(frame, from, *arms.front().target);
  path_.back() = graph_.negated(condition);
  frame = before;
  memory_.restore(contents);
  Way no = follow_arms(frame, from, arms.drop_front());
  path_.pop_back();
  return merged(condition, std::move(yes), std::move(no));
}

Executor::Way Executor::merged(int condition, Way yes, Way no) {
  if (yes.ended == Ended::dead || no.ended == Ended::dead) {
    return yes.ended == Ended::dead ? no : yes;
  }
  if (yes.ended != no.ended) {
    throw LiftError("one way returns and the other does not");
  }
  for (const auto& [name, value] : yes.values) {
    const auto other = no.values.find(name);
    if (other != no.values.end()) {
      other->second = memory_.select(condition, value, other->second);
    }
  }
  memory_.merge(condition, yes.contents, no.contents);
  no.contents = memory_.contents();
  if (yes.result && no.result) {
    no.result = memory_.select(condition, *yes.result, *no.result);
  }
  return no;
}

/// All ways from a condition on the state, to where they meet; `block` is then where it goes on. A result
/// where that is not in this function, or all ways have ended.
std::optional<Executor::Ended> Executor::branch(Frame& frame, const std::vector<Arm>& arms,
                                                const llvm::BasicBlock*& block) {
  const auto visits = frame.visits;
  ++frame.visits[block];
  Way way = follow_arms(frame, *block, arms);
  frame.visits = visits;
  frame.values = std::move(way.values);
  frame.result = std::move(way.result);
  memory_.restore(std::move(way.contents));
  if (way.ended != Ended::at_stop) {
    return way.ended;
  }
  block = shape_of(*frame.function).meets.at(block);
  return block == nullptr ? std::optional(Ended::returned) : std::nullopt;
}

/// Follows blocks until `stop` is entered (its values known), or the function's end where that is null.
Executor::Ended Executor::run(Frame& frame, const llvm::BasicBlock* block, const llvm::BasicBlock* stop) {
  while (block != stop) {
    std::optional<Step> step;
    for (auto instruction = block->getFirstNonPHI()->getIterator(); !step; ++instruction) {
      step = execute(frame, *instruction);
    }
    if (step->kind != Step::Kind::goes_on) {
      return step->kind == Step::Kind::returned ? Ended::returned : Ended::dead;
    }
    const std::vector<Arm> arms = undecided(step->arms);
    const llvm::BasicBlock* next = arms.front().target;
    if (arms.size() == 1 && step->arms.size() > 1) {
      frame.known_exits.insert(block);
    }
    if (arms.size() > 1) {
      if (has_to_leave(frame, block)) {
        next = leave_loop(frame, arms, block);
      } else {
        if (const auto ended = branch(frame, arms, block)) {
          return *ended;
        }
        continue;
      }
    }
    enter(frame, *next, *block);
    block = next;
  }
  return Ended::at_stop;
}

}  // namespace veritrack::lift

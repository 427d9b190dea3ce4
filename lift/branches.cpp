// Where ways part, and where they meet.
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>

#include <utility>

#include "lift/executor.hpp"

namespace veritrack::lift {

namespace {

/// How often a loop whose condition depends on the state is followed; then it has to have ended.
constexpr int kTurns = 2;

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
  for (const llvm::BasicBlock& block : function) {
    const auto* node = tree.getNode(&block);
    const auto* above = node == nullptr ? nullptr : node->getIDom();
    shape.meets[&block] = above == nullptr ? nullptr : above->getBlock();
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

void Executor::require_zero(int condition, const std::string& why) {
  int all = condition;
  for (const int step : path_) {
    all = graph_.both(all, step);
  }
  if (!graph_.is_known(all) || graph_.bits(all) != 0) {
    conditions_.push_back({all, why, graph_.place()});
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

const llvm::BasicBlock* Executor::leave_loop(Frame& frame, const Step& step, const llvm::BasicBlock* block) {
  const Shape& shape = shape_of(*frame.function);
  const auto goes_on = [&](const llvm::BasicBlock* from) {
    return from == block || shape.reaches.at(from).contains(block);
  };
  const bool leaves_by_no = goes_on(step.yes) && (!goes_on(step.no) || step.no == shape.meets.at(block));
  require_zero(leaves_by_no ? step.condition : graph_.negated(step.condition), "a loop has ended");
  return leaves_by_no ? step.no : step.yes;
}

/// Both ways from a condition on the state, to where they meet; `block` is then where it goes on. A result
/// where that is not in this function, or all ways have ended.
std::optional<Executor::Ended> Executor::branch(Frame& frame, const Step& step,
                                                const llvm::BasicBlock*& block) {
  const llvm::BasicBlock* meeting = shape_of(*frame.function).meets.at(block);
  struct Way {
    Ended ended = Ended::dead;
    Environment values;
    Memory::Contents contents;
    std::optional<Value> result;
  };
  const Environment values = frame.values;
  const Memory::Contents contents = memory_.contents();
  const std::optional<Value> result = frame.result;
  const auto visits = frame.visits;
  const auto follow = [&](int condition, const llvm::BasicBlock* target) {
    frame.values = values;
    frame.result = result;
    frame.visits = visits;
    ++frame.visits[block];
    memory_.restore(contents);
    path_.push_back(condition);
    enter(frame, *target, *block);
    Way way;
    way.ended = run(frame, target, meeting);
    if (way.ended == Ended::dead) {
      require_zero(graph_.bit(true), "the program does not end here");
    }
    path_.pop_back();
    way.values = frame.values;
    way.contents = memory_.contents();
    way.result = frame.result;
    return way;
  };
  const Way yes = follow(step.condition, step.yes);
  const Way no = follow(graph_.negated(step.condition), step.no);
  frame.visits = visits;
  const auto take = [&](const Way& way) {
    frame.values = way.values;
    frame.result = way.result;
    memory_.restore(way.contents);
  };
  if (yes.ended == Ended::dead || no.ended == Ended::dead) {
    const Way& other = yes.ended == Ended::dead ? no : yes;
    take(other);
    if (other.ended != Ended::at_stop) {
      return other.ended;
    }
  } else if (yes.ended != no.ended) {
    throw LiftError("one way returns and the other does not");
  } else {
    for (const auto& [name, value] : yes.values) {
      const auto other = no.values.find(name);
      if (other != no.values.end()) {
        frame.values[name] = memory_.select(step.condition, value, other->second);
      }
    }
    memory_.merge(step.condition, yes.contents, no.contents);
    if (yes.result && no.result) {
      frame.result = memory_.select(step.condition, *yes.result, *no.result);
    }
    if (yes.ended == Ended::returned) {
      return Ended::returned;
    }
  }
  if (meeting == nullptr) {
    return Ended::returned;
  }
  block = meeting;
  return std::nullopt;
}

/// Follows blocks until `stop` is entered (its values known), or the function's end where that is null.
Executor::Ended Executor::run(Frame& frame, const llvm::BasicBlock* block, const llvm::BasicBlock* stop) {
  while (block != stop) {
    std::optional<Step> step;
    for (auto instruction = block->getFirstNonPHI()->getIterator(); !step; ++instruction) {
      step = execute(frame, *instruction);
    }
    if (step->kind == Step::Kind::returned) {
      return Ended::returned;
    }
    if (step->kind == Step::Kind::dead) {
      return Ended::dead;
    }
    const llvm::BasicBlock* next = step->yes;
    if (step->kind == Step::Kind::branch && step->yes != step->no) {
      const std::optional<bool> holds = decided(step->condition);
      const bool is_in_loop = shape_of(*frame.function).reaches.at(block).contains(block);
      if (holds) {
        next = *holds ? step->yes : step->no;
      } else if (is_in_loop && frame.visits[block] >= kTurns) {
        next = leave_loop(frame, *step, block);
      } else {
        if (const auto ended = branch(frame, *step, block)) {
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

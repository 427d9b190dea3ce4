// Execution of LLVM IR with symbols: conditions that are known are followed, those that depend on the state
// are followed on both ways, which meet again with `select`.
#pragma once

#include <llvm/ADT/DenseMap.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lift/graph.hpp"
#include "lift/memory.hpp"
#include "lift/value.hpp"

namespace veritrack::lift {

/// What has to be 0 for the listing to say what the program does, wherever the bits of `path` are 1.
struct Condition {
  int must_be_zero = -1;
  std::vector<int> path;
  int of = -1;  ///< the register whose value is undefined otherwise; -1: the program must not get there
  std::string why;
  Place place;
};

class Executor {
 public:
  /// Globals are there with their first values.
  explicit Executor(const llvm::Module& module);

  /// The result of a function that is defined in the module; nothing for `void`. Throws LiftError.
  Value call(const llvm::Function& function, const std::vector<Value>& arguments);
  /// Runs the constructors of globals.
  void construct_globals();

  [[nodiscard]] Graph& graph() { return graph_; }
  [[nodiscard]] Memory& memory() { return memory_; }
  [[nodiscard]] const llvm::Module& module() const { return *module_; }
  [[nodiscard]] std::vector<Condition>& conditions() { return conditions_; }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  /// The place of an instruction in the user's source.
  [[nodiscard]] Place place_of(const llvm::Instruction& instruction);

 private:
  using Environment = std::map<const llvm::Value*, Value>;
  struct Frame {
    const llvm::Function* function = nullptr;
    Environment values;
    std::optional<Value> result;
    std::map<const llvm::BasicBlock*, int> visits;  ///< of a branch on the state, in the ways that are open
    std::set<const llvm::BasicBlock*> known_exits;  ///< of loops: blocks whose branch was decided
  };
  struct Shape {                                                       ///< of a function
    std::map<const llvm::BasicBlock*, const llvm::BasicBlock*> meets;  ///< null: at the function's end
    std::map<const llvm::BasicBlock*, std::set<const llvm::BasicBlock*>> reaches;
    std::map<const llvm::BasicBlock*, std::set<const llvm::BasicBlock*>> loop;  ///< the innermost around it
  };
  enum class Ended { at_stop, returned, dead };
  struct Arm {
    int condition = -1;  ///< -1: none of those before
    const llvm::BasicBlock* target = nullptr;
  };
  struct Step {  ///< where a block goes on: the first arm whose condition holds
    enum class Kind { goes_on, returned, dead } kind = Kind::goes_on;
    std::vector<Arm> arms;
  };
  struct Way {  ///< what one of several ways has left
    Ended ended = Ended::dead;
    Environment values;
    Memory::Contents contents;
    std::optional<Value> result;
  };

  // branches.cpp
  [[nodiscard]] Ended run(Frame& frame, const llvm::BasicBlock* block, const llvm::BasicBlock* stop);
  [[nodiscard]] std::optional<Ended> branch(Frame& frame, const std::vector<Arm>& arms,
                                            const llvm::BasicBlock*& block);
  [[nodiscard]] Way follow(Frame& frame, const llvm::BasicBlock& from, const llvm::BasicBlock& target);
  [[nodiscard]] Way follow_arms(Frame& frame, const llvm::BasicBlock& from, llvm::ArrayRef<Arm> arms);
  [[nodiscard]] Way merged(int condition, Way yes, Way no);
  [[nodiscard]] bool has_to_leave(const Frame& frame, const llvm::BasicBlock* block);
  void enter(Frame& frame, const llvm::BasicBlock& block, const llvm::BasicBlock& from);
  const Shape& shape_of(const llvm::Function& function);
  void require_zero(int condition, const std::string& why, int of = -1);
  [[nodiscard]] const llvm::BasicBlock* leave_loop(Frame& frame, const std::vector<Arm>& arms,
                                                   const llvm::BasicBlock* block);
  [[nodiscard]] std::optional<bool> decided(int condition);
  [[nodiscard]] std::vector<Arm> undecided(const std::vector<Arm>& arms);
  // executor.cpp
  [[nodiscard]] std::optional<Step> execute(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Step terminator(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Value operand(Frame& frame, const llvm::Value* value);
  [[nodiscard]] Value pointer(Frame& frame, const llvm::GetElementPtrInst& instruction);
  [[nodiscard]] Value moved(const Value& base, std::int64_t offset, int index, std::int64_t stride);
  // definedness.cpp
  void require_defined(const llvm::Instruction& instruction, const std::vector<int>& operands, int result);
  [[nodiscard]] int overflow(unsigned opcode, const std::vector<int>& operands, int result);
  [[nodiscard]] int out_of_range(const llvm::Instruction& instruction, int number, int result);
  // arithmetic.cpp
  [[nodiscard]] Value arithmetic(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Value on_scalars(const llvm::Instruction& instruction, llvm::Type* type,
                                 llvm::ArrayRef<Value> operands);
  [[nodiscard]] Value frozen(llvm::Type* type, const Value& value);
  [[nodiscard]] Value on_pointers(const llvm::Instruction& instruction, const Value& a, const Value& b);
  [[nodiscard]] Value cast(const llvm::CastInst& instruction, const Value& value);
  [[nodiscard]] Value cast_vector(const llvm::CastInst& instruction, const Value& value);
  [[nodiscard]] Value compare(const llvm::CmpInst& instruction, const Value& a, const Value& b);
  [[nodiscard]] Value compare_pointers(llvm::CmpInst::Predicate predicate, const Value& a, const Value& b);
  // calls.cpp: nothing where the program ends there
  [[nodiscard]] std::optional<Value> call_of(Frame& frame, const llvm::CallBase& instruction);
  [[nodiscard]] std::optional<Value> known_function(Frame& frame, const llvm::CallBase& instruction,
                                                    const std::string& name,
                                                    const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_library(const llvm::CallBase& instruction, const std::string& name,
                                                const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_memory(const llvm::CallBase& instruction, const std::string& name,
                                               const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_integers(const llvm::CallBase& instruction, const std::string& name,
                                                 const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_lifetimes(const std::string& name,
                                                  const std::vector<Value>& arguments);

  const llvm::Module* module_;
  Graph graph_;
  Memory memory_;
  std::map<const llvm::GlobalValue*, int> globals_;
  std::map<const llvm::Function*, Shape> shapes_;
  std::vector<Condition> conditions_;
  std::vector<int> path_;  ///< the conditions of the ways that are open
  std::vector<std::string> files_;
  int depth_ = 0;
  std::int64_t executed_ = 0;  ///< instructions, since the outermost call
};

}  // namespace veritrack::lift

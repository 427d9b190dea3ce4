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

/// What has to be 0 for the listing to say what the program does.
struct Condition {
  int must_be_zero = -1;
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
  };
  struct Shape {                                                       ///< of a function
    std::map<const llvm::BasicBlock*, const llvm::BasicBlock*> meets;  ///< null: at the function's end
    std::map<const llvm::BasicBlock*, std::set<const llvm::BasicBlock*>> reaches;
  };
  enum class Ended { at_stop, returned, dead };
  struct Step {  ///< where a block goes on
    enum class Kind { jump, branch, returned, dead } kind = Kind::jump;
    const llvm::BasicBlock* yes = nullptr;
    const llvm::BasicBlock* no = nullptr;
    int condition = -1;
  };

  // branches.cpp
  [[nodiscard]] Ended run(Frame& frame, const llvm::BasicBlock* block, const llvm::BasicBlock* stop);
  [[nodiscard]] std::optional<Ended> branch(Frame& frame, const Step& step, const llvm::BasicBlock*& block);
  void enter(Frame& frame, const llvm::BasicBlock& block, const llvm::BasicBlock& from);
  const Shape& shape_of(const llvm::Function& function);
  void require_zero(int condition, const std::string& why);
  [[nodiscard]] const llvm::BasicBlock* leave_loop(Frame& frame, const Step& step,
                                                   const llvm::BasicBlock* block);
  [[nodiscard]] std::optional<bool> decided(int condition);
  // executor.cpp
  [[nodiscard]] std::optional<Step> execute(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Step terminator(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Value operand(Frame& frame, const llvm::Value* value);
  [[nodiscard]] Value pointer(Frame& frame, const llvm::GetElementPtrInst& instruction);
  [[nodiscard]] Value moved(const Value& base, std::int64_t offset, int index, std::int64_t stride);
  // arithmetic.cpp
  [[nodiscard]] Value arithmetic(Frame& frame, const llvm::Instruction& instruction);
  [[nodiscard]] Value on_scalars(const llvm::Instruction& instruction, llvm::Type* type, const Value& a,
                                 const Value& b);
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
  [[nodiscard]] std::optional<Value> of_library(const std::string& name, llvm::Type* type,
                                                const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_memory(const llvm::CallBase& instruction, const std::string& name,
                                               const std::vector<Value>& arguments);
  [[nodiscard]] std::optional<Value> of_integers(const std::string& name,
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
  std::int64_t executed_ = 0;
};

}  // namespace veritrack::lift

#include "lift/executor.hpp"

#include <llvm/IR/Constants.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/GetElementPtrTypeIterator.h>
#include <llvm/IR/InstrTypes.h>
#include <llvm/IR/Operator.h>

#include <algorithm>

namespace veritrack::lift {

namespace {

constexpr std::int64_t kMostExecuted = 2'000'000;  // instructions
constexpr int kDeepestCalls = 200;

/// The register of a number that decides what is executed.
int defined(const Value& value, const char* what) {
  const auto* number = value.as<Register>();
  if (number == nullptr) {
    throw LiftError(std::string(what) + " is not defined");
  }
  return number->number;
}

}  // namespace

Executor::Executor(const llvm::Module& module) : module_(&module), memory_(graph_, module.getDataLayout()) {
  memory_.tell([this](int condition, const char* why) { require_zero(condition, why); });
  for (const llvm::GlobalVariable& global : module.globals()) {
    globals_[&global] = memory_.add({global.getName().str(), &global, global.isConstant(), false,
                                     memory_.size_of(global.getValueType())});
  }
  for (const llvm::GlobalVariable& global : module.globals()) {
    if (global.hasInitializer() && !global.getName().startswith("llvm.")) {
      try {
        memory_.initialize(globals_.at(&global), 0, *global.getInitializer(), globals_);
      } catch (const LiftError&) {
        memory_.end(globals_.at(&global));  // a constant that is not understood: to read it is an error
      }
    } else if (global.isDeclaration()) {
      memory_.end(globals_.at(&global));
    }
  }
}

void Executor::construct_globals() {
  const llvm::GlobalVariable* list = module_->getGlobalVariable("llvm.global_ctors");
  if (list == nullptr || !list->hasInitializer()) {
    return;
  }
  std::vector<std::pair<std::uint64_t, const llvm::Function*>> constructors;
  for (const llvm::Use& entry : list->getInitializer()->operands()) {
    const auto* constant = llvm::cast<llvm::Constant>(entry);
    const auto* constructor = llvm::dyn_cast<llvm::Function>(constant->getOperand(1));
    if (constructor != nullptr && !constructor->isDeclaration()) {
      constructors.emplace_back(llvm::cast<llvm::ConstantInt>(constant->getOperand(0))->getZExtValue(),
                                constructor);
    }
  }
  std::stable_sort(constructors.begin(), constructors.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });  // by priority
  for (const auto& [priority, constructor] : constructors) {
    (void)call(*constructor, {});
  }
}

Place Executor::place_of(const llvm::Instruction& instruction) {
  const llvm::DILocation* location = instruction.getDebugLoc().get();
  if (location == nullptr || location->getLine() == 0) {
    return graph_.place();
  }
  const std::string file = location->getFilename().str();
  const auto found = std::find(files_.begin(), files_.end(), file);
  const auto number = static_cast<int>(found - files_.begin());
  if (found == files_.end()) {
    files_.push_back(file);
  }
  return {number, static_cast<int>(location->getLine()), static_cast<int>(location->getColumn())};
}

Value Executor::call(const llvm::Function& function, const std::vector<Value>& arguments) {
  executed_ = depth_ == 0 ? 0 : executed_;
  if (++depth_ > kDeepestCalls) {
    throw LiftError("functions call each other more than 200 deep");
  }
  if (arguments.size() != function.arg_size()) {
    throw LiftError("a call of " + function.getName().str() + " with another number of arguments");
  }
  Frame frame;
  frame.function = &function;
  const int objects = memory_.objects();
  for (const llvm::Argument& argument : function.args()) {
    Value value = arguments[argument.getArgNo()];
    if (argument.hasByValAttr()) {
      const std::int64_t size = memory_.size_of(argument.getParamByValType());
      const Address copy{
          memory_.add({"an argument of " + function.getName().str(), nullptr, false, true, size}), 0, -1, 0};
      memory_.copy(copy, value, size);
      value = copy;
    }
    frame.values[&argument] = value;
  }
  const Ended ended = run(frame, &function.getEntryBlock(), nullptr);
  --depth_;
  if (ended == Ended::dead) {
    throw LiftError("the function ends the program");
  }
  for (int object = objects; object < memory_.objects(); ++object) {
    if (memory_.object(object).is_variable) {
      memory_.end(object);
    }
  }
  return frame.result.value_or(Undefined{});
}

Value Executor::operand(Frame& frame, const llvm::Value* value) {
  if (const auto* constant = llvm::dyn_cast<llvm::Constant>(value)) {
    return memory_.constant(*constant, globals_);
  }
  const auto found = frame.values.find(value);
  return found == frame.values.end() ? Value(Undefined{}) : found->second;
}

Executor::Step Executor::terminator(Frame& frame, const llvm::Instruction& instruction) {
  if (const auto* end = llvm::dyn_cast<llvm::ReturnInst>(&instruction)) {
    frame.result =
        end->getReturnValue() == nullptr ? Value(Undefined{}) : operand(frame, end->getReturnValue());
    return {Step::Kind::returned, {}};
  }
  if (const auto* jump = llvm::dyn_cast<llvm::BranchInst>(&instruction)) {
    if (jump->isUnconditional()) {
      return {Step::Kind::goes_on, {{-1, jump->getSuccessor(0)}}};
    }
    const int condition = defined(operand(frame, jump->getCondition()), "a condition");
    return {Step::Kind::goes_on, {{condition, jump->getSuccessor(0)}, {-1, jump->getSuccessor(1)}}};
  }
  if (const auto* choice = llvm::dyn_cast<llvm::SwitchInst>(&instruction)) {
    const int number = defined(operand(frame, choice->getCondition()), "the value of a switch");
    Step step;
    for (const auto& entry : choice->cases()) {
      const int constant =
          graph_.constant(graph_.format(number), entry.getCaseValue()->getValue().getZExtValue());
      step.arms.push_back(
          {graph_.make(Operation::icmp, trackers::code::kBit, {number, constant}, Predicate::eq),
           entry.getCaseSuccessor()});
    }
    step.arms.push_back({-1, choice->getDefaultDest()});
    return step;
  }
  if (const auto* invoke = llvm::dyn_cast<llvm::InvokeInst>(&instruction)) {
    const std::optional<Value> result = call_of(frame, *invoke);
    if (!result) {
      return {Step::Kind::dead, {}};
    }
    frame.values[&instruction] = *result;
    return {Step::Kind::goes_on, {{-1, invoke->getNormalDest()}}};
  }
  if (llvm::isa<llvm::UnreachableInst>(instruction)) {
    return {Step::Kind::dead, {}};
  }
  throw LiftError(std::string("an instruction that is not followed: ") + instruction.getOpcodeName());
}

std::optional<Executor::Step> Executor::execute(Frame& frame, const llvm::Instruction& instruction) {
  if (++executed_ > kMostExecuted) {
    throw LiftError(
        "more than 2,000,000 instructions are executed: a loop that does not end, or too much work");
  }
  graph_.set_place(place_of(instruction));
  if (instruction.isTerminator()) {
    return terminator(frame, instruction);
  }
  Value& result = frame.values[&instruction];
  if (const auto* alloca = llvm::dyn_cast<llvm::AllocaInst>(&instruction)) {
    if (alloca->isArrayAllocation()) {
      throw LiftError("an array whose length is not a constant");
    }
    const std::int64_t size = memory_.size_of(alloca->getAllocatedType());
    const std::string name = "a variable of " + frame.function->getName().str();
    result = Address{memory_.add({name, nullptr, false, true, size}), 0, -1, 0};
  } else if (const auto* load = llvm::dyn_cast<llvm::LoadInst>(&instruction)) {
    if (load->isVolatile()) {
      throw LiftError("a volatile variable is read, whose value nobody knows");
    }
    result = memory_.load(operand(frame, load->getPointerOperand()), load->getType());
  } else if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction)) {
    const Value value = operand(frame, store->getValueOperand());
    memory_.store(operand(frame, store->getPointerOperand()), store->getValueOperand()->getType(), value);
  } else if (const auto* gep = llvm::dyn_cast<llvm::GetElementPtrInst>(&instruction)) {
    result = pointer(frame, *gep);
  } else if (const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction)) {
    std::optional<Value> value = call_of(frame, *call);
    if (!value) {
      return Step{Step::Kind::dead, {}};
    }
    frame.values[&instruction] = *value;
  } else {
    frame.values[&instruction] = arithmetic(frame, instruction);
  }
  return std::nullopt;
}

Value Executor::moved(const Value& base, std::int64_t offset, int index, std::int64_t stride) {
  if (const auto* choice = base.as<Choice>()) {
    return memory_.select(choice->condition, moved(*choice->yes, offset, index, stride),
                          moved(*choice->no, offset, index, stride));
  }
  const auto* address = base.as<Address>();
  if (address == nullptr && !base.is_undefined()) {
    throw LiftError("an offset to what is no pointer");
  }
  if (address == nullptr) {
    return Undefined{};
  }
  Address place = *address;
  place.offset += offset;
  if (index >= 0) {
    if (place.index >= 0) {
      throw LiftError("two indices that depend on the state");
    }
    place.index = index;
    place.stride = stride;
  }
  return place;
}

Value Executor::pointer(Frame& frame, const llvm::GetElementPtrInst& instruction) {
  const Value base = operand(frame, instruction.getPointerOperand());
  std::int64_t offset = 0;
  int index = -1;
  std::int64_t stride = 0;
  const llvm::DataLayout& layout = module_->getDataLayout();
  for (auto it = llvm::gep_type_begin(instruction); it != llvm::gep_type_end(instruction); ++it) {
    const Value position = operand(frame, it.getOperand());
    const auto* number = position.as<Register>();
    if (number == nullptr) {
      throw LiftError("an index that is not defined");
    }
    if (llvm::StructType* structure = it.getStructTypeOrNull()) {
      offset += static_cast<std::int64_t>(layout.getStructLayout(structure)->getElementOffset(
          static_cast<unsigned>(graph_.bits(number->number))));
      continue;
    }
    const std::int64_t size = memory_.size_of(it.getIndexedType());
    if (graph_.is_known(number->number)) {
      offset += graph_.signed_bits(number->number) * size;
    } else if (index >= 0) {
      throw LiftError("two indices that depend on the state");
    } else {
      // Indices have a sign; those of 32 bits are outside of any table where they are negative.
      constexpr int kFewBits = 32;
      index = graph_.format(number->number).bits >= kFewBits
                  ? number->number
                  : graph_.make(Operation::sext, {false, kFewBits}, {number->number});
      stride = size;
    }
  }
  return moved(base, offset, index, stride);
}

}  // namespace veritrack::lift

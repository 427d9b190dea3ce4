// Calls: of functions that are defined, of the library of C, and of what compilers put in.
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Operator.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "lift/executor.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;

bool begins(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

bool has_no_effect(std::string_view name) {
  constexpr std::array kNone{
      "llvm.lifetime",  "llvm.dbg",       "llvm.experimental.noalias", "llvm.assume", "llvm.stack",
      "llvm.donothing", "llvm.invariant", "_ZNSt8ios_base4Init",       "__cxa_atexit"};
  return std::any_of(kNone.begin(), kNone.end(), [&](const char* with) { return begins(name, with); });
}

/// Also what is only called where a product of complex numbers is no number.
bool ends_program(std::string_view name) {
  return name == "__mulsc3" || name == "__muldc3" || name == "llvm.trap" || name == "abort" ||
         name == "exit" || begins(name, "__assert") || begins(name, "__cxa_throw") ||
         begins(name, "_ZSt20__throw") || begins(name, "_ZSt9terminate") ||
         name.find("__throw") != std::string_view::npos;
}

/// Whether a call fits to a function; what pointers point to may differ, as in calls of virtual functions.
bool have_same_types(const llvm::FunctionType& a, const llvm::FunctionType& b) {
  const auto same = [](const llvm::Type* x, const llvm::Type* y) {
    return x == y || (x->isPointerTy() && y->isPointerTy());
  };
  return same(a.getReturnType(), b.getReturnType()) && a.getNumParams() == b.getNumParams() &&
         std::equal(a.param_begin(), a.param_end(), b.param_begin(), same);
}

}  // namespace

std::optional<Value> Executor::call_of(Frame& frame, const llvm::CallBase& instruction) {
  if (llvm::isa<llvm::DbgInfoIntrinsic>(instruction)) {
    return Value(Undefined{});
  }
  if (instruction.isInlineAsm()) {
    throw LiftError("assembly in the function");
  }
  std::vector<Value> arguments;
  for (const llvm::Use& argument : instruction.args()) {
    const bool is_value = !argument->getType()->isMetadataTy();
    arguments.push_back(is_value ? operand(frame, argument) : Value(Undefined{}));
  }
  const llvm::Function* function = instruction.getCalledFunction();
  if (function == nullptr) {
    const Value called = operand(frame, instruction.getCalledOperand());
    const auto* known = called.as<FunctionAddress>();
    if (known == nullptr) {
      throw LiftError("a call through a pointer that is not known");
    }
    function = known->function;
  }
  if (!have_same_types(*function->getFunctionType(), *instruction.getFunctionType())) {
    throw LiftError("a call of " + function->getName().str() + " with other types than it has");
  }
  if (!function->isDeclaration()) {
    const Place place = graph_.place();
    Value result = call(*function, arguments);
    graph_.set_place(place);
    return result;
  }
  return known_function(frame, instruction, function->getName().str(), arguments);
}

std::optional<Value> Executor::known_function(Frame& /*frame*/, const llvm::CallBase& instruction,
                                              const std::string& name, const std::vector<Value>& arguments) {
  if (has_no_effect(name)) {
    return Value(Undefined{});
  }
  if (ends_program(name)) {
    return std::nullopt;
  }
  if (const auto* number = llvm::dyn_cast<llvm::FPMathOperator>(&instruction);
      number != nullptr && (number->hasAllowReassoc() || number->hasApproxFunc() || number->hasNoNaNs())) {
    throw LiftError("a call under -ffast-math; allowed: the file compiled without it");
  }
  if (auto value = of_memory(instruction, name, arguments)) {
    return value;
  }
  if (auto value = of_library(instruction, name, arguments)) {
    return value;
  }
  if (auto value = of_integers(instruction, name, arguments)) {
    return value;
  }
  if (auto value = of_lifetimes(name, arguments)) {
    return value;
  }
  const bool prints = name == "printf" || name == "puts" || name == "fprintf" || name == "putchar";
  if (prints && instruction.use_empty()) {
    return Value(Undefined{});
  }
  throw LiftError("a call of " + name +
                  ", which is neither defined in the files nor a function of the library that "
                  "is known; allowed: its file among `files`");
}

std::optional<Value> Executor::of_memory(const llvm::CallBase& instruction, const std::string& name,
                                         const std::vector<Value>& arguments) {
  const auto known = [&](std::size_t i) -> std::int64_t {
    const auto* number = arguments.at(i).as<Register>();
    if (number == nullptr || !graph_.is_known(number->number)) {
      throw LiftError("a number of bytes that depends on the state, in a call of " + name);
    }
    return graph_.signed_bits(number->number);
  };
  const bool moves = begins(name, "llvm.mem");
  if (moves && arguments.size() > 3 && known(3) != 0) {
    throw LiftError("volatile memory is copied or filled, whose values nobody knows");
  }
  if (begins(name, "llvm.memcpy") || begins(name, "llvm.memmove") || name == "memcpy" || name == "memmove") {
    memory_.copy(arguments.at(0), arguments.at(1), known(2));
    return arguments[0];
  }
  if (begins(name, "llvm.memset") || name == "memset") {
    memory_.set(arguments.at(0), static_cast<std::uint8_t>(known(1)), known(2));
    return arguments[0];
  }
  const bool is_new = begins(name, "_Znw") || begins(name, "_Zna") || name == "malloc";
  if (is_new || name == "calloc") {
    const std::int64_t bytes = is_new ? known(0) : known(0) * known(1);
    if (bytes < 0 || bytes > (1 << 20)) {
      throw LiftError("more than a million bytes of memory are asked for");
    }
    const int line = place_of(instruction).line;
    const int object = memory_.add({"memory of line " + std::to_string(line), nullptr, false, false, bytes});
    if (!is_new) {
      memory_.fill_with_zeros(object, 0, bytes);
    }
    return Value(Address{object, 0, -1, 0});
  }
  if (name == "sincosf" || name == "sincos") {
    const auto* angle = arguments.at(0).as<Register>();
    if (angle == nullptr) {
      return Value(Undefined{});
    }
    llvm::LLVMContext& context = instruction.getContext();
    llvm::Type* type = name == "sincos" ? llvm::Type::getDoubleTy(context) : llvm::Type::getFloatTy(context);
    const Format format = memory_.format_of(type);
    memory_.store(arguments.at(1), type, Register{graph_.make(Operation::sin, format, {angle->number})});
    memory_.store(arguments.at(2), type, Register{graph_.make(Operation::cos, format, {angle->number})});
    return Value(Undefined{});
  }
  return std::nullopt;
}

/// Static variables of functions that are set where the function is called first, and memory given back.
std::optional<Value> Executor::of_lifetimes(const std::string& name, const std::vector<Value>& arguments) {
  if (name == "__cxa_guard_acquire" || name == "__cxa_guard_release") {
    llvm::LLVMContext& context = module_->getContext();
    const Value one = Register{graph_.constant({false, 8}, 1)};
    if (name == "__cxa_guard_acquire") {  // called where the first byte is 0
      return Value(Register{graph_.constant({false, 32}, 1)});
    }
    memory_.store(arguments.at(0), llvm::Type::getInt8Ty(context), one);
    return Value(Undefined{});
  }
  if (name != "free" && !begins(name, "_ZdlPv") && !begins(name, "_ZdaPv")) {
    return std::nullopt;
  }
  const auto* address = arguments.at(0).as<Address>();
  if (address == nullptr || !path_.empty()) {
    throw LiftError("memory is given back where the state decides");
  }
  if (address->object >= 0) {
    memory_.end(address->object);
  }
  return Value(Undefined{});
}

std::optional<Value> Executor::of_integers(const llvm::CallBase& instruction, const std::string& name,
                                           const std::vector<Value>& arguments) {
  if (name != "abs" && !begins(name, "llvm.")) {
    return std::nullopt;
  }
  std::string_view plain = name;
  plain.remove_prefix(name == "abs" ? 0 : 5);
  plain = plain.substr(0, plain.find('.'));
  const auto number = [&](std::size_t i) {
    const auto* held = arguments.at(i).as<Register>();
    if (held == nullptr) {
      throw LiftError("an undefined value in a call of " + name);
    }
    return held->number;
  };
  if (plain == "expect" || plain == "launder" || plain == "strip") {
    return arguments.at(0);
  }
  if (plain == "is") {  // llvm.is.constant
    return Value(Register{graph_.bit(false)});
  }
  const std::array choices{std::pair<std::string_view, Predicate>{"umax", Predicate::ugt},
                           std::pair<std::string_view, Predicate>{"umin", Predicate::ult},
                           std::pair<std::string_view, Predicate>{"smax", Predicate::sgt},
                           std::pair<std::string_view, Predicate>{"smin", Predicate::slt}};
  for (const auto& [called, predicate] : choices) {
    if (plain == called) {
      const int first = graph_.make(Operation::icmp, kBit, {number(0), number(1)}, predicate);
      return Value(Register{graph_.select(first, number(0), number(1))});
    }
  }
  if (plain == "abs" && !instruction.getType()->isVectorTy()) {
    const Format format = graph_.format(number(0));
    const int zero = graph_.constant(format, 0);
    const int is_negative = graph_.make(Operation::icmp, kBit, {number(0), zero}, Predicate::slt);
    const int lowest = graph_.constant(format, std::uint64_t{1} << static_cast<unsigned>(format.bits - 1));
    const int negative = graph_.make(Operation::sub, format, {zero, number(0)});
    const int is_lowest = graph_.make(Operation::icmp, kBit, {number(0), lowest}, Predicate::eq);
    require_zero(is_lowest, "an operation on signed integers does not overflow", negative);
    return Value(Register{graph_.select(is_negative, negative, number(0))});
  }
  return std::nullopt;
}

}  // namespace veritrack::lift

// Calls: of functions that are defined, of the library of C, and of what compilers put in.
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/InlineAsm.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Operator.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "lift/executor.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;
using trackers::code::kDouble;
using trackers::code::kSingle;

struct LibraryFunction {
  std::string_view name;
  Operation operation;
  std::size_t operands;
};

/// Functions of <math.h> for double; with an f behind the name for float.
constexpr std::array kLibrary{
    LibraryFunction{"sin", Operation::sin, 1},           LibraryFunction{"cos", Operation::cos, 1},
    LibraryFunction{"tan", Operation::tan, 1},           LibraryFunction{"asin", Operation::asin, 1},
    LibraryFunction{"acos", Operation::acos, 1},         LibraryFunction{"atan", Operation::atan, 1},
    LibraryFunction{"atan2", Operation::atan2, 2},       LibraryFunction{"exp", Operation::exp, 1},
    LibraryFunction{"log", Operation::log, 1},           LibraryFunction{"pow", Operation::pow, 2},
    LibraryFunction{"hypot", Operation::hypot, 2},       LibraryFunction{"tanh", Operation::tanh, 1},
    LibraryFunction{"sqrt", Operation::sqrt, 1},         LibraryFunction{"fabs", Operation::fabs, 1},
    LibraryFunction{"floor", Operation::floor, 1},       LibraryFunction{"ceil", Operation::ceil, 1},
    LibraryFunction{"trunc", Operation::trunc, 1},       LibraryFunction{"rint", Operation::rint, 1},
    LibraryFunction{"nearbyint", Operation::rint, 1},    LibraryFunction{"round", Operation::round, 1},
    LibraryFunction{"fmin", Operation::fmin, 2},         LibraryFunction{"fmax", Operation::fmax, 2},
    LibraryFunction{"minnum", Operation::fmin, 2},       LibraryFunction{"maxnum", Operation::fmax, 2},
    LibraryFunction{"copysign", Operation::copysign, 2}, LibraryFunction{"fmod", Operation::fmod, 2},
    LibraryFunction{"fma", Operation::fma, 3},
};

/// The name of a function without what names its types: `llvm.fabs.f32` is fabs, sinf sin.
std::string_view plain_name(std::string_view name) {
  if (name.substr(0, 5) == "llvm.") {
    name.remove_prefix(5);
    return name.substr(0, name.find('.'));
  }
  const auto is_known = [](std::string_view wanted) {
    return std::any_of(kLibrary.begin(), kLibrary.end(),
                       [&](const LibraryFunction& entry) { return entry.name == wanted; });
  };
  const bool is_single = !name.empty() && name.back() == 'f' && is_known(name.substr(0, name.size() - 1));
  return is_single ? name.substr(0, name.size() - 1) : name;
}

bool begins(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

bool has_no_effect(std::string_view name) {
  constexpr std::array kNone{
      "llvm.lifetime",  "llvm.dbg",       "llvm.experimental.noalias", "llvm.assume",  "llvm.stack",
      "llvm.donothing", "llvm.invariant", "_ZNSt8ios_base4Init",       "__cxa_atexit", "__cxa_guard_release",
      "_ZdlPv",         "_ZdaPv"};
  return name == "free" ||
         std::any_of(kNone.begin(), kNone.end(), [&](const char* with) { return begins(name, with); });
}

bool ends_program(std::string_view name) {
  return name == "llvm.trap" || name == "abort" || name == "exit" || begins(name, "__assert") ||
         begins(name, "__cxa_throw") || begins(name, "_ZSt20__throw") || begins(name, "_ZSt9terminate") ||
         name.find("__throw") != std::string_view::npos;
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
  if (auto value = of_library(name, instruction.getType(), arguments)) {
    return value;
  }
  if (auto value = of_integers(name, arguments)) {
    return value;
  }
  if (name == "printf" || name == "puts" || name == "fprintf" || name == "putchar") {
    return Value(Register{graph_.constant({false, 32}, 0)});
  }
  if (name == "__cxa_guard_acquire") {
    return Value(Register{graph_.constant({false, 32}, 1)});
  }
  throw LiftError("a call of " + name +
                  ", which is neither defined in the files nor a function of the library that "
                  "is known; allowed: its file among `files`");
}

std::optional<Value> Executor::of_library(const std::string& name, llvm::Type* type,
                                          const std::vector<Value>& arguments) {
  std::vector<int> operands;
  for (const Value& argument : arguments) {
    const auto* number = argument.as<Register>();
    operands.push_back(number == nullptr ? -1 : number->number);
  }
  const bool is_defined = std::find(operands.begin(), operands.end(), -1) == operands.end();
  const std::string_view plain = plain_name(name);
  if (plain == "fmuladd" && is_defined && operands.size() == 3) {
    const Format format = memory_.format_of(type);
    const int product = graph_.make(Operation::fmul, format, {operands[0], operands[1]});
    return Value(Register{graph_.make(Operation::fadd, format, {product, operands[2]})});
  }
  if (plain == "isnan" || plain == "__isnanf" || plain == "__isnan") {
    const int is_nan = graph_.make(Operation::fcmp, kBit, {operands.at(0), operands.at(0)}, Predicate::uno);
    return Value(Register{graph_.make(Operation::zext, memory_.format_of(type), {is_nan})});
  }
  const auto* found = std::find_if(kLibrary.begin(), kLibrary.end(),
                                   [&](const LibraryFunction& entry) { return entry.name == plain; });
  if (found == kLibrary.end() || operands.size() < found->operands || type->isVectorTy()) {
    return std::nullopt;
  }
  operands.resize(found->operands);
  if (!is_defined) {
    return Value(Undefined{});
  }
  return Value(Register{graph_.make(found->operation, memory_.format_of(type), operands)});
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
    const int object = memory_.add({"memory of line " + std::to_string(line), nullptr, false, bytes});
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

std::optional<Value> Executor::of_integers(const std::string& name, const std::vector<Value>& arguments) {
  const std::string_view plain = plain_name(name);
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
  if (plain == "abs") {
    const Format format = graph_.format(number(0));
    const int zero = graph_.constant(format, 0);
    const int is_negative = graph_.make(Operation::icmp, kBit, {number(0), zero}, Predicate::slt);
    return Value(Register{
        graph_.select(is_negative, graph_.make(Operation::sub, format, {zero, number(0)}), number(0))});
  }
  return std::nullopt;
}

}  // namespace veritrack::lift

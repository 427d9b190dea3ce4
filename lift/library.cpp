// Functions of the library of C that compute numbers.
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
    name = name.substr(0, name.find('.'));
    return name == "minnum" ? "fmin" : name == "maxnum" ? "fmax" : name;
  }
  const auto is_known = [](std::string_view wanted) {
    return std::any_of(kLibrary.begin(), kLibrary.end(),
                       [&](const LibraryFunction& entry) { return entry.name == wanted; });
  };
  const bool is_single = !name.empty() && name.back() == 'f' && is_known(name.substr(0, name.size() - 1));
  return is_single ? name.substr(0, name.size() - 1) : name;
}

}  // namespace

std::optional<Value> Executor::of_library(const llvm::CallBase& instruction, const std::string& name,
                                          const std::vector<Value>& arguments) {
  llvm::Type* type = instruction.getType();
  const std::string_view plain = plain_name(name);
  const auto* found = std::find_if(kLibrary.begin(), kLibrary.end(),
                                   [&](const LibraryFunction& entry) { return entry.name == plain; });
  const bool tests = plain == "isnan" || plain == "__isnanf" || plain == "__isnan";
  const bool fuses = name.substr(0, 12) == "llvm.fmuladd";
  const std::size_t count = tests ? 1 : fuses ? 3 : found != kLibrary.end() ? found->operands : 0;
  if (count == 0 || arguments.size() != count || type->isVectorTy()) {
    return std::nullopt;
  }
  std::vector<int> operands;
  for (std::size_t i = 0; i < count; ++i) {
    llvm::Type* of = instruction.getArgOperand(static_cast<unsigned>(i))->getType();
    const auto* number = arguments[i].as<Register>();
    const bool fits = tests ? of->isFloatTy() || of->isDoubleTy() : of == type;
    if (fits && arguments[i].is_undefined()) {
      throw LiftError("a value that is not defined is used in a call of " + name);
    }
    if (!fits || number == nullptr) {
      return std::nullopt;
    }
    operands.push_back(number->number);
  }
  const Format format = memory_.format_of(type);
  if (tests) {
    const int is_nan = graph_.make(Operation::fcmp, kBit, {operands[0], operands[0]}, Predicate::uno);
    return Value(Register{graph_.make(Operation::zext, format, {is_nan})});
  }
  if (fuses) {
    const int product = graph_.make(Operation::fmul, format, {operands[0], operands[1]});
    return Value(Register{graph_.make(Operation::fadd, format, {product, operands[2]})});
  }
  const bool is_of_compiler = name.substr(0, 5) == "llvm.";
  if (!format.is_float || (!is_of_compiler && format != (plain == name ? kDouble : kSingle))) {
    return std::nullopt;  // a function of the user that has such a name
  }
  return Value(Register{graph_.make(found->operation, format, operands)});
}

}  // namespace veritrack::lift

#include "checker/code/listed_operations.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>

namespace veritrack::checker {

namespace {

/// Operations on numbers with a result of the same format, and on integers likewise, by the number of
/// operands.
const std::map<std::string_view, std::size_t>& of_numbers() {
  static const std::map<std::string_view, std::size_t> known{
      {"fadd", 2},  {"fsub", 2}, {"fmul", 2},  {"fdiv", 2},     {"fneg", 1},   {"fma", 3},
      {"sqrt", 1},  {"fabs", 1}, {"floor", 1}, {"ceil", 1},     {"ftrunc", 1}, {"rint", 1},
      {"round", 1}, {"fmin", 2}, {"fmax", 2},  {"copysign", 2}, {"fmod", 2},   {"sin", 1},
      {"cos", 1},   {"tan", 1},  {"asin", 1},  {"acos", 1},     {"atan", 1},   {"atan2", 2},
      {"exp", 1},   {"log", 1},  {"pow", 2},   {"hypot", 2},    {"tanh", 1}};
  return known;
}

bool is_of_integers(std::string_view name) {
  static const std::set<std::string_view> known{"add", "sub", "mul", "udiv", "sdiv", "urem", "srem",
                                                "and", "or",  "xor", "shl",  "lshr", "ashr"};
  return known.contains(name);
}

bool compares_numbers(std::string_view predicate) {
  static const std::set<std::string_view> known{"oeq", "one", "olt", "ole", "ogt", "oge", "ord",
                                                "ueq", "une", "ult", "ule", "ugt", "uge", "uno"};
  return known.contains(predicate);
}
bool compares_integers(std::string_view predicate) {
  static const std::set<std::string_view> known{"eq",  "ne",  "ult", "ule", "ugt",
                                                "uge", "slt", "sle", "sgt", "sge"};
  return known.contains(predicate);
}

/// Whether the operation converts a format into another one in a way that it can.
bool converts(std::string_view name, ListedFormat from, ListedFormat to) {
  const bool between_numbers = from.is_float && to.is_float;
  const bool between_integers = !from.is_float && !to.is_float;
  return (name == "fpext" && between_numbers && from.bits < to.bits) ||
         (name == "fptrunc" && between_numbers && from.bits > to.bits) ||
         ((name == "sitofp" || name == "uitofp") && !from.is_float && to.is_float) ||
         ((name == "fptosi" || name == "fptoui") && from.is_float && !to.is_float) ||
         ((name == "zext" || name == "sext") && between_integers && from.bits < to.bits) ||
         (name == "trunc" && between_integers && from.bits > to.bits) ||
         (name == "bits" && from.is_float != to.is_float && from.bits == to.bits);
}

}  // namespace

const char* objection_to_operation(const ListedOperation& operation, ListedFormat written,
                                   const std::vector<ListedFormat>& operands) {
  constexpr const char* kFormats = "an operation on operands of other formats";
  const std::string_view name = operation.name;
  const bool all_as_written =
      std::all_of(operands.begin(), operands.end(), [&](ListedFormat each) { return each == written; });
  const auto if_not = [](bool is_so, const char* objection) { return is_so ? nullptr : objection; };
  if (const auto found = of_numbers().find(name); found != of_numbers().end()) {
    return if_not(operands.size() == found->second && written.is_float && all_as_written, kFormats);
  }
  if (is_of_integers(name)) {
    return if_not(operands.size() == 2 && !written.is_float && all_as_written, kFormats);
  }
  if (name == "fcmp" || name == "icmp") {
    const bool is_float = name == "fcmp";
    const bool is_known =
        is_float ? compares_numbers(operation.predicate) : compares_integers(operation.predicate);
    return !is_known
               ? "an unknown comparison"
               : if_not(operands.size() == 2 && written.is_float == is_float && all_as_written, kFormats);
  }
  if (name == "select") {
    return if_not(operands.size() == 3 && operands[0] == ListedFormat{false, 1} && operands[1] == written &&
                      operands[2] == written,
                  kFormats);
  }
  if (name == "table") {
    return if_not(operands.size() == 1 && !operands[0].is_float, kFormats);
  }
  const bool is_conversion = name == "fpext" || name == "fptrunc" || name == "sitofp" || name == "uitofp" ||
                             name == "fptosi" || name == "fptoui" || name == "zext" || name == "sext" ||
                             name == "trunc" || name == "bits";
  return !is_conversion ? "an unknown operation"
                        : if_not(operands.size() == 1 && converts(name, operands[0], written), kFormats);
}

}  // namespace veritrack::checker

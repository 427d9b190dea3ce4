#include "analysis/model/code/sample_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>

#include "analysis/model/code/turns.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model::code {

namespace {

using rigor::Interval;
using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

constexpr double kLargestScale = 0x1p40;

double power_of_scale(int degree) {
  return std::pow(kLargestScale, std::abs(degree));  // exact
}

std::size_t index(int place) {
  return static_cast<std::size_t>(place);
}

}  // namespace

SampleFunction::SampleFunction(const Listing& listing, int value) : listing_(&listing) {
  std::set<int> needed{value};
  for (auto place = needed.rbegin(); place != needed.rend(); ++place) {
    const Instruction& instruction = at(*place);
    const std::set<int> before(instruction.operands.begin(), instruction.operands.end());
    std::copy_if(before.begin(), before.end(), std::inserter(needed, needed.end()),
                 [](int operand) { return operand >= 0; });
  }
  order_.assign(needed.begin(), needed.end());
}

std::optional<Interval> SampleFunction::value(const Interval& x, const Interval& y) {
  scaled_.assign(listing_->instructions.size(), {});
  truths_.assign(listing_->instructions.size(), {});
  scaled_[index(listing_->samples[0])] = {true, 1, x, false};
  scaled_[index(listing_->samples[1])] = {true, 1, y, false};
  for (const int place : order_) {
    const Instruction& instruction = at(place);
    if (std::find(listing_->samples.begin(), listing_->samples.end(), place) != listing_->samples.end()) {
      continue;
    }
    if (instruction.format.is_float) {
      Scaled found = operation(instruction);
      found.is_known = found.is_known && rigor::is_finite(found.range);
      scaled_[index(place)] = found;
    } else {
      truths_[index(place)] = truth(instruction);
    }
  }
  const Scaled& last = scaled_[index(order_.back())];
  return last.is_known && last.degree == 0 ? std::optional(last.range) : std::nullopt;
}

/// The constant is s^degree times this.
SampleFunction::Scaled SampleFunction::of_degree(const Scaled& value, int degree) {
  if (!value.is_known || value.degree == degree || !value.is_constant) {
    return value.degree == degree ? value : Scaled{};
  }
  const double most = rigor::mul_up(rigor::magnitude(value.range), power_of_scale(degree));
  return {true, degree, Interval::from_bounds(-most, most), true};
}

/// Both of the same degree, that of the one that is no constant.
std::pair<SampleFunction::Scaled, SampleFunction::Scaled> SampleFunction::alike(const Scaled& a,
                                                                                const Scaled& b) {
  const int degree = a.is_constant ? b.degree : a.degree;
  return {of_degree(a, degree), of_degree(b, degree)};
}

SampleFunction::Scaled SampleFunction::rounded(Format format, int degree, const Interval& exact,
                                               double units) {
  const double flushed = format.bits == 32 ? 0x1p-126 : 0x1p-1022;
  const double limit = format.bits == 32 ? 0x1p127 : 0x1p1023;
  const double scale = power_of_scale(degree);
  const double most = rigor::magnitude(exact);
  if (!(rigor::mul_up(most, scale) <= limit)) {
    return {};
  }
  const double off = rigor::add_up(rigor::mul_up(rigor::mul_up(units, unit_roundoff(format)), most),
                                   rigor::mul_up(flushed, scale));
  return {true, degree, exact + Interval::from_bounds(-off, off), false};
}

SampleFunction::Scaled SampleFunction::operation(const Instruction& instruction) const {
  const auto operand = [&](std::size_t i) -> const Scaled& {
    return scaled_[index(instruction.operands[i])];
  };
  if (instruction.operation == Operation::constant) {
    const double number = trackers::code::number_of(instruction.format, instruction.bits);
    return std::isfinite(number) ? Scaled{true, 0, Interval(number), true} : Scaled{};
  }
  if (instruction.operation == Operation::select) {
    return chosen(truths_[index(instruction.operands[0])], operand(1), operand(2));
  }
  if (instruction.operands[0] < 0 || !operand(0).is_known) {
    return {};
  }
  return instruction.operands[1] < 0                          ? of_one(instruction, operand(0))
         : operand(1).is_known && instruction.operands[2] < 0 ? of_two(instruction, operand(0), operand(1))
                                                              : Scaled{};
}

SampleFunction::Scaled SampleFunction::chosen(const Truth& condition, const Scaled& yes, const Scaled& no) {
  if (!condition.may_fail || !condition.may_hold) {
    return condition.may_hold ? yes : no;
  }
  const auto [a, b] = alike(yes, no);
  return a.is_known && b.is_known
             ? Scaled{true, a.degree, hull(a.range, b.range), a.is_constant && b.is_constant}
             : Scaled{};
}

SampleFunction::Scaled SampleFunction::of_one(const Instruction& instruction, const Scaled& x) {
  switch (instruction.operation) {
    case Operation::fpext:
      return x;
    case Operation::fptrunc:
      return rounded(instruction.format, x.degree, x.range);
    case Operation::fneg:
      return {true, x.degree, -x.range, x.is_constant};
    case Operation::fabs:
      return {true, x.degree, rigor::abs(x.range), x.is_constant};
    case Operation::sqrt:
      return x.degree % 2 == 0 && x.range.lower() >= 0.0
                 ? rounded(instruction.format, x.degree / 2, rigor::sqrt(x.range))
                 : Scaled{};
    case Operation::atan:
      return x.degree == 0 ? rounded(instruction.format, 0, rigor::atan(x.range), 4.0) : Scaled{};
    default:
      return {};
  }
}

SampleFunction::Scaled SampleFunction::of_two(const Instruction& instruction, const Scaled& x,
                                              const Scaled& y) {
  const auto [a, b] = alike(x, y);
  const bool are_alike = a.is_known && b.is_known;
  const Format format = instruction.format;
  switch (instruction.operation) {
    case Operation::fadd:
      return are_alike ? rounded(format, a.degree, a.range + b.range) : Scaled{};
    case Operation::fsub:
      return are_alike ? rounded(format, a.degree, a.range - b.range) : Scaled{};
    case Operation::fmul: {
      const bool is_square = instruction.operands[0] == instruction.operands[1];
      return rounded(format, x.degree + y.degree, is_square ? rigor::square(x.range) : x.range * y.range);
    }
    case Operation::fdiv:
      return rigor::mignitude(y.range) > 0.0 ? rounded(format, x.degree - y.degree, x.range / y.range)
                                             : Scaled{};
    case Operation::fmin:
    case Operation::fmax: {
      const auto pick = [&](double first, double second) {
        return instruction.operation == Operation::fmin ? std::min(first, second) : std::max(first, second);
      };
      return are_alike ? Scaled{true, a.degree,
                                Interval::from_bounds(pick(a.range.lower(), b.range.lower()),
                                                      pick(a.range.upper(), b.range.upper())),
                                a.is_constant && b.is_constant}
                       : Scaled{};
    }
    case Operation::copysign: {
      const Interval size = rigor::abs(x.range);
      return {true, x.degree,
              y.range.lower() > 0.0   ? size
              : y.range.upper() < 0.0 ? -size
                                      : hull(-size, size),
              false};
    }
    default:
      return {};
  }
}

SampleFunction::Truth SampleFunction::truth(const Instruction& instruction) const {
  const auto& [first, second, third] = instruction.operands;
  const auto of = [&](int place) { return truths_[index(place)]; };
  switch (instruction.operation) {
    case Operation::constant:
      return {instruction.bits != 0, instruction.bits == 0};
    case Operation::bit_and:
      return {of(first).may_hold && of(second).may_hold, of(first).may_fail || of(second).may_fail};
    case Operation::bit_or:
      return {of(first).may_hold || of(second).may_hold, of(first).may_fail && of(second).may_fail};
    case Operation::fcmp:
      return compared(instruction.predicate, scaled_[index(first)], scaled_[index(second)]);
    default:
      return {};
  }
}

SampleFunction::Truth SampleFunction::compared(Predicate predicate, const Scaled& x, const Scaled& y) {
  const auto [a, b] = alike(x, y);
  if (!a.is_known || !b.is_known) {
    return {};
  }
  const bool may_be_less = a.range.lower() < b.range.upper();
  const bool may_be_more = a.range.upper() > b.range.lower();
  const bool may_be_equal = a.range.lower() <= b.range.upper() && a.range.upper() >= b.range.lower();
  switch (predicate) {
    case Predicate::olt:
    case Predicate::ult:
      return {may_be_less, may_be_more || may_be_equal};
    case Predicate::ole:
    case Predicate::ule:
      return {may_be_less || may_be_equal, may_be_more};
    case Predicate::ogt:
    case Predicate::ugt:
      return {may_be_more, may_be_less || may_be_equal};
    case Predicate::oge:
    case Predicate::uge:
      return {may_be_more || may_be_equal, may_be_less};
    case Predicate::oeq:
    case Predicate::ueq:
      return {may_be_equal, may_be_less || may_be_more};
    case Predicate::une:
    case Predicate::one:
      return {may_be_less || may_be_more, may_be_equal};
    case Predicate::ord:
      return {true, false};
    case Predicate::uno:
      return {false, true};
    default:
      return {};
  }
}

}  // namespace veritrack::model::code

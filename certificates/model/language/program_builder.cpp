#include "certificates/model/language/program_builder.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace veritrack::certificates::language {

using trackers::Instruction;
using trackers::Operation;

ProgramBuilder::ProgramBuilder(const Constants& constants, int other_inputs) : constants_(&constants) {
  result_.program = trackers::StraightLineProgram(static_cast<int>(constants.size()) + other_inputs);
}

Term ProgramBuilder::append(const Instruction& instruction) {
  const int place = result_.program.append(instruction);
  if (result_.program.instructions().size() > result_.positions.size()) {
    result_.positions.push_back(position_);
  }
  return Term::of_register(place);
}

int ProgramBuilder::place_of(Term term) const {
  return term.is_zero() || term.is_one() ? literal(term.is_zero() ? "0" : "1").place() : term.place();
}

Term ProgramBuilder::literal(const std::string& text) const {
  for (std::size_t i = 0; i < constants_->size(); ++i) {
    if ((*constants_)[i].name == text) {
      return Term::of_register(static_cast<int>(i));
    }
  }
  throw std::logic_error("the literal " + text + " is not among the constants");
}

Term ProgramBuilder::add(Term a, Term b) {
  if (a.is_zero() || b.is_zero()) {
    return a.is_zero() ? b : a;
  }
  return append({Operation::add, place_of(a), place_of(b)});
}

Term ProgramBuilder::subtract(Term a, Term b) {
  if (b.is_zero()) {
    return a;
  }
  return a.is_zero() ? negate(b) : append({Operation::subtract, place_of(a), place_of(b)});
}

Term ProgramBuilder::multiply(Term a, Term b) {
  if (a.is_zero() || b.is_zero()) {
    return Term::zero();
  }
  if (a.is_one() || b.is_one()) {
    return a.is_one() ? b : a;
  }
  return append({Operation::multiply, place_of(a), place_of(b)});
}

Term ProgramBuilder::divide(Term a, Term b) {
  return a.is_zero() || b.is_one() ? a : append({Operation::divide, place_of(a), place_of(b)});
}

Term ProgramBuilder::negate(Term a) {
  return a.is_zero() ? a : append({Operation::negate, place_of(a)});
}

Term ProgramBuilder::apply(Operation operation, Term a) {
  return append({operation, place_of(a)});
}

Differentiated ProgramBuilder::differentiate(const Instruction& instruction,
                                             const std::vector<Differentiated>& registers) {
  const auto operand = [&](int place) -> const Differentiated& {
    return registers[static_cast<std::size_t>(place)];
  };
  const Differentiated& a = operand(instruction.first);
  const bool has_second = instruction.second >= 0;
  const Differentiated& b = has_second ? operand(instruction.second) : a;
  const Term value = append({instruction.operation, place_of(a.value), has_second ? place_of(b.value) : -1,
                             instruction.third >= 0 ? place_of(operand(instruction.third).value) : -1,
                             instruction.exponent});
  if (instruction.operation >= Operation::minimum) {
    const Differentiated& c = instruction.third >= 0 ? operand(instruction.third) : a;
    return derivatives_by_branch(instruction, value, {&a, &b, &c});
  }
  Differentiated result{value, {}};
  for (std::size_t i = 0; i < a.derivatives.size(); ++i) {
    const Term da = a.derivatives[i];
    const Term db = b.derivatives[i];
    const bool is_constant = da.is_zero() && (!has_second || db.is_zero());
    result.derivatives.push_back(
        is_constant ? Term::zero() : derivative_of(instruction, value, {a.value, da}, {b.value, db}));
  }
  return result;
}

// Instructions are appended one statement after the other, or one inside the other: the arguments of a call
// are evaluated in an order of the compiler's choice.
Term ProgramBuilder::derivative_of(const Instruction& instruction, Term value, const Slope& first,
                                   const Slope& second) {
  const auto [a, da] = first;
  const auto [b, db] = second;
  switch (instruction.operation) {
    case Operation::add:
      return add(da, db);
    case Operation::subtract:
      return subtract(da, db);
    case Operation::multiply: {
      const Term right = multiply(a, db);
      return add(multiply(da, b), right);
    }
    case Operation::divide:
      return divide(subtract(da, multiply(value, db)), b);
    case Operation::negate:
      return negate(da);
    case Operation::power:
      return multiply(slope_of_power(a, instruction.exponent), da);
    case Operation::sqrt:
      return divide(da, multiply(literal("2"), value));
    case Operation::exp:
      return multiply(value, da);
    case Operation::log:
      return divide(da, a);
    case Operation::sin:
      return multiply(apply(Operation::cos, a), da);
    case Operation::cos:
      return negate(multiply(apply(Operation::sin, a), da));
    case Operation::tan:
      return multiply(add(Term::one(), square(value)), da);
    case Operation::asin:
      return divide(da, apply(Operation::sqrt, subtract(Term::one(), square(a))));
    case Operation::acos:
      return negate(divide(da, apply(Operation::sqrt, subtract(Term::one(), square(a)))));
    case Operation::atan:
      return divide(da, add(Term::one(), square(a)));
    case Operation::atan2: {
      const Term square_of_b = square(b);
      const Term length = add(square(a), square_of_b);
      const Term right = multiply(a, db);
      return divide(subtract(multiply(b, da), right), length);
    }
    default:
      return da;  // of stays_within
  }
}

Term ProgramBuilder::choose(Term positive, Term a, Term b) {
  if ((a.is_zero() && b.is_zero()) || (a.is_one() && b.is_one())) {
    return a;
  }
  const int at_positive = place_of(a);
  return append({Operation::choose, place_of(positive), at_positive, place_of(b)});
}

// The branch that is taken: each condition is that of the value.
Differentiated ProgramBuilder::derivatives_by_branch(const Instruction& instruction, Term value,
                                                     const std::vector<const Differentiated*>& operands) {
  Differentiated result{value, {}};
  const Differentiated& a = *operands[0];
  const Term zero = Term::zero();
  for (std::size_t i = 0; i < a.derivatives.size(); ++i) {
    const Term da = a.derivatives[i];
    const Term db = operands[1]->derivatives[i];
    const Term dc = operands[2]->derivatives[i];
    Term slope = zero;
    switch (instruction.operation) {
      case Operation::minimum:
      case Operation::maximum: {
        const bool is_minimum = instruction.operation == Operation::minimum;
        const Term left = is_minimum ? a.value : operands[1]->value;
        const Term right = is_minimum ? operands[1]->value : a.value;
        slope = da.is_zero() && db.is_zero() ? zero : choose(subtract(left, right), db, da);
        break;
      }
      case Operation::absolute:
        slope = da.is_zero() ? zero : choose(a.value, da, negate(da));
        break;
      case Operation::clamp:
        if (!da.is_zero() || !db.is_zero() || !dc.is_zero()) {
          const Term inside = choose(subtract(a.value, operands[2]->value), dc, da);
          slope = choose(subtract(operands[1]->value, a.value), db, inside);
        }
        break;
      case Operation::choose:
        slope = choose(a.value, db, dc);
        break;
      default:
        break;  // a sign
    }
    result.derivatives.push_back(slope);
  }
  return result;
}

Term ProgramBuilder::square(Term a) {
  return append({Operation::power, place_of(a), -1, -1, 2});
}

Term ProgramBuilder::slope_of_power(Term base, int exponent) {
  if (exponent <= 1) {
    return exponent == 0 ? Term::zero() : Term::one();
  }
  const Term lower = exponent == 2 ? base : append({Operation::power, place_of(base), -1, -1, exponent - 1});
  return multiply(literal(std::to_string(exponent)), lower);
}

std::vector<Differentiated> ProgramBuilder::run(const CompiledProgram& compiled,
                                                const std::vector<Differentiated>& inputs) {
  const std::size_t states = inputs.empty() ? 0 : inputs.front().derivatives.size();
  std::vector<Differentiated> registers;
  registers.reserve(static_cast<std::size_t>(compiled.program.registers()));
  for (std::size_t i = 0; i < constants_->size(); ++i) {
    registers.push_back({Term::of_register(static_cast<int>(i)), std::vector<Term>(states, Term::zero())});
  }
  registers.insert(registers.end(), inputs.begin(), inputs.end());
  for (std::size_t i = 0; i < compiled.program.instructions().size(); ++i) {
    position_ = compiled.positions[i];
    registers.push_back(differentiate(compiled.program.instructions()[i], registers));
    const auto named = compiled.names.find(compiled.program.inputs() + static_cast<int>(i));
    if (named != compiled.names.end() && named->second.back() != '\'') {
      name(registers.back().value, named->second);
    }
  }
  for (const int limit : compiled.program.limits()) {
    result_.program.add_limit(place_of(registers[static_cast<std::size_t>(limit)].value));
  }
  std::vector<Differentiated> results;
  results.reserve(compiled.program.results().size());
  for (const int place : compiled.program.results()) {
    results.push_back(registers[static_cast<std::size_t>(place)]);
  }
  return results;
}

void ProgramBuilder::name(Term term, const std::string& name) {
  if (!term.is_zero() && !term.is_one()) {
    result_.names.try_emplace(term.place(), name);
    result_.places.try_emplace(name, term.place());
  }
}

void ProgramBuilder::add_result(Term term) {
  result_.program.add_result(place_of(term));
}

}  // namespace veritrack::certificates::language

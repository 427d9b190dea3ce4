// Operations of LLVM on numbers, integers, bits and addresses.
#include <llvm/IR/Constants.h>
#include <llvm/IR/InstrTypes.h>

#include <algorithm>
#include <utility>

#include "lift/executor.hpp"
#include "lift/opcodes.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;

Value part_of(const Value& value, std::size_t i) {
  const auto* parts = value.as<Parts>();
  if (parts == nullptr && !value.is_undefined()) {
    throw LiftError("a vector that is not followed");
  }
  return parts == nullptr ? Value(Undefined{}) : parts->parts.at(i);
}

/// For each element of vectors, or for scalars.
template <typename OnScalars>
Value for_each_element(llvm::Type* type, bool has_elements, llvm::ArrayRef<Value> operands,
                       const OnScalars& on_scalars) {
  if (!has_elements) {
    return on_scalars(type, operands);
  }
  Parts parts;
  for (unsigned i = 0; i < llvm::cast<llvm::FixedVectorType>(type)->getNumElements(); ++i) {
    std::vector<Value> elements;
    for (const Value& operand : operands) {
      elements.push_back(part_of(operand, i));
    }
    parts.parts.push_back(on_scalars(type->getScalarType(), elements));
  }
  return parts;
}

[[noreturn]] void refuse_undefined() {
  throw LiftError(
      "a value that is not defined is used; allowed: variables that are set before they are read");
}

/// The aggregate with another value at a path of numbers.
Value inserted(llvm::Type* type, const Value& aggregate, const Value& value, llvm::ArrayRef<unsigned> path) {
  if (path.empty()) {
    return value;
  }
  const auto* held = aggregate.as<Parts>();
  Parts parts;
  if (held != nullptr) {
    parts = *held;
  } else {
    const bool is_structure = type->isStructTy();
    parts.parts.resize(is_structure ? type->getStructNumElements() : type->getArrayNumElements());
  }
  llvm::Type* element =
      type->isStructTy() ? type->getStructElementType(path.front()) : type->getArrayElementType();
  parts.parts.at(path.front()) = inserted(element, parts.parts.at(path.front()), value, path.drop_front());
  return parts;
}

}  // namespace

Value Executor::arithmetic(Frame& frame, const llvm::Instruction& instruction) {
  refuse_fast_math(instruction);
  const auto value = [&](unsigned i) { return operand(frame, instruction.getOperand(i)); };
  if (const auto* cast_of = llvm::dyn_cast<llvm::CastInst>(&instruction)) {
    return cast(*cast_of, value(0));
  }
  if (const auto* comparison = llvm::dyn_cast<llvm::CmpInst>(&instruction)) {
    return compare(*comparison, value(0), value(1));
  }
  if (llvm::isa<llvm::SelectInst>(instruction)) {
    return for_each_element(instruction.getType(), instruction.getOperand(0)->getType()->isVectorTy(),
                            {value(0), value(1), value(2)}, [&](llvm::Type*, llvm::ArrayRef<Value> of) {
                              const auto* number = of[0].as<Register>();
                              if (number == nullptr) {
                                refuse_undefined();
                              }
                              return memory_.select(number->number, of[1], of[2]);
                            });
  }
  if (llvm::isa<llvm::FreezeInst>(instruction)) {
    return frozen(instruction.getType(), value(0));
  }
  if (const auto* extract = llvm::dyn_cast<llvm::ExtractValueInst>(&instruction)) {
    Value part = value(0);
    for (const unsigned i : extract->indices()) {
      part = part_of(part, i);
    }
    return part;
  }
  if (const auto* insert = llvm::dyn_cast<llvm::InsertValueInst>(&instruction)) {
    return inserted(insert->getType(), value(0), value(1), insert->getIndices());
  }
  if (llvm::isa<llvm::ExtractElementInst>(instruction) || llvm::isa<llvm::InsertElementInst>(instruction)) {
    const bool inserts = llvm::isa<llvm::InsertElementInst>(instruction);
    const Value vector = value(0);
    const Value place = value(inserts ? 2 : 1);
    const auto* number = place.as<Register>();
    const auto* held = vector.as<Parts>();
    if (number == nullptr || !graph_.is_known(number->number)) {
      throw LiftError("an element of a vector at an index that depends on the state");
    }
    const auto i = static_cast<std::size_t>(graph_.bits(number->number));
    if (!inserts) {
      return held == nullptr ? Value(Undefined{}) : held->parts.at(i);
    }
    Parts parts = held == nullptr ? Parts{} : *held;
    parts.parts.resize(llvm::cast<llvm::FixedVectorType>(instruction.getType())->getNumElements());
    parts.parts.at(i) = value(1);
    return parts;
  }
  std::vector<Value> operands;
  for (unsigned i = 0; i < instruction.getNumOperands(); ++i) {
    operands.push_back(value(i));
  }
  return for_each_element(
      instruction.getType(), instruction.getType()->isVectorTy(), operands,
      [&](llvm::Type* type, llvm::ArrayRef<Value> of) { return on_scalars(instruction, type, of); });
}

/// A value that may be any becomes one.
Value Executor::frozen(llvm::Type* type, const Value& value) {
  const auto* held = value.as<Parts>();
  if (held == nullptr) {
    const bool is_number = type->isIntegerTy() || type->isFloatTy() || type->isDoubleTy();
    if (value.is_undefined() && !is_number) {
      refuse_undefined();
    }
    return value.is_undefined() ? Value(Register{graph_.constant(memory_.format_of(type), 0)}) : value;
  }
  Parts parts;
  for (const Value& part : held->parts) {
    parts.parts.push_back(frozen(type->getScalarType(), part));
  }
  return parts;
}

Value Executor::on_scalars(const llvm::Instruction& instruction, llvm::Type* type,
                           llvm::ArrayRef<Value> operands) {
  const Operation operation = operation_of(instruction.getOpcode());
  std::vector<int> numbers;
  for (const Value& operand : operands) {
    const auto* number = operand.as<Register>();
    if (operand.is_undefined()) {
      refuse_undefined();
    } else if (number == nullptr) {
      return on_pointers(instruction, operands.front(), operands.back());
    } else {
      numbers.push_back(number->number);
    }
  }
  const int result = graph_.make(operation, memory_.format_of(type), numbers);
  require_defined(instruction, numbers, result);
  return Register{result};
}

Value Executor::on_pointers(const llvm::Instruction& instruction, const Value& a, const Value& b) {
  const unsigned opcode = instruction.getOpcode();
  const auto* x = a.as<Address>();
  const auto* y = b.as<Address>();
  if (opcode == llvm::Instruction::Sub && x != nullptr && y != nullptr && x->object == y->object &&
      x->index < 0 && y->index < 0) {
    return Register{graph_.constant({false, 64}, static_cast<std::uint64_t>(x->offset - y->offset))};
  }
  const auto* distance = b.as<Register>();
  if (x != nullptr && distance != nullptr && graph_.is_known(distance->number) &&
      (opcode == llvm::Instruction::Add || opcode == llvm::Instruction::Sub)) {
    const std::int64_t offset = graph_.signed_bits(distance->number);
    return moved(a, opcode == llvm::Instruction::Add ? offset : -offset, -1, 0);
  }
  throw LiftError("arithmetic on pointers that is not followed");
}

Value Executor::cast(const llvm::CastInst& instruction, const Value& value) {
  llvm::Type* to = instruction.getDestTy();
  const auto opcode = instruction.getOpcode();
  const bool keeps_addresses =
      opcode == llvm::Instruction::BitCast || opcode == llvm::Instruction::PtrToInt ||
      opcode == llvm::Instruction::IntToPtr || opcode == llvm::Instruction::AddrSpaceCast;
  const bool is_number = value.as<Register>() != nullptr || value.as<Parts>() != nullptr;
  if (keeps_addresses && !is_number) {
    if (!value.is_undefined() && to->isIntegerTy() && to->getIntegerBitWidth() < 32) {
      throw LiftError("a part of a pointer is used as an integer");
    }
    return value;
  }
  if (opcode == llvm::Instruction::BitCast) {
    const auto* number = value.as<Register>();
    if (number == nullptr || to->isVectorTy()) {
      return cast_vector(instruction, value);
    }
    return Register{graph_.reinterpreted(number->number, memory_.format_of(to))};
  }
  return for_each_element(to, to->isVectorTy(), {value},
                          [&](llvm::Type* type, llvm::ArrayRef<Value> of) -> Value {
                            const auto* number = of[0].as<Register>();
                            if (type->isPointerTy() && number != nullptr) {
                              if (graph_.is_known(number->number) && graph_.bits(number->number) == 0) {
                                return Address{};
                              }
                              throw LiftError("an integer is used as a pointer");
                            }
                            if (number == nullptr && !of[0].is_undefined()) {
                              throw LiftError("a part of a pointer is used as an integer");
                            }
                            return on_scalars(instruction, type, of);
                          });
}

/// The bits of a vector as those of another, or of a scalar: known ones, or element by element.
Value Executor::cast_vector(const llvm::CastInst& instruction, const Value& value) {
  llvm::Type* from = instruction.getSrcTy();
  llvm::Type* to = instruction.getDestTy();
  const int scratch = memory_.add({"a value", nullptr, false, true, memory_.size_of(from)});
  const Address place{scratch, 0, -1, 0};
  memory_.store(place, from, value);
  return memory_.load(place, to);
}

Value Executor::compare(const llvm::CmpInst& instruction, const Value& a, const Value& b) {
  llvm::Type* compared = instruction.getOperand(0)->getType();
  const auto on_elements = [&](llvm::Type* /*type*/, llvm::ArrayRef<Value> of) -> Value {
    std::vector<int> numbers;
    for (const Value& operand : of) {
      const auto* number = operand.as<Register>();
      if (operand.is_undefined()) {
        refuse_undefined();
      }
      if (number == nullptr) {
        return compare_pointers(instruction.getPredicate(), of[0], of[1]);
      }
      numbers.push_back(number->number);
    }
    const Operation operation = llvm::isa<llvm::FCmpInst>(instruction) ? Operation::fcmp : Operation::icmp;
    return Register{graph_.make(operation, kBit, numbers, predicate_of(instruction.getPredicate()))};
  };
  return for_each_element(instruction.getType(), compared->isVectorTy(), {a, b}, on_elements);
}

Value Executor::compare_pointers(llvm::CmpInst::Predicate predicate, const Value& a, const Value& b) {
  if (const auto* choice = a.as<Choice>()) {
    return memory_.select(choice->condition, compare_pointers(predicate, *choice->yes, b),
                          compare_pointers(predicate, *choice->no, b));
  }
  if (const auto* choice = b.as<Choice>()) {
    return memory_.select(choice->condition, compare_pointers(predicate, a, *choice->yes),
                          compare_pointers(predicate, a, *choice->no));
  }
  using Cmp = llvm::CmpInst;
  const auto* x = a.as<Address>();
  const auto* y = b.as<Address>();
  const auto is_known = [&](const Value& value, const Address* address) {
    return (address != nullptr && address->index < 0) || value.as<FunctionAddress>() != nullptr;
  };
  if ((predicate == Cmp::ICMP_EQ || predicate == Cmp::ICMP_NE) &&
      (a == b || (is_known(a, x) && is_known(b, y)))) {
    return Register{graph_.bit((a == b) == (predicate == Cmp::ICMP_EQ))};
  }
  if (x == nullptr || y == nullptr || x->object != y->object || x->index >= 0 || y->index >= 0) {
    throw LiftError("a comparison of pointers that are not into the same object");
  }
  const int left = graph_.constant({false, 64}, static_cast<std::uint64_t>(x->offset));
  const int right = graph_.constant({false, 64}, static_cast<std::uint64_t>(y->offset));
  return Register{graph_.make(Operation::icmp, kBit, {left, right}, predicate_of(predicate))};
}

}  // namespace veritrack::lift

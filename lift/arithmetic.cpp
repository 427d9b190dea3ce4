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

/// For each element of vectors, or for two scalars.
template <typename OnScalars>
Value for_each_element(llvm::Type* type, const Value& a, const Value& b, const OnScalars& on_scalars) {
  if (!type->isVectorTy()) {
    return on_scalars(type, a, b);
  }
  const auto* x = a.as<Parts>();
  const auto* y = b.as<Parts>();
  if (x == nullptr || y == nullptr) {
    return Undefined{};
  }
  Parts parts;
  for (std::size_t i = 0; i < x->parts.size(); ++i) {
    parts.parts.push_back(on_scalars(type->getScalarType(), x->parts[i], y->parts.at(i)));
  }
  return parts;
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
    const Value condition = value(0);
    const auto* number = condition.as<Register>();
    return number == nullptr ? Value(Undefined{}) : memory_.select(number->number, value(1), value(2));
  }
  if (llvm::isa<llvm::FreezeInst>(instruction)) {
    return value(0);
  }
  if (const auto* extract = llvm::dyn_cast<llvm::ExtractValueInst>(&instruction)) {
    Value part = value(0);
    for (const unsigned i : extract->indices()) {
      const auto* parts = part.as<Parts>();
      part = parts == nullptr ? Value(Undefined{}) : Value(parts->parts.at(i));
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
  const Value a = value(0);
  const Value b = instruction.getNumOperands() > 1 ? value(1) : a;
  return for_each_element(instruction.getType(), a, b, [&](llvm::Type* type, const Value& x, const Value& y) {
    return on_scalars(instruction, type, x, y);
  });
}

Value Executor::on_scalars(const llvm::Instruction& instruction, llvm::Type* type, const Value& a,
                           const Value& b) {
  const auto* x = a.as<Register>();
  const auto* y = b.as<Register>();
  if (x == nullptr || y == nullptr) {
    return a.is_undefined() || b.is_undefined() ? Value(Undefined{}) : on_pointers(instruction, a, b);
  }
  std::vector<int> operands{x->number};
  if (instruction.getNumOperands() > 1) {
    operands.push_back(y->number);
  }
  return Register{graph_.make(operation_of(instruction.getOpcode()), memory_.format_of(type), operands)};
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
  if (value.is_undefined() || (keeps_addresses && !value.as<Register>() && !value.as<Parts>())) {
    return value;
  }
  if (opcode == llvm::Instruction::BitCast) {
    const auto* number = value.as<Register>();
    if (number == nullptr || to->isVectorTy()) {
      return cast_vector(instruction, value);
    }
    return Register{graph_.reinterpreted(number->number, memory_.format_of(to))};
  }
  return for_each_element(
      to, value, value, [&](llvm::Type* type, const Value& element, const Value&) -> Value {
        const auto* number = element.as<Register>();
        if (number == nullptr) {
          return Undefined{};
        }
        if (type->isPointerTy()) {
          if (graph_.is_known(number->number) && graph_.bits(number->number) == 0) {
            return Address{};
          }
          throw LiftError("an integer is used as a pointer");
        }
        return Register{graph_.make(operation_of(opcode), memory_.format_of(type), {number->number})};
      });
}

/// The bits of a vector as those of another, or of a scalar: known ones, or element by element.
Value Executor::cast_vector(const llvm::CastInst& instruction, const Value& value) {
  llvm::Type* from = instruction.getSrcTy();
  llvm::Type* to = instruction.getDestTy();
  const int scratch = memory_.add({"a value", nullptr, false, memory_.size_of(from)});
  const Address place{scratch, 0, -1, 0};
  memory_.store(place, from, value);
  return memory_.load(place, to);
}

Value Executor::compare(const llvm::CmpInst& instruction, const Value& a, const Value& b) {
  return for_each_element(instruction.getOperand(0)->getType(), a, b,
                          [&](llvm::Type* /*type*/, const Value& left, const Value& right) -> Value {
                            if (left.is_undefined() || right.is_undefined()) {
                              return Undefined{};
                            }
                            const auto* x = left.as<Register>();
                            const auto* y = right.as<Register>();
                            if (x == nullptr || y == nullptr) {
                              return compare_pointers(instruction.getPredicate(), left, right);
                            }
                            const Operation operation =
                                llvm::isa<llvm::FCmpInst>(instruction) ? Operation::fcmp : Operation::icmp;
                            return Register{graph_.make(operation, kBit, {x->number, y->number},
                                                        predicate_of(instruction.getPredicate()))};
                          });
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
  if (predicate == Cmp::ICMP_EQ || predicate == Cmp::ICMP_NE) {
    return Register{graph_.bit((a == b) == (predicate == Cmp::ICMP_EQ))};
  }
  const auto* x = a.as<Address>();
  const auto* y = b.as<Address>();
  if (x == nullptr || y == nullptr || x->object != y->object || x->index >= 0 || y->index >= 0) {
    throw LiftError("a comparison of pointers that are not into the same object");
  }
  const int left = graph_.constant({false, 64}, static_cast<std::uint64_t>(x->offset));
  const int right = graph_.constant({false, 64}, static_cast<std::uint64_t>(y->offset));
  return Register{graph_.make(Operation::icmp, kBit, {left, right}, predicate_of(predicate))};
}

}  // namespace veritrack::lift

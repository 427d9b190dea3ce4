#include "lift/memory.hpp"

#include <llvm/IR/Constants.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/GlobalAlias.h>
#include <llvm/IR/Operator.h>

#include <algorithm>
#include <utility>

namespace veritrack::lift {

namespace {

constexpr std::int64_t kMostBytes = 1 << 20;  // of an object

/// Whether an expression is the same address in another type.
bool keeps_bits(const llvm::ConstantExpr* expression) {
  using Op = llvm::Instruction;
  constexpr unsigned kFewBits = 32;
  const unsigned opcode = expression == nullptr ? 0 : expression->getOpcode();
  return opcode == Op::BitCast || opcode == Op::AddrSpaceCast || opcode == Op::IntToPtr ||
         (opcode == Op::PtrToInt && expression->getType()->getScalarSizeInBits() >= kFewBits);
}

bool is_aggregate(llvm::Type* type) {
  return type->isAggregateType() || type->isVectorTy();
}

}  // namespace

int Memory::add(Object object) {
  if (object.size > kMostBytes) {
    throw LiftError(object.name + " has more than a million bytes");
  }
  objects_.push_back(std::move(object));
  contents_.resize(objects_.size());
  contents_.back() = std::make_shared<Cells>();
  return objects() - 1;
}

const Cells& Memory::cells(int object) const {
  static const Cells none;
  const auto place = static_cast<std::size_t>(object);
  return place < contents_.size() && contents_[place] ? *contents_[place] : none;
}

Cells& Memory::changeable(int object) {
  contents_.resize(objects_.size());
  auto& held = contents_[static_cast<std::size_t>(object)];
  if (!held || held.use_count() > 1) {
    held = std::make_shared<Cells>(cells(object));
  }
  return *held;
}

void Memory::put(int object, std::int64_t offset, Cell cell) {
  Cells& cells = changeable(object);
  make_room(cells, offset, cell.size);
  cells[offset] = std::move(cell);
}

/// Takes away what is at some bytes; cells that stick out are cut, where they are known.
void Memory::make_room(Cells& cells, std::int64_t offset, std::int64_t bytes) {
  const std::int64_t end = offset + bytes;
  auto it = cells.lower_bound(offset);
  if (it != cells.begin() && std::prev(it)->first + std::prev(it)->second.size > offset) {
    --it;
  }
  std::vector<std::pair<std::int64_t, Cell>> cut;
  while (it != cells.end() && it->first < end) {
    const std::int64_t begin = it->first;
    const std::int64_t behind = begin + it->second.size;
    const Value& value = it->second.value;
    if ((begin < offset || behind > end) && !value.is_undefined()) {
      const std::optional<std::uint64_t> bits = known_bits(cells, begin, it->second.size);
      if (!bits) {
        throw LiftError("a part of a value of " + std::to_string(it->second.size) + " bytes is written");
      }
      for (std::int64_t at = begin; at < behind; ++at) {
        if (at < offset || at >= end) {
          const std::uint64_t byte = *bits >> static_cast<unsigned>(8 * (at - begin));
          cut.emplace_back(at, Cell{1, Register{graph_->constant({false, 8}, byte)}});
        }
      }
    }
    it = cells.erase(it);
  }
  cells.insert(cut.begin(), cut.end());
}

std::optional<std::uint64_t> Memory::known_bits(const Cells& cells, std::int64_t offset,
                                                std::int64_t bytes) const {
  std::uint64_t bits = 0;
  for (std::int64_t at = offset; at < offset + bytes; ++at) {
    auto cell = cells.upper_bound(at);
    if (cell == cells.begin() || std::prev(cell)->first + std::prev(cell)->second.size <= at) {
      continue;
    }
    --cell;
    if (cell->second.value.is_undefined()) {
      continue;
    }
    const auto* number = cell->second.value.as<Register>();
    if (number == nullptr || !graph_->is_known(number->number)) {
      return std::nullopt;
    }
    const std::uint64_t byte =
        (graph_->bits(number->number) >> static_cast<unsigned>(8 * (at - cell->first))) & 0xff;
    bits |= byte << static_cast<unsigned>(8 * (at - offset));
  }
  return bits;
}

Format Memory::format_of(llvm::Type* type) const {
  if (type->isFloatTy()) {
    return trackers::code::kSingle;
  }
  if (type->isDoubleTy()) {
    return trackers::code::kDouble;
  }
  if (type->isIntegerTy() && type->getIntegerBitWidth() <= 64) {
    return {false, static_cast<int>(type->getIntegerBitWidth())};
  }
  if (type->isHalfTy() || type->isX86_FP80Ty() || type->isFP128Ty()) {
    throw LiftError(
        "numbers in half, extended or quadruple precision (long double); allowed: float and double");
  }
  throw LiftError("integers of more than 64 bits");
}

std::int64_t Memory::size_of(llvm::Type* type) const {
  return static_cast<std::int64_t>(layout_->getTypeAllocSize(type).getFixedSize());
}

std::int64_t Memory::written_size_of(llvm::Type* type) const {
  return static_cast<std::int64_t>(layout_->getTypeStoreSize(type).getFixedSize());
}

std::pair<llvm::Type*, std::int64_t> Memory::part(llvm::Type* type, unsigned i) const {
  if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    if (i >= structure->getNumElements()) {
      return {nullptr, 0};
    }
    const llvm::StructLayout* layout = layout_->getStructLayout(structure);
    return {structure->getElementType(i), static_cast<std::int64_t>(layout->getElementOffset(i))};
  }
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
    llvm::Type* element = array->getElementType();
    return i < array->getNumElements() ? std::pair(element, i * size_of(element)) : std::pair(nullptr, 0L);
  }
  auto* vector = llvm::cast<llvm::FixedVectorType>(type);
  llvm::Type* element = vector->getElementType();
  if (static_cast<std::int64_t>(layout_->getTypeSizeInBits(element).getFixedSize()) != 8 * size_of(element)) {
    throw LiftError("a vector whose elements are not bytes, in memory");
  }
  return i < vector->getNumElements() ? std::pair(element, i * size_of(element)) : std::pair(nullptr, 0L);
}

Value Memory::constant(const llvm::Constant& constant,
                       const std::map<const llvm::GlobalValue*, int>& globals) {
  llvm::Type* type = constant.getType();
  if (llvm::isa<llvm::UndefValue>(constant)) {  // poison, too
    return Undefined{};
  }
  if (is_aggregate(type)) {
    Parts parts;
    for (unsigned i = 0; part(type, i).first != nullptr; ++i) {
      const llvm::Constant* element = constant.getAggregateElement(i);
      if (element == nullptr) {
        throw LiftError("a constant that is not understood");
      }
      parts.parts.push_back(this->constant(*element, globals));
    }
    return parts;
  }
  if (const auto* integer = llvm::dyn_cast<llvm::ConstantInt>(&constant)) {
    return Register{graph_->constant(format_of(type), integer->getValue().getZExtValue())};
  }
  if (const auto* number = llvm::dyn_cast<llvm::ConstantFP>(&constant)) {
    const Format format = format_of(type);
    return Register{graph_->constant(format, number->getValueAPF().bitcastToAPInt().getZExtValue())};
  }
  if (llvm::isa<llvm::ConstantPointerNull>(constant)) {
    return Address{};
  }
  if (const auto* function = llvm::dyn_cast<llvm::Function>(&constant)) {
    return FunctionAddress{function};
  }
  if (const auto* alias = llvm::dyn_cast<llvm::GlobalAlias>(&constant)) {
    return this->constant(*alias->getAliasee(), globals);
  }
  if (const auto* global = llvm::dyn_cast<llvm::GlobalValue>(&constant)) {
    return Address{globals.at(global), 0, -1, 0};
  }
  if (const auto* gep = llvm::dyn_cast<llvm::GEPOperator>(&constant)) {
    const Value base = this->constant(*llvm::cast<llvm::Constant>(gep->getPointerOperand()), globals);
    llvm::APInt offset(64, 0);
    if (const auto* address = base.as<Address>();
        address != nullptr && gep->accumulateConstantOffset(*layout_, offset)) {
      return Address{address->object, address->offset + offset.getSExtValue(), -1, 0};
    }
  }
  if (const auto* cast = llvm::dyn_cast<llvm::ConstantExpr>(&constant); keeps_bits(cast)) {
    return this->constant(*cast->getOperand(0), globals);
  }
  throw LiftError("a constant that is not understood");
}

void Memory::initialize(int object, std::int64_t offset, const llvm::Constant& constant,
                        const std::map<const llvm::GlobalValue*, int>& globals) {
  llvm::Type* type = constant.getType();
  if (is_aggregate(type)) {
    fill_with_zeros(object, offset, size_of(type));  // padding, too
  }
  const bool read_only = std::exchange(objects_[static_cast<std::size_t>(object)].read_only, false);
  store_at({object, offset, -1, 0}, type, this->constant(constant, globals));
  objects_[static_cast<std::size_t>(object)].read_only = read_only;
}

void Memory::fill_with_zeros(int object, std::int64_t offset, std::int64_t bytes) {
  Cells& cells = changeable(object);
  for (std::int64_t at = offset; at < offset + bytes;) {
    const std::int64_t size = at % 4 == 0 && at + 4 <= offset + bytes ? 4 : 1;
    cells[at] = {size, Register{graph_->constant({false, static_cast<int>(8 * size)}, 0)}};
    at += size;
  }
}

Address Memory::known(const Value& address, const char* purpose) const {
  const auto* place = address.as<Address>();
  if (place == nullptr || place->object < 0) {
    throw LiftError(std::string(purpose) + " through a null or an unknown pointer");
  }
  if (const Object& object = objects_[static_cast<std::size_t>(place->object)]; object.is_gone) {
    throw LiftError(std::string(purpose) + " of " + object.name +
                    (object.global == nullptr         ? ", which is not there any more"
                     : object.global->isDeclaration() ? ", which no file defines"
                                                      : ", whose first value is not understood"));
  }
  return *place;
}

}  // namespace veritrack::lift

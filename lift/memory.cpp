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

bool is_aggregate(llvm::Type* type) {
  return type->isAggregateType() || type->isVectorTy();
}

}  // namespace

int Memory::add(Object object) {
  if (object.size > kMostBytes) {
    throw LiftError(object.name + " has more than a million bytes");
  }
  objects_.push_back(std::move(object));
  contents_.push_back(std::make_shared<const Cells>());
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
  auto copy = std::make_shared<Cells>(cells(object));
  Cells& cells = *copy;
  held = std::move(copy);
  return cells;
}

void Memory::put(int object, std::int64_t offset, Cell cell) {
  Cells& cells = changeable(object);
  const std::int64_t end = offset + cell.size;
  for (auto it = cells.begin(); it != cells.end();) {
    const bool overlaps = it->first < end && it->first + it->second.size > offset;
    it = overlaps ? cells.erase(it) : std::next(it);
  }
  cells[offset] = std::move(cell);
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
  if (const auto* cast = llvm::dyn_cast<llvm::ConstantExpr>(&constant); cast != nullptr && cast->isCast()) {
    return this->constant(*cast->getOperand(0), globals);
  }
  throw LiftError("a constant that is not understood");
}

void Memory::initialize(int object, std::int64_t offset, const llvm::Constant& constant,
                        const std::map<const llvm::GlobalValue*, int>& globals) {
  llvm::Type* type = constant.getType();
  if (constant.isNullValue() && !type->isPointerTy() && is_aggregate(type)) {
    fill_with_zeros(object, offset, size_of(type));
    return;
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
  return *place;
}

Value Memory::select(int condition, const Value& yes, const Value& no) {
  if (yes == no) {
    return yes;
  }
  if (yes.is_undefined() || no.is_undefined()) {
    // An undefined value may be any, also that of the other way.
    return yes.is_undefined() ? no : yes;
  }
  const auto* a = yes.as<Parts>();
  const auto* b = no.as<Parts>();
  if (a != nullptr && b != nullptr) {
    Parts parts;
    for (std::size_t i = 0; i < a->parts.size(); ++i) {
      parts.parts.push_back(select(condition, a->parts[i], b->parts.at(i)));
    }
    return parts;
  }
  const auto* x = yes.as<Register>();
  const auto* y = no.as<Register>();
  if (x != nullptr && y != nullptr) {
    return Register{
        graph_->select(condition, x->number, graph_->reinterpreted(y->number, graph_->format(x->number)))};
  }
  if (x != nullptr || y != nullptr) {
    throw LiftError("a number on one way and a pointer on the other");
  }
  if (graph_->is_known(condition)) {
    return graph_->bits(condition) != 0 ? yes : no;
  }
  return Choice{condition, std::make_shared<const Value>(yes), std::make_shared<const Value>(no)};
}

void Memory::merge(int condition, const Contents& yes, const Contents& no) {
  Contents merged(objects_.size());
  for (std::size_t object = 0; object < merged.size(); ++object) {
    const auto held = [&](const Contents& contents) {
      return object < contents.size() ? contents[object] : nullptr;
    };
    const auto a = held(yes);
    const auto b = held(no);
    if (a == b || !a || !b) {
      merged[object] = a ? a : b;
      continue;
    }
    auto cells = std::make_shared<Cells>(*a);
    for (const auto& [offset, cell] : *b) {
      const auto other = cells->find(offset);
      if (other == cells->end()) {
        const auto overlaps =
            std::any_of(a->begin(), a->end(), [&, at = offset, size = cell.size](const auto& entry) {
              return entry.first < at + size && entry.first + entry.second.size > at;
            });
        if (overlaps) {
          throw LiftError("memory is read in pieces of two sizes in " + objects_[object].name);
        }
        (*cells)[offset] = cell;
      } else if (!(other->second == cell)) {
        if (other->second.size != cell.size) {
          throw LiftError("memory is read in pieces of two sizes in " + objects_[object].name);
        }
        other->second.value = select(condition, other->second.value, cell.value);
      }
    }
    merged[object] = std::move(cells);
  }
  contents_ = std::move(merged);
}

}  // namespace veritrack::lift

// Loads, stores and copies.
#include <algorithm>
#include <optional>

#include "lift/memory.hpp"

namespace veritrack::lift {

namespace {

bool has_parts(llvm::Type* type) {
  return type->isAggregateType() || type->isVectorTy();
}

}  // namespace

Value Memory::load(const Value& address, llvm::Type* type) {
  if (const auto* choice = address.as<Choice>()) {
    return select(choice->condition, load(*choice->yes, type), load(*choice->no, type));
  }
  const Address place = known(address, "a read");
  if (has_parts(type)) {
    Parts parts;
    for (unsigned i = 0; part(type, i).first != nullptr; ++i) {
      const auto [element, offset] = part(type, i);
      Address there = place;
      there.offset += offset;
      parts.parts.push_back(load(there, element));
    }
    return parts;
  }
  return place.index < 0 ? load_scalar(place, type) : load_element(place, type);
}

Value Memory::load_scalar(const Address& address, llvm::Type* type) {
  const Cells& held = cells(address.object);
  const std::int64_t size = size_of(type);
  const auto found = held.find(address.offset);
  if (found == held.end() || found->second.size != size) {
    return load_bytes(held, address.offset, type);
  }
  const auto* number = found->second.value.as<Register>();
  if (number == nullptr || type->isPointerTy()) {
    if (number != nullptr && graph_->is_known(number->number) && graph_->bits(number->number) == 0) {
      return Address{};  // zeros are the null pointer
    }
    return found->second.value;
  }
  Format format = format_of(type);
  if (!format.is_float && format.bits < 8) {  // a bool is kept as a byte
    return Register{graph_->make(Operation::integer_trunc, format, {number->number})};
  }
  return Register{graph_->reinterpreted(number->number, format)};
}

/// Known bytes of several cells, or of a part of one.
Value Memory::load_bytes(const Cells& held, std::int64_t offset, llvm::Type* type) {
  const std::int64_t size = size_of(type);
  std::uint64_t bits = 0;
  for (std::int64_t at = offset; at < offset + size; ++at) {
    auto cell = held.upper_bound(at);
    if (cell == held.begin()) {
      return Undefined{};
    }
    --cell;
    if (cell->first + cell->second.size <= at) {
      return Undefined{};
    }
    const auto* number = cell->second.value.as<Register>();
    if (number == nullptr) {
      return Undefined{};
    }
    if (!graph_->is_known(number->number)) {
      throw LiftError("a part of a value of " + std::to_string(cell->second.size) + " bytes is read");
    }
    const std::uint64_t byte =
        (graph_->bits(number->number) >> static_cast<unsigned>(8 * (at - cell->first))) & 0xff;
    bits |= byte << static_cast<unsigned>(8 * (at - offset));
  }
  if (type->isPointerTy()) {
    return bits == 0 ? Value(Address{}) : Value(Undefined{});
  }
  return Register{graph_->constant(format_of(type), bits)};
}

/// An element of a table of constants. The whole object is the table, as the index is known to be in it only.
Value Memory::load_element(const Address& address, llvm::Type* type) {
  const Format format = format_of(type);
  const Object& object = objects_[static_cast<std::size_t>(address.object)];
  std::vector<std::uint64_t> elements;
  for (std::int64_t at = address.offset; at >= 0 && at + size_of(type) <= object.size; at += address.stride) {
    const Value element = load_scalar({address.object, at, -1, 0}, type);
    const auto* number = element.as<Register>();
    if (number == nullptr || !graph_->is_known(number->number)) {
      throw LiftError("an element of " + object.name +
                      " is read at an index that depends on the state, and the table " +
                      "is not made of constants");
    }
    elements.push_back(graph_->bits(number->number));
  }
  if (elements.empty() || address.stride <= 0) {
    throw LiftError("an index that depends on the state, of something that is no table");
  }
  return Register{graph_->element(format, address.index, elements)};
}

void Memory::store(const Value& address, llvm::Type* type, const Value& value) {
  if (const auto* choice = address.as<Choice>()) {
    const Value old_yes = load(*choice->yes, type);
    const Value old_no = load(*choice->no, type);
    store(*choice->yes, type, select(choice->condition, value, old_yes));
    store(*choice->no, type, select(choice->condition, old_no, value));
    return;
  }
  const Address place = known(address, "a write");
  if (place.index >= 0) {
    throw LiftError("a write to " + objects_[static_cast<std::size_t>(place.object)].name +
                    " at an index that depends on the state");
  }
  store_at(place, type, value);
}

void Memory::store_at(const Address& place, llvm::Type* type, const Value& value) {
  const Object& object = objects_[static_cast<std::size_t>(place.object)];
  if (object.read_only) {
    throw LiftError("a write to the constant " + object.name);
  }
  if (place.offset < 0 || (object.size > 0 && place.offset + size_of(type) > object.size)) {
    throw LiftError("a write outside of " + object.name);
  }
  if (has_parts(type)) {
    const auto* parts = value.as<Parts>();
    for (unsigned i = 0; part(type, i).first != nullptr; ++i) {
      const auto [element, offset] = part(type, i);
      store_at({place.object, place.offset + offset, -1, 0}, element,
               parts != nullptr ? parts->parts.at(i) : Value(Undefined{}));
    }
    return;
  }
  Value kept = value;
  if (const auto* number = value.as<Register>()) {
    const Format format = graph_->format(number->number);
    if (!format.is_float && format.bits % 8 != 0) {
      const int bytes = static_cast<int>(size_of(type));
      kept = Register{graph_->make(Operation::zext, {false, 8 * bytes}, {number->number})};
    }
  }
  put(place.object, place.offset, {size_of(type), kept});
}

void Memory::copy(const Value& to, const Value& from, std::int64_t bytes) {
  if (const auto* choice = from.as<Choice>()) {
    const Contents before = contents_;
    copy(to, *choice->yes, bytes);
    const Contents yes = contents_;
    contents_ = before;
    copy(to, *choice->no, bytes);
    const Contents no = contents_;
    merge(choice->condition, yes, no);
    return;
  }
  const Address source = known(from, "a copy");
  const Address target = known(to, "a copy");
  if (source.index >= 0 || target.index >= 0) {
    throw LiftError("a copy at an index that depends on the state");
  }
  if (objects_[static_cast<std::size_t>(target.object)].read_only) {
    throw LiftError("a copy to a constant");
  }
  std::vector<std::pair<std::int64_t, Cell>> copied;
  for (const auto& [offset, cell] : cells(source.object)) {
    if (offset >= source.offset && offset + cell.size <= source.offset + bytes) {
      copied.emplace_back(offset - source.offset + target.offset, cell);
    } else if (offset < source.offset + bytes && offset + cell.size > source.offset) {
      throw LiftError("a copy that cuts a value");
    }
  }
  Cells& held = changeable(target.object);
  for (auto it = held.begin(); it != held.end();) {
    const bool inside = it->first >= target.offset && it->first < target.offset + bytes;
    it = inside ? held.erase(it) : std::next(it);
  }
  for (const auto& [offset, cell] : copied) {
    put(target.object, offset, cell);
  }
}

void Memory::set(const Value& to, std::uint8_t byte, std::int64_t bytes) {
  const Address place = known(to, "a fill");
  if (place.index >= 0 || byte != 0) {
    throw LiftError(
        "memory is filled with bytes that are not zeros, or at an index that depends on the state");
  }
  Cells& held = changeable(place.object);
  for (auto it = held.begin(); it != held.end();) {
    const bool overlaps = it->first < place.offset + bytes && it->first + it->second.size > place.offset;
    const bool inside = it->first >= place.offset && it->first + it->second.size <= place.offset + bytes;
    if (overlaps && !inside) {
      throw LiftError("a fill that cuts a value");
    }
    it = overlaps ? held.erase(it) : std::next(it);
  }
  fill_with_zeros(place.object, place.offset, bytes);
}

}  // namespace veritrack::lift

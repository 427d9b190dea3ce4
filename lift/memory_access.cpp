// Loads, stores and copies.
#include <algorithm>
#include <optional>
#include <utility>

#include "lift/memory.hpp"

namespace veritrack::lift {

namespace {

bool has_parts(llvm::Type* type) {
  return type->isAggregateType() || type->isVectorTy();
}

void require_inside(const Object& object, std::int64_t offset, std::int64_t bytes) {
  if (bytes < 0 || offset < 0 || offset > object.size || bytes > object.size - offset) {
    throw LiftError("a copy or a fill outside of " + object.name);
  }
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
  const Object& object = objects_[static_cast<std::size_t>(address.object)];
  const std::int64_t size = written_size_of(type);
  if (address.offset < 0 || address.offset + size > object.size) {
    throw LiftError("a read outside of " + object.name);
  }
  const Cells& held = cells(address.object);
  const auto found = held.find(address.offset);
  if (found == held.end() || found->second.size != size) {
    return load_bytes(held, address.offset, type);
  }
  const auto* number = found->second.value.as<Register>();
  if (type->isPointerTy() && number != nullptr) {
    if (!graph_->is_known(number->number) || graph_->bits(number->number) != 0) {
      throw LiftError("a number is used as a pointer");
    }
    return Address{};  // zeros are the null pointer
  }
  if (number == nullptr) {
    const bool may_be_pointer = type->isPointerTy() || (type->isIntegerTy() && size >= 4);
    if (!found->second.value.is_undefined() && !may_be_pointer) {
      throw LiftError("a pointer is used as a number");
    }
    return found->second.value;
  }
  const Format format = format_of(type);
  if (!format.is_float && format.bits % 8 != 0) {  // a bool is kept as a byte
    const int whole = graph_->reinterpreted(number->number, {false, static_cast<int>(8 * size)});
    return Register{graph_->make(Operation::integer_trunc, format, {whole})};
  }
  return Register{graph_->reinterpreted(number->number, format)};
}

/// Known bytes of several cells, or of a part of one.
Value Memory::load_bytes(const Cells& held, std::int64_t offset, llvm::Type* type) {
  const std::int64_t size = written_size_of(type);
  const auto overlaps = [&](const auto& entry) {
    return entry.first < offset + size && entry.first + entry.second.size > offset &&
           !entry.second.value.is_undefined();
  };
  if (std::none_of(held.begin(), held.end(), overlaps)) {
    return Undefined{};
  }
  const std::optional<std::uint64_t> bits = size > 8 ? std::nullopt : known_bits(held, offset, size);
  if (!bits) {
    throw LiftError("a value of " + std::to_string(size) + " bytes is read in pieces, or of pieces");
  }
  if (type->isPointerTy()) {
    if (*bits != 0) {
      throw LiftError("a number is used as a pointer");
    }
    return Address{};
  }
  return Register{graph_->constant(format_of(type), *bits)};
}

/// An element of a table of constants: the whole object behind the address is the table.
Value Memory::load_element(const Address& address, llvm::Type* type) {
  const Format format = format_of(type);
  const Object& object = objects_[static_cast<std::size_t>(address.object)];
  if (address.stride <= 0) {
    throw LiftError("an index that depends on the state, of something that is no table");
  }
  std::vector<std::uint64_t> elements;
  bool is_of_library = false;
  for (std::int64_t at = address.offset; at >= 0 && at + written_size_of(type) <= object.size;
       at += address.stride) {
    const Value element = load_scalar({address.object, at, -1, 0}, type);
    const auto* number = element.as<Register>();
    if (number == nullptr || !graph_->is_free_of_inputs(number->number)) {
      throw LiftError(
          "an element of " + object.name +
          " is read at an index that depends on the state, and the table is not made of "
          "constants; allowed: tables that setup fills, and an index that takes at most 64 values "
          "one after the other");
    }
    is_of_library = is_of_library || !graph_->is_known(number->number);
    elements.push_back(graph_->computed_here(number->number));
  }
  if (elements.empty()) {
    throw LiftError("an index that depends on the state, of something that is no table");
  }
  const Format of_index = graph_->format(address.index);
  const int count = graph_->constant(of_index, elements.size());
  if (graph_->bits(count) == elements.size()) {  // an index of few bits is always inside of a large table
    require_zero_(graph_->make(Operation::icmp, trackers::code::kBit, {address.index, count}, Predicate::uge),
                  "an index is inside its table");
  }
  return Register{graph_->element(format, address.index, elements, is_of_library)};
}

void Memory::store(const Value& address, llvm::Type* type, const Value& value) {
  if (const auto* choice = address.as<Choice>()) {
    // Both may be the same place: what is there is read after the first write.
    store(*choice->yes, type, select(choice->condition, value, load(*choice->yes, type)));
    store(*choice->no, type, select(choice->condition, load(*choice->no, type), value));
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
  if (place.offset < 0 || (place.offset + written_size_of(type) > object.size)) {
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
      const int bytes = static_cast<int>(written_size_of(type));
      kept = Register{graph_->make(Operation::zext, {false, 8 * bytes}, {number->number})};
    }
  }
  put(place.object, place.offset, {written_size_of(type), kept});
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
  require_inside(objects_[static_cast<std::size_t>(source.object)], source.offset, bytes);
  std::vector<std::pair<std::int64_t, Cell>> copied;
  for (const auto& [offset, cell] : cells(source.object)) {
    if (offset >= source.offset && offset + cell.size <= source.offset + bytes) {
      copied.emplace_back(offset - source.offset + target.offset, cell);
    } else if (offset < source.offset + bytes && offset + cell.size > source.offset) {
      throw LiftError("a copy of a part of a value");
    }
  }
  require_inside(objects_[static_cast<std::size_t>(target.object)], target.offset, bytes);
  make_room(changeable(target.object), target.offset, bytes);
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
  const Object& object = objects_[static_cast<std::size_t>(place.object)];
  require_inside(object, place.offset, bytes);
  if (object.read_only) {
    throw LiftError("a write to the constant " + object.name);
  }
  make_room(changeable(place.object), place.offset, bytes);
  fill_with_zeros(place.object, place.offset, bytes);
}

}  // namespace veritrack::lift

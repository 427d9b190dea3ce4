// Two ways meet: what each has left becomes one value, or one memory.
#include <iterator>
#include <optional>
#include <utility>

#include "lift/memory.hpp"

namespace veritrack::lift {

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
    const int number = x != nullptr ? x->number : y->number;
    if (!graph_->is_known(number) || graph_->bits(number) != 0) {
      throw LiftError("a number on one way and a pointer on the other");
    }
    return x != nullptr ? select(condition, Address{}, no) : select(condition, yes, Address{});
  }
  if (graph_->is_known(condition)) {
    return graph_->bits(condition) != 0 ? yes : no;
  }
  return Choice{condition, std::make_shared<const Value>(yes), std::make_shared<const Value>(no)};
}

/// Known bytes take the sizes of the cells of the other way: those of smaller ones, or of what is not known.
void Memory::reshape(Cells& cells, const Cells& like) {
  for (const auto& [offset, cell] : like) {
    const std::int64_t end = offset + cell.size;
    auto first = cells.lower_bound(offset);
    if (first != cells.begin() && std::prev(first)->first + std::prev(first)->second.size > offset) {
      --first;
    }
    const bool is_there = first != cells.end() && first->first < end;
    if (!is_there || cell.size > 8 || (first->first == offset && first->second.size == cell.size)) {
      continue;
    }
    const bool is_inside = first->first <= offset && first->first + first->second.size >= end;
    bool is_known = is_inside || !known_bits(like, offset, cell.size);
    for (auto it = first; it != cells.end() && it->first < end; ++it) {
      is_known = is_known && known_bits(cells, it->first, it->second.size).has_value();
    }
    if (is_known) {
      const std::uint64_t bits = *known_bits(cells, offset, cell.size);
      make_room(cells, offset, cell.size);
      cells[offset] = {cell.size, Register{graph_->constant({false, static_cast<int>(8 * cell.size)}, bits)}};
    }
  }
}

Cells Memory::merged(int condition, Cells yes, Cells no, const std::string& name) {
  for (int i = 0; i < 2; ++i) {  // cells that are split may then be put together
    reshape(yes, no);
    reshape(no, yes);
  }
  Cells result = yes;
  for (const auto& [offset, cell] : no) {
    const auto other = yes.find(offset);
    if (other != yes.end() && other->second.size == cell.size) {
      result[offset].value = select(condition, other->second.value, cell.value);
      continue;
    }
    const auto behind = yes.lower_bound(offset + cell.size);
    if (behind != yes.begin() && std::prev(behind)->first + std::prev(behind)->second.size > offset) {
      throw LiftError("memory is used in pieces of two sizes in " + name);
    }
    result[offset] = cell;  // undefined on the other way
  }
  return result;
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
    auto cells = std::make_shared<Cells>(this->merged(condition, *a, *b, objects_[object].name));
    merged[object] = std::move(cells);
  }
  contents_ = std::move(merged);
}

}  // namespace veritrack::lift

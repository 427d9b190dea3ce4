// Two ways meet: what each has left becomes one value, or one memory.
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

/// Cells of known bytes take the size of those of the other way.
Cells Memory::merged(int condition, const Cells& yes, const Cells& no, const std::string& name) {
  Cells result;
  auto a = yes.begin();
  auto b = no.begin();
  while (a != yes.end() || b != no.end()) {
    const bool has_a = a != yes.end() && (b == no.end() || a->first <= b->first);
    const bool has_b = b != no.end() && (a == yes.end() || b->first <= a->first);
    if (has_a && has_b && a->second.size == b->second.size) {
      const Value value = select(condition, a->second.value, b->second.value);
      result.emplace(a->first, Cell{a->second.size, value});
      ++a;
      ++b;
      continue;
    }
    const bool takes_a = has_a && (!has_b || a->second.size > b->second.size);
    const auto [offset, cell] = takes_a ? *a : *b;
    auto& others = takes_a ? b : a;
    const auto end_of_others = takes_a ? no.end() : yes.end();
    const std::int64_t end = offset + cell.size;
    Value other;
    if (others != end_of_others && others->first < end) {
      const std::optional<std::uint64_t> bits = known_bits(takes_a ? no : yes, offset, cell.size);
      while (others != end_of_others && others->first + others->second.size <= end) {
        ++others;
      }
      if (!bits || cell.size > 8 || (others != end_of_others && others->first < end)) {
        throw LiftError("memory is used in pieces of two sizes in " + name);
      }
      other = Register{graph_->constant({false, static_cast<int>(8 * cell.size)}, *bits)};
    }
    const Value value = takes_a ? select(condition, cell.value, other) : select(condition, other, cell.value);
    result.emplace(offset, Cell{cell.size, value});
    ++(takes_a ? a : b);
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

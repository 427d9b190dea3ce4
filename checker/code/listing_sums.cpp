// Sums and products of a formula and of a listing, whatever their parentheses.
#include "checker/code/listing_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

using SumKind = FormulaStep::Kind;

constexpr std::size_t kMostTerms = 200;

/// Each of the places is that of one of the nodes.
template <typename Node, typename Place, typename Same>
bool pair_up(const std::vector<Node>& nodes, const std::vector<Place>& places, const Same& same) {
  if (nodes.size() != places.size()) {
    return false;
  }
  std::vector<bool> is_taken(nodes.size(), false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    bool is_found = false;
    for (std::size_t k = 0; k < nodes.size() && !is_found; ++k) {
      const std::size_t j = (i + k) % nodes.size();  // most often they are in the same order
      is_found = !is_taken[j] && same(nodes[j], places[i]);
      is_taken[j] = is_taken[j] || is_found;
    }
    if (!is_found) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<ListingMatch::Signed> ListingMatch::terms_of_node(int node) const {
  std::vector<Signed> terms;
  std::vector<Signed> waiting{{node, false}};
  while (!waiting.empty()) {
    if (terms.size() + waiting.size() > kMostTerms) {
      return {};
    }
    const Signed next = waiting.back();
    waiting.pop_back();
    const int of = graph_->without_limits(next.of);
    const FormulaNode& formula = graph_->at(of);
    if (formula.kind == SumKind::add || formula.kind == SumKind::subtract) {
      waiting.push_back({formula.arguments[1], next.is_negative != (formula.kind == SumKind::subtract)});
      waiting.push_back({formula.arguments[0], next.is_negative});
    } else if (formula.kind == SumKind::negate) {
      waiting.push_back({formula.arguments[0], !next.is_negative});
    } else {
      terms.push_back({of, next.is_negative});
    }
  }
  return terms;
}

std::vector<ListingMatch::Signed> ListingMatch::terms_of_register(int place) const {
  std::vector<Signed> terms;
  std::vector<Signed> waiting{{place, false}};
  while (!waiting.empty()) {
    if (terms.size() + waiting.size() > kMostTerms) {
      return {};
    }
    const Signed next = waiting.back();
    waiting.pop_back();
    const int of = wraps_.plain(next.of);
    const ListedOperation& operation = listing_->at(of);
    if (operation.is("fadd") || operation.is("fsub")) {
      waiting.push_back({operation.operands[1], next.is_negative != operation.is("fsub")});
      waiting.push_back({operation.operands[0], next.is_negative});
    } else if (operation.is("fneg")) {
      waiting.push_back({operation.operands[0], !next.is_negative});
    } else {
      terms.push_back({of, next.is_negative != (operation.is_number() && operation.number < 0.0)});
    }
  }
  return terms;
}

ListingMatch::Factors ListingMatch::factors_of_node(int node) const {
  Factors factors;
  std::vector<int> waiting{node};
  while (!waiting.empty()) {
    if (factors.above.size() + waiting.size() > kMostTerms) {
      return {};
    }
    const int of = graph_->without_limits(waiting.back());
    waiting.pop_back();
    const FormulaNode& formula = graph_->at(of);
    if (formula.kind == SumKind::multiply) {
      waiting.push_back(formula.arguments[1]);
      waiting.push_back(formula.arguments[0]);
    } else if (formula.kind == SumKind::divide) {
      factors.below.push_back(formula.arguments[1]);
      waiting.push_back(formula.arguments[0]);
    } else if (formula.kind == SumKind::negate) {
      factors.is_negative = !factors.is_negative;
      waiting.push_back(formula.arguments[0]);
    } else if (formula.kind == SumKind::power) {
      waiting.insert(waiting.end(), static_cast<std::size_t>(formula.exponent), formula.arguments[0]);
    } else {
      factors.above.push_back(of);
    }
  }
  return factors;
}

ListingMatch::Factors ListingMatch::factors_of_registers(std::vector<int> places,
                                                         std::vector<int>& quotients) const {
  Factors factors;
  std::vector<int>& waiting = places;
  std::reverse(waiting.begin(), waiting.end());
  while (!waiting.empty()) {
    if (factors.above.size() + waiting.size() > kMostTerms) {
      return {};
    }
    const int of = wraps_.plain(waiting.back());
    waiting.pop_back();
    const ListedOperation& operation = listing_->at(of);
    if (operation.is("fmul")) {
      waiting.push_back(operation.operands[1]);
      waiting.push_back(operation.operands[0]);
    } else if (operation.is("fdiv")) {
      quotients.push_back(of);
      factors.below.push_back(operation.operands[1]);
      waiting.push_back(operation.operands[0]);
    } else if (operation.is("fneg")) {
      factors.is_negative = !factors.is_negative;
      waiting.push_back(operation.operands[0]);
    } else {
      factors.is_negative = factors.is_negative != (operation.is_number() && operation.number < 0.0);
      factors.above.push_back(of);
    }
  }
  return factors;
}

bool ListingMatch::same_size(int node, int place) {
  const ListedOperation& operation = listing_->at(place);
  return operation.is_number() ? is_constant(node, std::fabs(operation.number)) : number(node, place);
}

bool ListingMatch::same_terms(const std::vector<Signed>& nodes, const std::vector<Signed>& places,
                              bool modulo_turns) {
  const auto is_same = [&](const Signed& node, const Signed& place) {
    const bool is_number = listing_->at(place.of).is_number();  // its sign has been taken apart
    // The sign of a product may stand in front of it, or in one of its factors.
    return node.is_negative == place.is_negative
               ? same_size(node.of, place.of) || (modulo_turns && !is_number && congruent(node.of, place.of))
               : !is_number && same_factors(node.of, {place.of}, true);
  };
  return !nodes.empty() && pair_up(nodes, places, is_same);
}

bool ListingMatch::is_sum(int node, int place, bool modulo_turns) {
  const ListedOperation& operation = listing_->at(place);
  const bool is_one = operation.is("fadd") || operation.is("fsub") || operation.is("fneg");
  return is_one && same_terms(terms_of_node(node), terms_of_register(place), modulo_turns);
}

bool ListingMatch::same_factors(int node, const std::vector<int>& places, bool is_opposite) {
  std::vector<int> quotients;
  const Factors formula = factors_of_node(node);
  const Factors listed = factors_of_registers(places, quotients);
  const bool is_same =
      (formula.is_negative == listed.is_negative) != is_opposite && !formula.above.empty() &&
      pair_up(formula.above, listed.above,
              [&](int written, int place) { return same_size(written, place); }) &&
      pair_up(formula.below, listed.below, [&](int written, int place) { return number(written, place); });
  if (is_same) {
    std::for_each(quotients.begin(), quotients.end(), [&](int each) { matched_.emplace(node, each); });
  }
  return is_same;
}

bool ListingMatch::is_product(int node, int place) {
  const ListedOperation& operation = listing_->at(place);
  const bool is_one = operation.is("fmul") || operation.is("fdiv") || operation.is("fneg");
  return is_one && same_factors(node, {place});
}

}  // namespace veritrack::checker

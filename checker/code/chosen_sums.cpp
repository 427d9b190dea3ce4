// Registers that choose between sums, where a formula adds what is chosen: x + if(a < b, p, q) is
// if(a < b, x + p, x + q).
#include "checker/code/listing_match.hpp"

#include <algorithm>
#include <cstddef>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

/// "first < second", or its opposite.
struct StrictComparison {
  int first = -1, second = -1;
  bool is_opposite = false;
};

std::optional<StrictComparison> strict(const OrderedPair& pair) {
  using Relation = OrderedPair::Relation;
  if (pair.relation == Relation::equal) {
    return std::nullopt;
  }
  return pair.relation == Relation::less ? StrictComparison{pair.first, pair.second, pair.is_opposite}
                                         : StrictComparison{pair.second, pair.first, !pair.is_opposite};
}

}  // namespace

std::optional<bool> ListingMatch::is_opposite_of(const FormulaNode& choice, int condition) {
  bool is_opposite = false;
  while (listing_->at(condition).is("xor") && listing_->at(listing_->at(condition).operands[1]).is_bit()) {
    spend();
    is_opposite = is_opposite != (listing_->at(listing_->at(condition).operands[1]).integer != 0);
    condition = listing_->at(condition).operands[0];
  }
  const ListedOperation& comparison = listing_->at(condition);
  const std::optional<OrderedPair> pair = comparison.is("fcmp") ? ordered_pair(comparison) : std::nullopt;
  const std::optional<StrictComparison> listed = pair ? strict(*pair) : std::nullopt;
  if (!listed) {
    return std::nullopt;
  }
  const std::vector<int>& sides = graph_->at(choice.arguments[0]).arguments;
  const bool is_turned = choice.text == "if >" || choice.text == "if >=";
  const bool is_strict = choice.text == "if <" || choice.text == "if >";
  const int less = sides[is_turned ? 1 : 0];
  const int more = sides[is_turned ? 0 : 1];
  const StrictComparison written =
      is_strict ? StrictComparison{less, more, false} : StrictComparison{more, less, true};
  if (!number(written.first, listed->first) || !number(written.second, listed->second)) {
    return std::nullopt;
  }
  // The rule is about numbers.
  compared_.insert(comparison.operands.begin(), comparison.operands.end());
  return (written.is_opposite != listed->is_opposite) != is_opposite;
}

bool ListingMatch::is_choice_of_sums(const std::vector<Signed>& nodes, int place, int angle) {
  place = wraps_.plain(place);
  const ListedOperation& select = listing_->at(place);
  constexpr int kDeepest = 400;
  if (!select.is("select") || !select.format.is_float || wraps_.is_wrapped(place) || depth_ > kDeepest) {
    return false;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const FormulaNode& choice = graph_->at(nodes[i].of);
    if (choice.kind != FormulaStep::Kind::function || !is_choice(choice.text)) {
      continue;
    }
    const std::optional<bool> is_opposite = is_opposite_of(choice, select.operands[0]);
    const auto is_branch = [&](std::size_t written, std::size_t listed) {
      std::vector<Signed> terms = nodes;
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
      for (const Signed& term : terms_of_node(choice.arguments[written])) {
        terms.push_back({term.of, term.is_negative != nodes[i].is_negative});
      }
      return is_sum_and_angle(terms, select.operands[listed], angle);
    };
    ++depth_;
    const bool is_same =
        is_opposite && is_branch(*is_opposite ? 2 : 1, 1) && is_branch(*is_opposite ? 1 : 2, 2);
    --depth_;
    if (is_same) {
      return true;
    }
  }
  return false;
}

bool ListingMatch::is_sum_and_angle(const std::vector<Signed>& nodes, int place, int angle) {
  spend();
  if (is_choice_of_sums(nodes, place, angle)) {
    return true;
  }
  std::vector<Signed> written;
  for (const Signed& node : nodes) {
    if (!is_constant(node.of, 0.0)) {
      written.push_back(node);
    }
  }
  std::vector<Signed> listed = terms_of_register(place);
  if (angle < 0) {
    return same_terms(written, listed, true);
  }
  const auto found = std::find_if(listed.begin(), listed.end(),
                                  [&](const Signed& term) { return term.of == angle && !term.is_negative; });
  if (found == listed.end()) {
    return false;
  }
  listed.erase(found);
  return written.empty() ? listed.empty() : same_terms(written, listed, false);
}

}  // namespace veritrack::checker

// The recursion in a certificate is that of its listing: formulas and registers are the same real functions
// of states and samples, by rules, each of which is an identity.
//
// A formula's value may be equal to that of a register, or, modulo whole turns, congruent to it. A state that
// is an angle is only known modulo turns: no value that is a number comes from it but by a sine, a cosine or
// a wrap to half a turn. What a rule needs besides (that a value is a number, that a wrap keeps its range,
// that a loop has ended) is shown from ranges and from the limits among the formulas, which the proof shows
// at every sample.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/code/formula_graph.hpp"
#include "checker/code/listing.hpp"
#include "checker/code/listing_rounding.hpp"
#include "checker/code/wraps.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

class ListingMatch {
 public:
  /// The states of the graph are those of the listing, in their order; `is_angle` says which are angles.
  ListingMatch(const CodeListing& listing, const FormulaGraph& graph, std::vector<bool> is_angle)
      : listing_(&listing), graph_(&graph), wraps_(listing), is_angle_(std::move(is_angle)) {}

  /// Nothing where the step, the frequency and all obligations of the listing are those of the graph. Throws
  /// Malformed for what is nested too deeply.
  [[nodiscard]] Objections objections();

  /// Once there were none: what bounds on rounding rest on. Nothing where an obligation is kept by a limit of
  /// the exact step alone.
  [[nodiscard]] std::optional<ListedAngles> angles();

 private:
  using Pair = std::pair<int, int>;  ///< a node and a register

  // ---- values

  /// Whether the node is the register's value, wherever the node has one.
  [[nodiscard]] bool number(int node, int place);
  [[nodiscard]] bool number_by_rules(int node, int place);
  /// The same modulo whole turns.
  [[nodiscard]] bool congruent(int node, int place);
  [[nodiscard]] bool congruent_by_rules(int node, int place);
  [[nodiscard]] bool is_constant(int node, double number) const;
  [[nodiscard]] bool is_function(int node, int place);
  [[nodiscard]] bool is_whole_multiple(int node, int place);
  [[nodiscard]] bool is_fused(int node, int place);
  /// A wrap to half a turn, as a number.
  [[nodiscard]] bool is_within_half_turn(int node, int place);
  [[nodiscard]] bool is_difference(const FormulaNode& arc, int base);

  // ---- sums and products

  struct Signed {
    int of = -1;  ///< a node or a register
    bool is_negative = false;
  };
  /// Factors of a product: those above and those below the line of a fraction.
  struct Factors {
    bool is_negative = false;
    std::vector<int> above, below;
  };
  // Nothing where there are very many.
  [[nodiscard]] std::vector<Signed> terms_of_node(int node) const;
  [[nodiscard]] std::vector<Signed> terms_of_register(int place) const;
  [[nodiscard]] Factors factors_of_node(int node) const;
  /// `quotients`: the divisions among it.
  [[nodiscard]] Factors factors_of_registers(std::vector<int> places, std::vector<int>& quotients) const;
  [[nodiscard]] bool same_terms(const std::vector<Signed>& nodes, const std::vector<Signed>& places,
                                bool modulo_turns);
  /// `is_opposite`: the node is minus the product.
  [[nodiscard]] bool same_factors(int node, const std::vector<int>& places, bool is_opposite = false);
  [[nodiscard]] bool is_sum(int node, int place, bool modulo_turns);
  /// Whether the sum of the nodes, and of the angle if there is one, is a register that chooses between sums:
  /// one of the nodes is a choice by the same comparison. Modulo whole turns where there is no angle.
  [[nodiscard]] bool is_choice_of_sums(const std::vector<Signed>& nodes, int place, int angle);
  [[nodiscard]] bool is_sum_and_angle(const std::vector<Signed>& nodes, int place, int angle);
  /// Whether `if` and the condition of a select ask the same; and then whether the opposite.
  [[nodiscard]] std::optional<bool> is_opposite_of(const FormulaNode& choice, int condition);
  [[nodiscard]] bool is_product(int node, int place);
  /// A term or factor whose sign is apart.
  [[nodiscard]] bool same_size(int node, int place);

  // ---- ranges and limits

  [[nodiscard]] std::optional<Span> span(int place);
  [[nodiscard]] std::optional<Span> span_by_rules(int place);
  [[nodiscard]] std::optional<Span> span_of_term(const Signed& term);
  [[nodiscard]] std::optional<Span> span_of_sum(int place);
  [[nodiscard]] std::optional<Span> span_of_choice(int place);
  /// The limits of a sum of at most half a turn.
  [[nodiscard]] std::optional<Span> limits_of(const std::vector<Signed>& terms);
  [[nodiscard]] std::optional<Span> bounds_of(int limit) const;
  [[nodiscard]] std::optional<Span> step_bounds_of(int limit) const;
  [[nodiscard]] std::optional<double> bound(int node) const;
  void find_spans(Objections& objections);
  [[nodiscard]] std::optional<ListedWrap> wrap_of(int place);
  /// Whether a limit among the formulas keeps the exact value within 3.14 of 0.
  [[nodiscard]] bool is_away_from_half_turn(int place);
  /// Whether the program keeps the range of an angle, too: steps one way alone have to be larger than what it
  /// is off.
  [[nodiscard]] bool is_kept_when_rounded(const ListedState& state);
  [[nodiscard]] bool is_kept_by_wraps(int condition);

  // ---- obligations

  [[nodiscard]] bool is_always(int condition, bool truth, int depth = 0);
  [[nodiscard]] bool is_always_compared(const ListedOperation& comparison, bool truth);
  /// An open interval around second - first.
  [[nodiscard]] std::vector<Span> differences(int first, int second);
  void check_numbers(Objections& objections);

  friend class ChoiceMatch;

  const CodeListing* listing_;
  const FormulaGraph* graph_;
  Wraps wraps_;
  std::vector<bool> is_angle_;
  std::map<Pair, bool> numbers_, congruences_;  ///< what is known of pairs
  std::set<Pair> matched_;                      ///< registers that have a value where the node has one
  std::map<int, std::optional<Span>> spans_;
  std::map<int, Span> state_spans_;  ///< of the registers of angles
  std::set<int> compared_;           ///< registers that have to be numbers
  int depth_ = 0;
};

}  // namespace veritrack::checker

// Formulas and registers that are made of choices: selects, the less or the larger of two, limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/code/listing_match.hpp"

namespace veritrack::checker {

/// Whether a register is a choice between others: a select, unless it wraps, and the less or the larger of
/// two.
bool is_choice_of_registers(const ListedOperation& operation);
/// Likewise a formula.
bool is_choice_of_formulas(const FormulaNode& node);

/// Decides whether a formula and a register that are made of choices are the same function, for every order
/// of what they compare.
class ChoiceMatch {
 public:
  explicit ChoiceMatch(ListingMatch& match) : match_(&match) {}
  [[nodiscard]] bool is_same(int node, int place);

 private:
  /// What is known of the order of atoms: which are less than, or at most, others.
  struct Order {
    std::size_t count = 0;
    std::vector<std::uint8_t> known;  ///< 0: nothing, 1: at most, 2: less
    /// Adds a <= b, or a < b; false where it contradicts.
    bool add(std::size_t a, std::size_t b, bool is_less);
    [[nodiscard]] bool are_equal(std::size_t a, std::size_t b) const {
      return known[a * count + b] == 1 && known[b * count + a] == 1;
    }
  };
  using Values = std::vector<std::pair<Order, std::size_t>>;  ///< there, an atom
  using Truths = std::vector<std::pair<Order, bool>>;
  using Relation = OrderedPair::Relation;

  /// The atoms: what is compared and chosen, and is no choice itself.
  struct Atom {
    int place = -1;
    std::optional<double> number;
  };
  [[nodiscard]] bool find_registers(int place);
  [[nodiscard]] bool find_condition(int condition, std::vector<int>& waiting);
  [[nodiscard]] bool find_nodes(int node);
  void add_register(int place);
  void add_node(int node);
  std::size_t add_number(double number);
  [[nodiscard]] Order order_of_numbers() const;

  [[nodiscard]] bool is_atom(int place) const;
  [[nodiscard]] Values of_register(int place, const Order& order);
  [[nodiscard]] Values of_node(int node, const Order& order);
  void add_chosen(const FormulaNode& formula, const Order& order, std::pair<std::size_t, std::size_t> sides,
                  Values& found);
  void add_absolute(const Order& order, std::size_t value, std::size_t negated, Values& found);
  void add_clamp(const Order& order, std::pair<std::size_t, std::size_t> value_and_low, int upper,
                 Values& found);
  [[nodiscard]] Truths of_condition(int condition, const Order& order);
  [[nodiscard]] Truths of_comparison(const OrderedPair& pair, const Order& order);
  static void compare(const Order& order, std::size_t a, std::size_t b, Relation relation, bool is_opposite,
                      Truths& found);
  void count();

  ListingMatch* match_;
  std::vector<Atom> atoms_;
  std::map<int, std::size_t> of_place_, of_node_;
  std::size_t zero_ = 0;
  int steps_ = 0;
  int depth_ = 0;
};

}  // namespace veritrack::checker

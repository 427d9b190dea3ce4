// Angles that a program wraps: registers that differ by whole turns, and the ranges that selects keep them
// in. Conversions of format are the identity, and tests whether a value is a number are decided: it is one.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/code/listing.hpp"
#include "checker/code/listing_rounding.hpp"

namespace veritrack::checker {

/// Numbers from `low` to `high`.
struct Span {
  double low = 0.0;
  double high = 0.0;

  friend bool operator==(const Span&, const Span&) = default;
};
/// By more than sums of doubles are rounded.
Span slightly_wider(Span span);

/// How far a constant may be from whole turns to stand for them.
constexpr double kTurnSlack = 1e-5;
/// How far a wrap to half a turn may be from half a turn.
constexpr double kHalfTurnSlack = 1e-4;

class Wraps {
 public:
  explicit Wraps(const CodeListing& listing);

  /// The register behind conversions of format and tests for numbers.
  [[nodiscard]] int plain(int place) const;
  /// The number of a constant that is finite.
  [[nodiscard]] std::optional<double> number(int place) const;
  /// What a condition is for numbers, where it asks only whether values are numbers.
  [[nodiscard]] std::optional<bool> tests_for_numbers(int condition) const;
  /// All registers that `plain` has taken for numbers since the beginning.
  [[nodiscard]] const std::set<int>& taken_for_numbers() const { return taken_; }

  /// Whether the register is a choice among a register, itself one of them, and others that differ from it by
  /// whole turns, or what is left of that register after a rounded count of turns is taken away; and that
  /// register.
  [[nodiscard]] bool is_wrapped(int place) const { return base_of(place) >= 0; }
  [[nodiscard]] int base_of(int place) const { return bases_[static_cast<std::size_t>(plain(place))]; }
  /// The values of a wrapped register where its base has this range.
  [[nodiscard]] std::optional<Span> range(int place, int base, Span of_base) const;
  /// One entry for each way from the base to the register.
  [[nodiscard]] std::optional<std::vector<ListedShift>> shifts(int place, int base, Span of_base) const;
  /// Whether a condition certainly has this truth where the base has this range.
  [[nodiscard]] bool is_always(int condition, bool truth, int base, Span of_base) const;

 private:
  /// A part of the base's range, and the comparisons that are decided there: next to its limit a comparison
  /// may be true or false, but only one of them. So is a count of turns one number, by what is left of them.
  struct Part {
    Span of_base;
    std::map<int, bool> decided;
    std::map<int, int> counts;
  };
  using Shifted =
      std::vector<std::pair<Part, ListedShift>>;       ///< there, a register is the base and a constant
  using Decided = std::vector<std::pair<Part, bool>>;  ///< there, a condition is true or false
  /// x - n T for T one turn, where n is x/T rounded.
  struct Remainder {
    int of = -1;
    std::string rounding;  ///< "rint"
    double turn = 0.0;
    double roundings = 0.0;
  };
  [[nodiscard]] std::optional<Remainder> remainder(int place) const;
  [[nodiscard]] std::optional<std::string> count_of_turns(int place, int of, double turn) const;
  [[nodiscard]] std::optional<Shifted> without_count(int place, const Remainder& remainder, int base,
                                                     const Part& part, int depth) const;
  [[nodiscard]] int behind(int place) const;
  [[nodiscard]] std::optional<Shifted> shifted(int place, int base, const Part& part, int depth) const;
  [[nodiscard]] std::optional<Decided> decided(int condition, int base, const Part& part, int depth) const;
  [[nodiscard]] std::optional<Decided> compared(int condition, int base, const Part& part, int depth) const;
  [[nodiscard]] std::optional<Decided> joined(const ListedOperation& both, int base, const Part& part,
                                              int depth) const;
  void find_bases();
  [[nodiscard]] int before_half_turns(int place) const;

  const CodeListing* listing_;
  std::vector<int> bases_;  ///< of selects; -1: not wrapped
  mutable std::set<int> taken_;
};

/// A comparison of numbers as "first < second", "first <= second" or "first = second", or its opposite; none
/// for a test whether values are numbers.
struct OrderedPair {
  int first = -1, second = -1;
  enum class Relation { less, at_most, equal } relation = Relation::less;
  bool is_opposite = false;
};
std::optional<OrderedPair> ordered_pair(const ListedOperation& comparison);

}  // namespace veritrack::checker

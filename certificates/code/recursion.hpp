// From a listing to a recursion in real numbers, in the language of [model].
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/model/code/turns.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

/// A listing that no rule makes into a recursion, and the place in the user's source.
class NoRecursion : public std::runtime_error {
 public:
  NoRecursion(const std::string& text, trackers::code::Place place)
      : std::runtime_error(text), place_(place) {}
  [[nodiscard]] trackers::code::Place place() const { return place_; }

 private:
  trackers::code::Place place_;
};

/// The recursion of a listing: what it computes where nothing is rounded and angles count modulo 2 pi.
struct Recursion {
  std::vector<std::string> samples;
  std::vector<std::string> states;
  std::vector<std::string> angles;           ///< of the states, those that the program wraps
  std::string step;                          ///< lines name = formula
  std::string frequency;                     ///< a formula of the states, rad/sample
  std::vector<std::string> start;            ///< what `setup` leaves, a number for each state
  std::map<int, model::code::Range> ranges;  ///< that wraps keep angles in, by the register of the state
  std::map<int, model::code::Range> bases;   ///< of what is wrapped, by its register
  /// Every obligation is kept by these ranges; others are limits of the step, of numbers that are not
  /// rounded.
  bool ranges_keep_obligations = true;
};

/// The recursion of the listing over the real numbers: constants at their value in the program's format,
/// conversions of format the identity, comparisons as of numbers, an angle that is wrapped itself. Throws
/// NoRecursion.
[[nodiscard]] Recursion recursion_of(const trackers::code::Listing& listing);

}  // namespace veritrack::certificates::code

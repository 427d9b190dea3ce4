// Comparisons, and limits that comparisons keep.
#pragma once

#include <optional>

#include "analysis/model/code/turns.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

/// A comparison as "first is below second", and whether it is the other way round.
struct Less {
  int first = -1, second = -1;
  bool negated = false;
};

/// A value between limits: the register that is limited, and the limits that are there.
struct Limited {
  int value = -1;
  std::optional<double> low, high;
};

/// Of a listing, with conversions of format looked through.
class Comparisons {
 public:
  /// Both must outlive it.
  Comparisons(const trackers::code::Listing& listing, const model::code::Turns& turns)
      : listing_(&listing), turns_(&turns) {}

  /// Of a constant.
  [[nodiscard]] std::optional<double> number(int value) const;
  /// Nothing for other conditions than an order of numbers.
  [[nodiscard]] std::optional<Less> less(int condition) const;
  /// A value with the limits that it is kept between, by minima and maxima or by choices.
  [[nodiscard]] Limited limited(int value) const;

 private:
  [[nodiscard]] const trackers::code::Instruction& at(int value) const {
    return listing_->instructions[static_cast<std::size_t>(value)];
  }
  [[nodiscard]] std::optional<Limited> with_limit(int inner, double limit, bool is_low) const;

  const trackers::code::Listing* listing_;
  const model::code::Turns* turns_;
};

}  // namespace veritrack::certificates::code

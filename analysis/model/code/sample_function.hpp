// The value of a register that is made of the samples alone, at all scales of these at once.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

/// The operations that make a register of both samples, in their order. Needs the upward rounding mode.
class SampleFunction {
 public:
  /// The listing must outlive it.
  SampleFunction(const trackers::code::Listing& listing, int value);

  /// What the program computes for samples s x and s y, for all scales s from 2^-40 to 2^40, rounding
  /// included. Nothing where no bound is known, or where it depends on the scale.
  [[nodiscard]] std::optional<rigor::Interval> value(const rigor::Interval& x, const rigor::Interval& y);

 private:
  /// s^degree times a number of `range`. A constant has any degree, where a share of it may be as large as
  /// the scale makes it.
  struct Scaled {
    bool is_known = false;
    int degree = 0;
    rigor::Interval range;
    bool is_constant = false;
  };
  /// Of a condition: whether it may hold, and may not.
  struct Truth {
    bool may_hold = true, may_fail = true;
  };
  [[nodiscard]] const trackers::code::Instruction& at(int place) const {
    return listing_->instructions[static_cast<std::size_t>(place)];
  }
  [[nodiscard]] static Scaled of_degree(const Scaled& value, int degree);
  [[nodiscard]] static std::pair<Scaled, Scaled> alike(const Scaled& a, const Scaled& b);
  [[nodiscard]] static Scaled rounded(trackers::code::Format format, int degree, const rigor::Interval& exact,
                                      double units = 1.0);
  [[nodiscard]] Scaled operation(const trackers::code::Instruction& instruction) const;
  [[nodiscard]] static Scaled chosen(const Truth& condition, const Scaled& yes, const Scaled& no);
  [[nodiscard]] static Scaled of_one(const trackers::code::Instruction& instruction, const Scaled& x);
  [[nodiscard]] static Scaled of_two(const trackers::code::Instruction& instruction, const Scaled& x,
                                     const Scaled& y);
  [[nodiscard]] Truth truth(const trackers::code::Instruction& instruction) const;
  [[nodiscard]] static Truth compared(trackers::code::Predicate predicate, const Scaled& x, const Scaled& y);

  const trackers::code::Listing* listing_;
  std::vector<int> order_;
  std::vector<Scaled> scaled_;
  std::vector<Truth> truths_;
};

}  // namespace veritrack::model::code

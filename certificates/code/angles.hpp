// The angles of a listing: states that the program wraps, and the ranges that its wraps keep them in.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "analysis/model/code/turns.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

class Angles {
 public:
  struct Term {
    int value = -1;
    bool is_subtracted = false;
    bool is_choice = false;  ///< the value selects: the term is what is left of the branch that is taken
  };
  /// What is left of a sum when one angle is taken out of it: the angle and the other terms. Where it is
  /// subtracted from the angle of a point, both are taken out.
  struct Rest {
    int angle = -1;
    int arc = -1;  ///< the arc tangent that the angle is subtracted from, or none
    std::vector<Term> terms;
    int choices = 0;  ///< among the terms, and among those of their branches
  };

  /// Both must outlive it. Throws NoRecursion for an angle whose wraps keep it in no range.
  Angles(const trackers::code::Listing& listing, model::code::Turns& turns);

  /// Of the input of a state.
  [[nodiscard]] bool is_angle(int input) const { return is_angle_.at(input); }
  [[nodiscard]] std::optional<Rest> rest_of(int value);
  /// The range of a wrapped value, or of a state that is an angle, for steps of less than half a turn.
  [[nodiscard]] std::optional<model::code::Range> range(int value);
  /// Whether the range of what is wrapped rests on a step.
  [[nodiscard]] bool has_step(int base) const { return steps_.contains(base); }
  /// Steps are limited to less than half a turn, either way or one way alone: wraps of one side keep a range
  /// where the angle does not turn back.
  enum class Steps { either_way, forward, backward };
  [[nodiscard]] Steps steps() const { return direction_; }
  /// One way, a step is at least this, rad: more than what its angle may be off.
  static constexpr double kLeastStep = 1e-3;
  /// An angle that grows for ever stops when the next step is less than half of a unit in its last place.
  /// Throws NoRecursion.
  void require_wraps(int angle);

  /// By the register of the state.
  [[nodiscard]] const std::map<int, model::code::Range>& ranges() const { return ranges_; }
  /// Of what is wrapped.
  [[nodiscard]] const std::map<int, model::code::Range>& bases() const { return bases_; }

 private:
  [[nodiscard]] const trackers::code::Instruction& at(int value) const {
    return listing_->instructions[static_cast<std::size_t>(value)];
  }
  void find_ranges();
  [[nodiscard]] bool keeps_ranges();
  [[nodiscard]] bool widen_ranges();
  [[nodiscard]] bool is_angular(int value);
  [[nodiscard]] std::optional<Rest> rest_by_rules(int value);
  [[nodiscard]] std::optional<Rest> rest_of_choice(int value);
  [[nodiscard]] std::optional<Rest> rest_of_difference(const trackers::code::Instruction& difference);
  [[nodiscard]] std::optional<model::code::Range> range_of(int value);
  [[nodiscard]] bool is_summand(int state, int sum) const;

  const trackers::code::Listing* listing_;
  model::code::Turns* turns_;
  std::map<int, bool> is_angle_;  ///< of the inputs
  std::map<int, model::code::Range> ranges_, bases_;
  std::map<int, std::optional<Rest>> rests_;
  std::set<int> steps_;  ///< bases that are an angle and a step
  Steps direction_ = Steps::either_way;
};

}  // namespace veritrack::certificates::code

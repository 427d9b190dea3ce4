// The angles of a listing: states that the program wraps, and the ranges that its wraps keep them in.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "analysis/model/code/turns.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

class Angles {
 public:
  /// What is left of a sum when one angle is taken out of it: the angle and the other terms with their signs.
  struct Rest {
    int angle = -1;
    std::vector<std::pair<int, bool>> terms;  ///< and whether they are subtracted
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
  [[nodiscard]] std::optional<model::code::Range> range_of(int value);
  [[nodiscard]] bool is_summand(int state, int sum) const;

  const trackers::code::Listing* listing_;
  model::code::Turns* turns_;
  std::map<int, bool> is_angle_;  ///< of the inputs
  std::map<int, model::code::Range> ranges_, bases_;
  std::set<int> steps_;  ///< bases that are an angle and a step
  Steps direction_ = Steps::either_way;
};

}  // namespace veritrack::certificates::code

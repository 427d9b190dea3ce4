// The rules by which values with a base and slopes are combined (docs/gain-proof.md, section 10).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "analysis/model/gain/phase_step.hpp"
#include "trackers/model/straight_line_program.hpp"

namespace veritrack::model {

/// base + sum of slopes times errors: 0, ..., n - 1 of the states, then the inputs of the step.
struct PhaseValue {
  rigor::BallModel base;
  std::map<int, rigor::BallModel> slopes;
};

class PhaseRules {
 public:
  PhaseRules(std::size_t states, PhaseStep& step) : states_(states), step_(&step) {}

  /// The result of an instruction. New remainders become inputs of the step, and operands its forms. Throws
  /// NoFrame for an operation that no rule covers.
  PhaseValue value_of(const trackers::Instruction& instruction, const std::vector<PhaseValue>& registers);
  /// The number of the form that the deviation of this value is.
  int form_of(const PhaseValue& value);

 private:
  int form_at(int place, const PhaseValue& value);
  /// Where it has one.
  std::optional<std::size_t> possible_form(int place, const PhaseValue& value);
  PhaseValue product(int first, int second, const PhaseValue& x, const PhaseValue& z);
  PhaseValue function(trackers::Operation operation, int exponent, int place, const PhaseValue& x);
  PhaseValue angle(int first, int second, const PhaseValue& y, const PhaseValue& x);
  PhaseValue larger(int first, int second, const PhaseValue& x, const PhaseValue& z);
  PhaseValue chosen(int place, const PhaseValue& positive, const PhaseValue& a, const PhaseValue& b);
  /// Minimum, absolute value, clamp.
  PhaseValue by_larger(const trackers::Instruction& each, const std::vector<PhaseValue>& registers);
  PhaseValue within(int place, const PhaseValue& x, const PhaseValue& low, const PhaseValue& high);
  void add_remainder(PhaseValue& value, RemainderSize size);

  std::size_t states_;
  PhaseStep* step_;
  std::map<int, int> forms_;  ///< by register
};

}  // namespace veritrack::model

#include "analysis/model/gain/loop_detector.hpp"

#include "analysis/model/gain/steady_proposal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

namespace {

using linear::Row;
using rigor::Interval;

constexpr double kRoundingOfForms = 0x1p-30;

/// The sum of row_i turns_i, and that of the sizes of its terms.
struct WeighedTurns {
  Interval sum{0.0};
  Interval size{0.0};
};
WeighedTurns weighed_turns(const Row& row, const std::vector<SteadyValue>& steady) {
  WeighedTurns result;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Interval term = row[i] * Interval(static_cast<double>(steady[i].turns));
    result.sum += term;
    result.size += abs(term);
  }
  return result;
}

bool are_same_forms(const Row& x, const Row& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Interval room = Interval(kRoundingOfForms) * (abs(x[i]) + abs(y[i]));
    if (!rigor::certainly_less_equal(abs(x[i] - y[i]), room)) {
      return false;
    }
  }
  return true;
}

/// (I - A) turns: what a step of the signal's phase does at the next sample.
Row effect_of_phase(const LoopNetwork& network, const std::vector<SteadyValue>& steady) {
  Row effect;
  effect.reserve(steady.size());
  for (std::size_t i = 0; i < steady.size(); ++i) {
    Interval sum(static_cast<double>(steady[i].turns));
    for (std::size_t j = 0; j < steady.size(); ++j) {
      sum -= network.a[i][j] * Interval(static_cast<double>(steady[j].turns));
    }
    effect.push_back(sum);
  }
  return effect;
}

}  // namespace

LoopDetector detector_of(const LoopNetwork& network, const std::vector<SteadyValue>& steady) {
  if (vector_of(steady)) {
    return {
        std::nullopt,
        "the step compares the samples with samples that it has kept: no gain of a detector alone decides "
        "how the loop answers"};
  }
  std::optional<Row> compared;
  for (const std::size_t angle : network.angle_forms) {
    const Row& form = network.forms[angle];
    const WeighedTurns turns = weighed_turns(form, steady);
    if (turns.size == Interval(0.0)) {
      continue;  // of states that do not turn with the signal
    }
    Row row;
    row.reserve(form.size());
    for (const Interval& entry : form) {
      row.push_back(entry / turns.sum);
    }
    const bool is_of_phase = rigor::certainly_less(Interval(kRoundingOfForms) * turns.size, abs(turns.sum));
    if (!is_of_phase || (compared && !are_same_forms(*compared, row))) {
      return {std::nullopt,
              "the step compares the phase of the samples with more than one angle of its states: the loop "
              "has more than one detector"};
    }
    if (!compared) {
      compared = row;
    }
  }
  if (!compared) {
    return {std::nullopt, "nothing in the step compares the phase of the samples with the states"};
  }
  return {linear::DetectorLoop{network.a, effect_of_phase(network, steady), *compared}, ""};
}

}  // namespace veritrack::model

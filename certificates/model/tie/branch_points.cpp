#include "certificates/model/tie/branch_points.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include "trackers/code/listing_run.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

constexpr int kTriesForAPair = 40;  // pairs of inputs between which the comparison might change

/// The comparisons that a finite input may change.
std::vector<std::size_t> comparisons_of(const Listing& listing) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < listing.instructions.size(); ++i) {
    const Instruction& instruction = listing.instructions[i];
    const bool is_of_numbers = instruction.operation == Operation::fcmp &&
                               instruction.predicate != Predicate::ord &&
                               instruction.predicate != Predicate::uno;
    if (is_of_numbers || instruction.operation == Operation::icmp) {
      found.push_back(i);
    }
  }
  return found;
}

/// The values of a format in their order, as integers: neighbours are one apart.
std::int64_t rank_of(Format format, std::uint64_t bits) {
  const std::int64_t value = trackers::code::signed_value(format, bits);
  if (!format.is_float || value >= 0) {
    return value;
  }
  const std::uint64_t sign = std::uint64_t{1} << static_cast<unsigned>(format.bits - 1);
  return -static_cast<std::int64_t>(bits & (sign - 1));
}

std::uint64_t bits_at(Format format, std::int64_t rank) {
  if (!format.is_float || rank >= 0) {
    return trackers::code::wrapped(format, static_cast<std::uint64_t>(rank));
  }
  const std::uint64_t sign = std::uint64_t{1} << static_cast<unsigned>(format.bits - 1);
  return static_cast<std::uint64_t>(-rank) | sign;
}

/// The inputs of a listing by one number, states first.
class Inputs {
 public:
  explicit Inputs(const Listing& listing) : listing_(&listing) {}

  [[nodiscard]] std::size_t count() const { return listing_->states.size() + listing_->samples.size(); }
  [[nodiscard]] static std::uint64_t& at(StepInput& step, std::size_t k) {
    return k < step.states.size() ? step.states[k] : step.samples[k - step.states.size()];
  }
  [[nodiscard]] static std::uint64_t value(const StepInput& step, std::size_t k) {
    return k < step.states.size() ? step.states[k] : step.samples[k - step.states.size()];
  }
  [[nodiscard]] Format format(std::size_t k) const {
    const std::size_t states = listing_->states.size();
    const int value = k < states ? listing_->states[k].input : listing_->samples[k - states];
    return listing_->instructions[static_cast<std::size_t>(value)].format;
  }
  [[nodiscard]] bool is_true(const StepInput& step, std::size_t comparison) const {
    return registers_of(*listing_, {step}, own_library).front()[comparison] != 0;
  }

 private:
  const Listing* listing_;
};

/// The two neighbours between `low` and `high`, which differ in input k, where the comparison changes.
std::pair<StepInput, StepInput> bisected(const Inputs& inputs, std::size_t comparison, std::size_t k,
                                         StepInput low, StepInput high) {
  const Format format = inputs.format(k);
  const bool is_true_at_low = inputs.is_true(low, comparison);
  for (;;) {
    const std::int64_t a = rank_of(format, Inputs::value(low, k));
    const std::int64_t b = rank_of(format, Inputs::value(high, k));
    const std::int64_t middle = a / 2 + b / 2 + (a % 2 + b % 2) / 2;  // a + b may overflow
    if (middle == a || middle == b) {
      return {std::move(low), std::move(high)};
    }
    StepInput between = low;
    Inputs::at(between, k) = bits_at(format, middle);
    (inputs.is_true(between, comparison) == is_true_at_low ? low : high) = std::move(between);
  }
}

/// From one input to another, one state or sample after the other, until the comparison changes.
std::optional<std::pair<StepInput, StepInput>> pair_between(const Inputs& inputs, std::size_t comparison,
                                                            const StepInput& from, const StepInput& to) {
  const bool is_true_before = inputs.is_true(from, comparison);
  StepInput last = from;
  for (std::size_t k = 0; k < inputs.count(); ++k) {
    StepInput next = last;
    Inputs::at(next, k) = Inputs::value(to, k);
    if (inputs.is_true(next, comparison) != is_true_before) {
      return bisected(inputs, comparison, k, std::move(last), std::move(next));
    }
    last = std::move(next);
  }
  return std::nullopt;
}

}  // namespace

BranchPoints steps_beside_branches(const Listing& listing, const std::function<StepInput()>& draw,
                                   int count) {
  const Inputs inputs(listing);
  std::vector<std::size_t> open = comparisons_of(listing);
  BranchPoints result;
  result.comparisons = static_cast<int>(open.size());
  while (!open.empty()) {
    std::vector<std::size_t> changed;
    for (const std::size_t comparison : open) {
      if (static_cast<int>(result.steps.size()) + 2 > count) {
        return result;
      }
      std::optional<std::pair<StepInput, StepInput>> found;
      for (int tries = 0; tries < kTriesForAPair && !found; ++tries) {
        const StepInput from = draw();  // one after the other, so that the numbers drawn are always the same
        found = pair_between(inputs, comparison, from, draw());
      }
      if (found) {
        changed.push_back(comparison);
        result.steps.push_back(std::move(found->first));
        result.steps.push_back(std::move(found->second));
        result.changing.insert(result.changing.end(), 2, comparison);
      }
    }
    open = std::move(changed);
  }
  return result;
}

}  // namespace veritrack::certificates::tie

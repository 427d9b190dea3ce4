// Listings for tests, made a line at a time.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::kBit;
using trackers::code::kSingle;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

class ListingBuilder {
 public:
  [[nodiscard]] int number(double value) {
    Instruction constant;
    constant.format = kSingle;
    constant.bits = trackers::code::bits_of(kSingle, value);
    return put(constant);
  }
  [[nodiscard]] int sample() {
    Instruction input;
    input.operation = Operation::input;
    input.format = kSingle;
    listing.samples.push_back(put(input));
    listing.sample_names.emplace_back("y");
    return listing.samples.back();
  }
  [[nodiscard]] int state(const std::string& name) {
    Instruction input;
    input.operation = Operation::input;
    input.format = kSingle;
    listing.states.push_back({name, put(input), -1, 0});
    return listing.states.back().input;
  }
  int make(Operation operation, std::vector<int> operands, Predicate predicate = Predicate::none,
           Format format = kSingle) {
    Instruction instruction;
    instruction.operation = operation;
    instruction.format = predicate == Predicate::none ? format : kBit;
    instruction.predicate = predicate;
    for (std::size_t k = 0; k < operands.size(); ++k) {
      instruction.operands.at(k) = operands[k];
    }
    return put(instruction);
  }
  /// x > pi ? x - 2 pi : x < -pi ? x + 2 pi : x.
  int wrapped(int x) {
    const float turn = 6.2831855F;
    const float half = 3.1415927F;
    const int below = make(Operation::fcmp, {x, number(-half)}, Predicate::olt);
    const int up = make(Operation::select, {below, make(Operation::fadd, {x, number(turn)}), x});
    const int above = make(Operation::fcmp, {x, number(half)}, Predicate::ogt);
    return make(Operation::select, {above, make(Operation::fsub, {x, number(turn)}), up});
  }

  Listing listing;
  int put(const Instruction& instruction) {
    listing.instructions.push_back(instruction);
    return static_cast<int>(listing.instructions.size()) - 1;
  }
};

/// A type-2 loop with a detector that multiplies, and limits of its frequency.
inline Listing multiplying_loop(double kp, double ki) {
  ListingBuilder made;
  const int y = made.sample();
  const int theta = made.state("theta");
  const int w = made.state("w");
  const int sine = made.make(Operation::sin, {made.make(Operation::fadd, {theta, w})});
  const int error = made.make(Operation::fmul, {made.make(Operation::fmul, {y, made.number(-2.0)}), sine});
  const int step = made.make(Operation::fadd, {w, made.make(Operation::fmul, {error, made.number(kp)})});
  const int next_w = made.make(Operation::fadd, {w, made.make(Operation::fmul, {error, made.number(ki)})});
  const int high = made.make(Operation::fmin, {next_w, made.number(1.0)});
  made.listing.states[0].next = made.wrapped(made.make(Operation::fadd, {theta, step}));
  made.listing.states[1].next = made.make(Operation::fmax, {high, made.number(0.05)});
  made.listing.frequency = w;
  return made.listing;
}

}  // namespace veritrack::model::code

#include "analysis/model/code/turned_sample.hpp"

#include <array>
#include <limits>

#include "analysis/model/code/turns.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model::code {

namespace {

using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;

/// A sample times the sine or the cosine of a register.
struct Part {
  int sample = -1;
  int turn = -1;
  Operation function = Operation::constant;
};

std::optional<Part> part_of(const Listing& listing, int place) {
  const auto at = [&](int number) -> const Instruction& {
    return listing.instructions[static_cast<std::size_t>(number)];
  };
  const Instruction& product = at(place);
  if (product.operation != Operation::fmul) {
    return std::nullopt;
  }
  for (const std::size_t i : {0U, 1U}) {
    const int sample = product.operands[i];
    const Instruction& function = at(product.operands[1 - i]);
    const bool is_turn = function.operation == Operation::sin || function.operation == Operation::cos;
    if (is_turn && (sample == listing.samples[0] || sample == listing.samples[1])) {
      return Part{sample, function.operands[0], function.operation};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> turned_back_by(const Listing& listing, const Instruction& arc) {
  if (arc.operation != Operation::atan2 || listing.samples.size() != 2) {
    return std::nullopt;
  }
  const Instruction& y = listing.instructions[static_cast<std::size_t>(arc.operands[0])];
  const Instruction& x = listing.instructions[static_cast<std::size_t>(arc.operands[1])];
  if (y.operation != Operation::fsub || x.operation != Operation::fadd) {
    return std::nullopt;
  }
  const auto b_cos = part_of(listing, y.operands[0]);
  const auto a_sin = part_of(listing, y.operands[1]);
  auto a_cos = part_of(listing, x.operands[0]);
  auto b_sin = part_of(listing, x.operands[1]);
  if (!b_cos || !a_sin || !a_cos || !b_sin) {
    return std::nullopt;
  }
  if (a_cos->function == Operation::sin) {
    std::swap(a_cos, b_sin);
  }
  const bool are_functions = b_cos->function == Operation::cos && a_sin->function == Operation::sin &&
                             a_cos->function == Operation::cos && b_sin->function == Operation::sin;
  const bool are_samples =
      b_cos->sample == b_sin->sample && a_cos->sample == a_sin->sample && a_cos->sample != b_cos->sample;
  const bool is_one_turn =
      b_cos->turn == a_sin->turn && b_cos->turn == a_cos->turn && b_cos->turn == b_sin->turn;
  return are_functions && are_samples && is_one_turn ? std::optional(b_cos->turn) : std::nullopt;
}

double error_of_turned_sample(trackers::code::Format format, double of_turn, double of_functions,
                              double least) {
  using rigor::add_up, rigor::mul_up;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kMoreThanRoot = 1.5;  // of 2, with room for terms of second order
  constexpr double kMoreThanArc = 1.01;
  constexpr double kLargest = 0.01;
  if (!(least > 0.0)) {
    return kInfinity;
  }
  // Of each coordinate, relative to the length: |a| + |b| is at most sqrt(2) of it, |b cos| + |a sin| at most
  // once. Two products and a sum may be flushed to 0.
  const double flushed = format.bits == 32 ? 0x1p-123 : 0x1p-1019;
  const double each = add_up(mul_up(kMoreThanRoot, of_functions), 2.0 * unit_roundoff(format));
  const double off = add_up(mul_up(kMoreThanRoot, each), rigor::div_up(flushed, least));
  return off < kLargest ? add_up(of_turn, mul_up(kMoreThanArc, off)) : kInfinity;
}

}  // namespace veritrack::model::code

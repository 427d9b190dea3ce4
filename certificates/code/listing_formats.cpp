#include "certificates/code/listing_formats.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace veritrack::certificates::code {

namespace {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

bool compares_numbers(Predicate predicate) {
  return predicate >= Predicate::oeq && predicate <= Predicate::uno;
}
bool compares_integers(Predicate predicate) {
  return (predicate >= Predicate::ult && predicate <= Predicate::uge) ||
         (predicate >= Predicate::eq && predicate <= Predicate::sge);
}

bool fits_table(const Listing& listing, const Instruction& instruction, Format index) {
  const std::vector<std::uint64_t>& table = listing.tables.at(static_cast<std::size_t>(instruction.table));
  return !index.is_float && std::all_of(table.begin(), table.end(), [&](std::uint64_t element) {
    return trackers::code::wrapped(instruction.format, element) == element;
  });
}

}  // namespace

bool has_fitting_formats(const Listing& listing, const Instruction& instruction) {
  const Format to = instruction.format;
  std::vector<Format> from;
  for (const int operand : instruction.operands) {
    if (operand >= 0) {
      from.push_back(listing.instructions.at(static_cast<std::size_t>(operand)).format);
    }
  }
  const auto all_are = [&](Format format) {
    return std::all_of(from.begin(), from.end(), [&](Format each) { return each == format; });
  };
  const auto widens = [&] { return from[0].bits < to.bits && from[0].is_float == to.is_float; };
  const auto narrows = [&] { return from[0].bits > to.bits && from[0].is_float == to.is_float; };
  switch (instruction.operation) {
    case Operation::fpext:
      return to.is_float && widens();
    case Operation::fptrunc:
      return to.is_float && narrows();
    case Operation::zext:
    case Operation::sext:
      return !to.is_float && widens();
    case Operation::integer_trunc:
      return !to.is_float && narrows();
    case Operation::sitofp:
    case Operation::uitofp:
      return to.is_float && !from[0].is_float;
    case Operation::fptosi:
    case Operation::fptoui:
      return !to.is_float && from[0].is_float;
    case Operation::bits:
      return to.is_float != from[0].is_float && to.bits == from[0].bits;
    case Operation::fcmp:
      return from[0].is_float && all_are(from[0]) && compares_numbers(instruction.predicate);
    case Operation::icmp:
      return !from[0].is_float && all_are(from[0]) && compares_integers(instruction.predicate);
    case Operation::select:
      return from[0] == trackers::code::kBit && from[1] == to && from[2] == to;
    case Operation::table:
      return fits_table(listing, instruction, from[0]);
    default: {
      const bool is_of_integers =
          instruction.operation >= Operation::add && instruction.operation <= Operation::ashr;
      return to.is_float != is_of_integers && all_are(to);
    }
  }
}

}  // namespace veritrack::certificates::code

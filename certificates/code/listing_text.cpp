#include "certificates/code/listing_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace veritrack::certificates::code {

namespace {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Place;
using trackers::code::Predicate;

constexpr std::string_view kFirstLine = "veritrack listing 1";

std::string format_text(Format format) {
  return fmt::format("{}{}", format.is_float ? 'f' : 'i', format.bits);
}

std::string place_text(Place place) {
  return place.file < 0 ? "" : fmt::format(" @{}:{}:{}", place.file, place.line, place.column);
}

/// The name of an operation with what belongs to it: fadd.f32, fcmp.olt.f32, table.f32.t0.
std::string operation_text(const Listing& listing, const Instruction& instruction) {
  std::string text(trackers::code::name_of(instruction.operation)->name);
  if (instruction.predicate != Predicate::none) {
    text += fmt::format(".{}",
                        trackers::code::kPredicateNames.at(static_cast<std::size_t>(instruction.predicate)));
  }
  // What a comparison compares, and a conversion converts, is another format.
  const Format from = listing.instructions[static_cast<std::size_t>(instruction.operands[0])].format;
  text += "." + format_text(instruction.predicate == Predicate::none ? instruction.format : from);
  if (instruction.operation == Operation::table) {
    text += fmt::format(".t{}", instruction.table);
  }
  return text;
}

}  // namespace

std::string constant_text(Format format, std::uint64_t bits) {
  if (!format.is_float) {
    return fmt::format("i{}:{}", format.bits, bits);
  }
  const double number = trackers::code::number_of(format, bits);
  if (!std::isfinite(number)) {
    return fmt::format("f{}:bits{:x}", format.bits, bits);
  }
  return fmt::format("f{}:{:a}", format.bits, number);
}

std::string listing_text(const Listing& listing) {
  std::string text = fmt::format("{}\n", kFirstLine);
  for (std::size_t i = 0; i < listing.files.size(); ++i) {
    text += fmt::format("file {} {}\n", i, listing.files[i]);
  }
  if (listing.steps_before != 0) {
    text += fmt::format("steps-before {}\n", listing.steps_before);
  }
  std::vector<std::string> names(listing.instructions.size());
  const auto format_of = [&](int value) {
    return format_text(listing.instructions[static_cast<std::size_t>(value)].format);
  };
  int count = 0;
  const auto named = [&](int value) -> std::string& {
    std::string& name = names[static_cast<std::size_t>(value)];
    name = fmt::format("r{}", count++);
    return name;
  };
  for (std::size_t i = 0; i < listing.samples.size(); ++i) {
    const int value = listing.samples[i];
    text += fmt::format("sample {} {} {}\n", named(value), format_of(value), listing.sample_names[i]);
  }
  for (const trackers::code::State& state : listing.states) {
    const Format format = listing.instructions[static_cast<std::size_t>(state.input)].format;
    text += fmt::format("state {} {} {}\n", named(state.input), constant_text(format, state.start_bits),
                        state.name);
  }
  for (std::size_t i = 0; i < listing.tables.size(); ++i) {
    const auto& of_library = listing.library_tables;
    const bool is_of_library =
        std::find(of_library.begin(), of_library.end(), static_cast<int>(i)) != of_library.end();
    text += fmt::format("{} t{}", is_of_library ? "library-table" : "table", i);
    for (const std::uint64_t element : listing.tables[i]) {
      text += fmt::format(" {:x}", element);
    }
    text += '\n';
  }
  for (std::size_t i = 0; i < listing.instructions.size(); ++i) {
    const Instruction& instruction = listing.instructions[i];
    if (instruction.operation == Operation::constant) {
      names[i] = constant_text(instruction.format, instruction.bits);
    } else if (instruction.operation != Operation::input) {
      std::string operands;
      for (const int operand : instruction.operands) {
        operands += operand < 0 ? "" : " " + names[static_cast<std::size_t>(operand)];
      }
      const std::string operation = operation_text(listing, instruction);
      text += fmt::format("{} = {}{}{}\n", named(static_cast<int>(i)), operation, operands,
                          place_text(instruction.place));
    }
  }
  for (const trackers::code::State& state : listing.states) {
    text += fmt::format("next {} {}\n", names[static_cast<std::size_t>(state.input)],
                        names[static_cast<std::size_t>(state.next)]);
  }
  text += fmt::format("frequency {}\n", names[static_cast<std::size_t>(listing.frequency)]);
  for (const trackers::code::Obligation& obligation : listing.obligations) {
    text += fmt::format("must-be-zero {}{} {}\n", names[static_cast<std::size_t>(obligation.must_be_zero)],
                        place_text(obligation.place), obligation.why);
  }
  return text;
}

}  // namespace veritrack::certificates::code

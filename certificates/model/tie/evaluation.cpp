#include "certificates/model/tie/evaluation.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using Registers = std::vector<std::uint64_t>;

const Instruction& operand_of(const Listing& listing, const Instruction& instruction, std::size_t k) {
  return listing.instructions[static_cast<std::size_t>(instruction.operands.at(k))];
}

/// The result of an operation that is no call of the library; 0 where it is not defined, as obligations say.
std::uint64_t computed(const Listing& listing, const Instruction& instruction, const Registers& registers) {
  std::array<std::uint64_t, 3> values{};
  std::array<Format, 3> formats{};
  for (std::size_t k = 0; k < 3 && instruction.operands.at(k) >= 0; ++k) {
    values.at(k) = registers[static_cast<std::size_t>(instruction.operands.at(k))];
    formats.at(k) = operand_of(listing, instruction, k).format;
  }
  if (instruction.operation == Operation::table) {
    const Registers& table = listing.tables.at(static_cast<std::size_t>(instruction.table));
    return values[0] < table.size() ? table[values[0]] : 0;
  }
  try {
    return trackers::code::value_of(instruction, values, formats);
  } catch (const trackers::code::UndefinedOperation&) {
    return 0;
  }
}

Registers with_inputs(const Listing& listing, const StepInput& step) {
  if (step.states.size() != listing.states.size() || step.samples.size() != listing.samples.size()) {
    throw std::invalid_argument("wrong number of states or samples of a listing");
  }
  Registers registers(listing.instructions.size());
  for (std::size_t i = 0; i < step.states.size(); ++i) {
    registers[static_cast<std::size_t>(listing.states[i].input)] = step.states[i];
  }
  for (std::size_t i = 0; i < step.samples.size(); ++i) {
    registers[static_cast<std::size_t>(listing.samples[i])] = step.samples[i];
  }
  return registers;
}

void call_library(const Instruction& instruction, const Library& library, std::size_t target,
                  std::vector<Registers>& all) {
  std::vector<LibraryArguments> arguments;
  arguments.reserve(all.size());
  for (const Registers& registers : all) {
    LibraryArguments call{};
    for (std::size_t k = 0; k < 2 && instruction.operands.at(k) >= 0; ++k) {
      call.at(k) = registers[static_cast<std::size_t>(instruction.operands.at(k))];
    }
    arguments.push_back(call);
  }
  const Registers results = library({instruction.operation, instruction.format}, arguments);
  if (results.size() != all.size()) {
    throw std::logic_error("a library that does not give one result for each call");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i][target] = results[i];
  }
}

}  // namespace

bool is_of_library(Operation operation) {
  return operation >= Operation::sin && operation <= Operation::tanh;
}

std::vector<LibraryFunction> library_functions(const Listing& listing) {
  std::vector<LibraryFunction> functions;
  for (const Instruction& instruction : listing.instructions) {
    const LibraryFunction function{instruction.operation, instruction.format};
    if (is_of_library(instruction.operation) &&
        std::find(functions.begin(), functions.end(), function) == functions.end()) {
      functions.push_back(function);
    }
  }
  return functions;
}

std::vector<std::uint64_t> own_library(LibraryFunction function,
                                       const std::vector<LibraryArguments>& arguments) {
  const rigor::NearestRounding nearest;
  Instruction instruction;
  instruction.operation = function.operation;
  instruction.format = function.format;
  const std::array<Format, 2> formats{function.format, function.format};
  std::vector<std::uint64_t> results;
  results.reserve(arguments.size());
  for (const LibraryArguments& call : arguments) {
    results.push_back(trackers::code::value_of(instruction, call, formats));
  }
  return results;
}

std::vector<std::vector<std::uint64_t>> registers_of(const Listing& listing,
                                                     const std::vector<StepInput>& steps,
                                                     const Library& library) {
  const rigor::NearestRounding nearest;
  std::vector<Registers> all;
  all.reserve(steps.size());
  for (const StepInput& step : steps) {
    all.push_back(with_inputs(listing, step));
  }
  for (std::size_t i = 0; i < listing.instructions.size(); ++i) {
    const Instruction& instruction = listing.instructions[i];
    if (is_of_library(instruction.operation)) {
      call_library(instruction, library, i, all);
    } else if (instruction.operation != Operation::input) {
      for (Registers& registers : all) {
        registers[i] = computed(listing, instruction, registers);
      }
    }
  }
  return all;
}

int broken_obligation(const Listing& listing, const std::vector<std::uint64_t>& registers) {
  for (std::size_t i = 0; i < listing.obligations.size(); ++i) {
    if (registers[static_cast<std::size_t>(listing.obligations[i].must_be_zero)] != 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

}  // namespace veritrack::certificates::tie

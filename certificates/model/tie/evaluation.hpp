// A listing executed for many steps at once, with results of library functions that someone else gives.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

/// What a step begins with, as bits in the formats of the listing.
struct StepInput {
  std::vector<std::uint64_t> states;
  std::vector<std::uint64_t> samples;
};

/// A function of the library of C in the format of its result: sinf is {sin, f32}.
struct LibraryFunction {
  trackers::code::Operation operation = trackers::code::Operation::sin;
  trackers::code::Format format;

  friend bool operator==(const LibraryFunction&, const LibraryFunction&) = default;
};

/// The arguments of a call; the second one is 0 where there is none.
using LibraryArguments = std::array<std::uint64_t, 2>;

/// The results of a function for these arguments, one each.
using Library =
    std::function<std::vector<std::uint64_t>(LibraryFunction, const std::vector<LibraryArguments>&)>;

/// Whether the operation is a function of the library whose results differ between libraries.
[[nodiscard]] bool is_of_library(trackers::code::Operation operation);

/// The functions that a listing calls, each once, in its order.
[[nodiscard]] std::vector<LibraryFunction> library_functions(const trackers::code::Listing& listing);

/// The library of this process.
[[nodiscard]] std::vector<std::uint64_t> own_library(LibraryFunction function,
                                                     const std::vector<LibraryArguments>& arguments);

/// All registers of the listing, for each of the steps. The library is asked once for each operation of it.
[[nodiscard]] std::vector<std::vector<std::uint64_t>> registers_of(const trackers::code::Listing& listing,
                                                                   const std::vector<StepInput>& steps,
                                                                   const Library& library);

/// The first obligation that the registers do not keep, by its number; -1: all are kept.
[[nodiscard]] int broken_obligation(const trackers::code::Listing& listing,
                                    const std::vector<std::uint64_t>& registers);

}  // namespace veritrack::certificates::tie

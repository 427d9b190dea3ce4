// Functions of the phase and the frequency that are linear in both between points of a grid
// (docs/gain-proof.md, section 10).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

/// By how much a phase in parts of a turn may be wrong that is computed in doubles: of at most 2^26, with two
/// roundings, and two of the frequency.
constexpr double kPlaceError = 0x1p-24;

/// A function of period 2 pi, of several components: linear between its values at the phases 2 pi g/N and at
/// the lowest and the highest frequency of a part, up to an error at every phase and frequency.
struct GridFunction {
  std::array<Table, 2> values;  ///< at the lowest and the highest frequency, by phase and component
  std::vector<double> error;    ///< by component
  [[nodiscard]] bool is_empty() const { return values[0].empty(); }
};

/// Suprema by component of the function without its error, of its differences between neighbours, of half of
/// what it differs by between the frequencies, and of the differences of that between neighbours.
struct GridSizes {
  std::vector<double> value, first_difference, second_difference, lean, lean_difference;
};

/// Whether it has this many phases and components, and all numbers are finite and errors not negative.
bool is_grid_function(const GridFunction& f, std::size_t phases, std::size_t states);
GridSizes grid_sizes(const GridFunction& f);
/// The same as a function of the phase alone, with a larger error.
GridFunction without_lean(GridFunction f);
/// The part of a turn that this whole number is of, in any turn.
std::size_t grid_cell(double cell, std::size_t phases);

}  // namespace veritrack::checker

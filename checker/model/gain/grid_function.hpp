// Functions of the phase that are linear between points of a grid (docs/gain-proof.md, section 10).
#pragma once

#include <cstddef>
#include <vector>

#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

/// By how much a phase in parts of a turn may be wrong that is computed in doubles: of at most 2^26, with two
/// roundings.
constexpr double kPlaceError = 0x1p-24;

/// A function of period 2 pi, of several components: linear between its values at the phases 2 pi g/N, up to
/// an error at every phase and frequency.
struct GridFunction {
  Table values;               ///< by phase and component
  std::vector<double> error;  ///< by component
};

/// Suprema by component of the function without its error, and of its differences between neighbours.
struct GridSizes {
  std::vector<double> value, first_difference, second_difference;
};

/// Whether it has this many phases and components, and all numbers are finite and errors not negative.
bool is_grid_function(const GridFunction& f, std::size_t phases, std::size_t states);
GridSizes grid_sizes(const GridFunction& f);
/// Without its error at the phase `place`, in parts of a turn, which is known up to kPlaceError. Zeros for a
/// function without values.
WideRow value_at(const GridFunction& f, const GridSizes& sizes, double place);
/// The part of a turn that this whole number is of, in any turn.
std::size_t grid_cell(double cell, std::size_t phases);

}  // namespace veritrack::checker

// Boxes that cover an ellipsoid of errors, each with the numbers with which Coq checks it: a proposal.
#pragma once

#include <memory>
#include <optional>

#include "analysis/quadrature/true_phase/cell_forms.hpp"

namespace veritrack::quadrature {

/// The type `tree` of cover.v: a box is checked with `numbers`, lies outside, or is cut in two.
struct CellTree {
  enum class Kind { checked, outside, cut };
  Kind kind = Kind::outside;
  CellNumbers numbers;  ///< of a checked box
  int axis = 0;         ///< of a cut: 0, 1 or 2
  double at = 0.0;
  std::unique_ptr<CellTree> below, above;
};

/// A symmetric box around the ellipsoid, two parts in ten thousand wider.
[[nodiscard]] ErrorBox box_around(const ErrorEllipsoid& set);

/// Numbers with which all forms are positive over the box; nothing where none are found. Needs the upward
/// mode.
[[nodiscard]] std::optional<CellNumbers> numbers_for(const trackers::ToneModel<double>& design,
                                                     const ErrorEllipsoid& set, const ErrorBox& box);

/// Null when more boxes than that are needed. Needs the upward mode.
[[nodiscard]] std::unique_ptr<CellTree> cover(const trackers::ToneModel<double>& design,
                                              const ErrorEllipsoid& set, int most_boxes);

}  // namespace veritrack::quadrature

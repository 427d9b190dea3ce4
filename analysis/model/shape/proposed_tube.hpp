// The input and the result of proposing a tube over a cell of frequencies, for trackers with and without a
// filter's covariance.
#pragma once

#include <optional>

#include "analysis/model/shape/shape_proposal.hpp"
#include "analysis/model/steady_state/steady_state.hpp"
#include "analysis/model/step/tube.hpp"

namespace veritrack::model {

struct TubeSettings {
  ShapeSettings shape;
  SteadyStateSettings steady_state;
  /// The error of estimated frequencies on the curve against those on the true steady state, rad/sample: the
  /// accuracy to which a bias and a ripple can be known.
  double largest_curve_error = 1e-8;
  /// For trackers with few states the curve is a polynomial of a higher degree in the frequency, so that a
  /// bias is known to a thousandth of that.
  bool fine_curve = false;
  /// The loss of the shape's worth by interpolation in the frequency.
  double largest_loss = 0.15;
  /// The variation of the worth over the cell: 1 minus the ratio of its least to its largest value.
  double largest_variation = 0.5;
};

enum class TubeOutcome {
  proposed,
  no_steady_state,  ///< see the steady state
  no_curve,         ///< the steady state of the simulation is not one at some frequency of the cell
  no_shape,         ///< no tube around the curve contracts
  no_common_shape,  ///< none contracts over all of the cell; perhaps in a part of it
  time_limit,       ///< it was not tried
  cell_too_wide     ///< curve or shape are no polynomials in the frequency over this cell: see the numbers
};

/// A tube, or the reason why there is none.
struct TubeProposal {
  TubeOutcome outcome = TubeOutcome::no_steady_state;
  double frequency = 0.0;   ///< of the middle, rad/sample
  double half_width = 0.0;  ///< rad/sample
  SteadyState steady_state;
  double curve_error = 0.0;  ///< estimated, rad/sample
  double loss = 0.0;         ///< the largest over the cell
  double variation = 0.0;    ///< of the worth over the cell
  ShapeProposal shape;       ///< the parameters, and their worth at the middle
  /// Over the cell, for the tube as it is: the level is a guess for its radius, rad/sample.
  ShapeWorth worth;
  std::optional<Tube> tube;  ///< when proposed; its curve and shape also when the cell is too wide
};

}  // namespace veritrack::model

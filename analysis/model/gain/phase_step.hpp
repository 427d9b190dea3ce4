// A step over a cell of phases and frequencies, as a network: bases and slopes of its values, and remainders
// whose sizes are known (docs/gain-proof.md, section 10).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/model/step/tube_models.hpp"

namespace veritrack::model {

/// A steady state over the phase, and a basis in which the coefficients of its errors are constant:
/// X = C(phi, omega) + P(phi, omega) eta, eta+ = (matrix(omega) + E) eta.
struct FloquetCell {
  Tube curve;                               ///< without a shape
  std::vector<PhaseSeries> basis;           ///< row by row
  std::vector<std::vector<double>> matrix;  ///< coefficients of z^d, row by row

  [[nodiscard]] std::size_t states() const { return curve.curve.size(); }
};

/// A weight of an input or a remainder in the same sample, at most.
struct DirectWeight {
  int input = 0;
  double weight = 0.0;
};

/// A value that a rule is about: its deviation is c eta + direct terms.
struct PhaseForm {
  std::vector<rigor::BallModel> states;
  std::vector<DirectWeight> direct;
};

/// The largest size of a remainder at these bounds of the forms; infinite where the rule does not hold.
using RemainderSize = std::function<double(const std::vector<double>& bounds)>;

/// An input of a sample.
struct PhaseInput {
  bool is_noise = false;
  RemainderSize size;                 ///< of a remainder
  std::vector<DirectWeight> sources;  ///< of a gate: its size is the sum of those of these
};

/// The step over a cell. Inputs are numbered as they arise: first the components of the noise.
struct PhaseStep {
  std::vector<PhaseInput> inputs;
  /// With rounding the first ones are the states; the last one is the frequency error.
  std::vector<PhaseForm> forms;
  std::vector<int> gates;                                ///< remainders, gathered or alone, that have columns
  std::vector<std::vector<rigor::BallModel>> matrix;     ///< rows, in the basis
  std::map<int, std::vector<rigor::BallModel>> columns;  ///< of noise and gates
  std::vector<std::vector<rigor::BallModel>> inverse;    ///< of the basis at the end of the step
  /// The inverse times the derivative of the basis by the frequency.
  std::vector<std::vector<rigor::BallModel>> basis_slope;
  std::vector<rigor::BallModel> residual;  ///< in the basis
  std::vector<rigor::BallModel> slew;      ///< column of a slew, but for the curve's bend
  rigor::BallModel bias;                   ///< the frequency error on the curve, rad/sample
  std::vector<double> rounding;            ///< of the states after the step and of the frequency, at most
  /// The one state of which the frequency is a multiple, and the factor; or none.
  std::optional<std::pair<std::size_t, rigor::Interval>> frequency_state;
};

/// Over a part of the cell's phases and frequencies. The structure is the same for all parts. Throws NoFrame
/// where the rules do not cover the step, and NoRounding. Needs the upward rounding mode and a scope of ball
/// models without vectors.
[[nodiscard]] PhaseStep phase_step(const TrackerModel& tracker, const FloquetCell& cell,
                                   const TubeCell& part);

}  // namespace veritrack::model

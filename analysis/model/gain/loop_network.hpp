// A loop as a network: a linear recursion of its errors, with inputs whose sizes are known
// (docs/gain-proof.md, section 3).
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/linear/worst_case_gains.hpp"
#include "analysis/model/steady_state/steady_state.hpp"
#include "analysis/model/step/tube_step.hpp"

namespace veritrack::model {

/// The state at the phase phi and the frequency omega: turns phi + constant + per_frequency omega. With
/// `imaginary` it is the real part of a vector with this angle, and the state of that number its imaginary
/// part, in whose place is the length of the vector, or 0 where it may have any.
struct SteadyValue {
  int turns = 0;
  double constant = 0.0;
  double per_frequency = 0.0;
  std::optional<std::size_t> imaginary = std::nullopt;
};

/// Whether the length of a vector is known.
[[nodiscard]] bool has_length(const SteadyValue& vector, const std::vector<SteadyValue>& steady);

/// An input of the network.
struct NetworkInput {
  enum class Cause { noise, slew, remainder, residual, rounding };
  Cause cause = Cause::noise;
  std::string what;  ///< of a remainder: the operation
  /// The size at most: of noise at this noise, of a slew at this slew, of a remainder at these bounds of the
  /// forms.
  std::function<double(double noise, double slew, const std::vector<double>& bounds)> size;
};

/// The weights of an input in a form within the sample, as many as it has components.
struct DirectTerm {
  std::size_t input = 0;
  double weight = 0.0;  ///< the length of the weights, at most
};

struct LoopNetwork {
  std::vector<linear::Row> a;                          ///< rows
  std::vector<linear::GainInput> columns;              ///< of the inputs
  std::vector<NetworkInput> inputs;                    ///< in the same order
  std::vector<linear::Row> forms;                      ///< the last one is the frequency error
  std::vector<std::vector<DirectTerm>> direct;         ///< of the forms
  std::vector<std::size_t> angle_forms;                ///< the forms that are angles
  std::vector<std::pair<std::size_t, double>> limits;  ///< |form| < room
  rigor::Interval bias;  ///< the frequency error in the steady state, rad/sample
  /// One channel: what turns with the signal adds to each form, and to each state at the start.
  std::vector<double> ripple;
  std::vector<double> ripple_at_start;
  /// The same for the frequency error, one by one, with the form that is the error of its angle.
  struct TurningPart {
    double error = 0.0;
    std::size_t angle = 0;
  };
  std::vector<TurningPart> turning;
  bool shares_noise = false;             ///< the noise of a sample is one input
  bool may_rest_at_kink = false;         ///< then there is no matrix to first order
  bool has_ripples = false;              ///< then bounds are for a constant frequency
  std::vector<std::size_t> state_forms;  ///< with rounding: the forms that are the states, in their order
  double rounding_of_frequency = 0.0;    ///< what the reported frequency is off, rad/sample
  double most_noise = INFINITY;          ///< with rounding: no more is covered
  /// A program has samples of this amplitude at most that are turned by up to so many rad:
  /// docs/gain-proof.md, section 12. Inputs do not count it, the bounds do.
  double turned = 0.0, largest_amplitude = 0.0;
  /// The one state of which the frequency error is a multiple, and the factor; or none.
  std::optional<std::pair<std::size_t, double>> frequency_state;
};

/// At the frequencies of `band`, rad/sample. With `shares_noise` the noise of a sample is one input wherever
/// it comes in. Throws NoFrame where the rules do not cover the loop. Needs the upward rounding mode.
[[nodiscard]] LoopNetwork loop_network(const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                                       const rigor::Interval& band, bool shares_noise = false);

/// How far a step leads away from a proposed steady state at one frequency, and the matrix. Not evidence.
struct StepResidual {
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;
};
/// Throws NoFrame. Needs the upward rounding mode.
[[nodiscard]] StepResidual step_residual(const TrackerModel& tracker, const std::vector<SteadyValue>& steady,
                                         double omega);

}  // namespace veritrack::model

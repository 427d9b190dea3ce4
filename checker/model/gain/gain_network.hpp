// The errors of a loop of one channel or two about its steady state: a linear recursion with inputs of known
// size (docs/gain-proof.md, section 3).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "checker/model/gain/linear_frame.hpp"
#include "checker/model/model_design.hpp"
#include "checker/model/model_recursion.hpp"

namespace veritrack::checker {

/// The steady value of a state: turns phi + constant + per_frequency omega. With `imaginary` the state is the
/// real part of a vector of any length with this angle, and the state of that number, which has zeros here,
/// its imaginary part.
struct SteadyState {
  long turns = 0;
  Ball constant, per_frequency;
  std::optional<std::size_t> imaginary = std::nullopt;
};

/// An input with its column B.
struct GainInput {
  std::vector<InputFactor> column;  ///< by state
  /// The size of noise, of the slew and of residuals.
  std::function<Ball(const Ball& noise, const Ball& slew)> size;
  /// The forms that a remainder is about, and its size at their bounds.
  std::vector<std::size_t> about;
  std::function<Ball(const std::vector<Ball>& bounds)> at_bounds;
  bool is_residual = false;  ///< of the steady state

  [[nodiscard]] bool is_remainder() const { return !about.empty(); }
};

/// y = row xi + the sum of direct inputs.
struct GainForm {
  std::vector<Ball> row;
  std::map<std::size_t, InputFactor> direct;  ///< by input
};

/// low < base + y < high for this form.
struct GainLimit {
  std::size_t form = 0;
  Ball base, low, high;
};

/// An input that turns with the signal, z e^(j turns phi_(k+1)) with |z| = size. Its responses are known; its
/// column is no part of the sums over earlier samples.
struct GainRipple {
  std::size_t input = 0;
  long turns = 0;
  Ball size;
  std::size_t angle_form = 0;   ///< of z, but for a constant
  std::size_t change_form = 0;  ///< by which this angle changes at a sample
  /// At least |c Pi| size of each form, and |Pi| size of each state.
  std::vector<Ball> of_form, of_state;
  /// With Pi = kappa g + rho: at least |kappa| size, and |rho| size of each state.
  Ball direct;
  std::vector<Ball> rest_of_state;
};

struct GainNetwork {
  std::vector<std::vector<Ball>> matrix;
  std::vector<GainInput> inputs;
  std::vector<GainForm> forms;
  std::vector<GainLimit> limits;
  std::vector<std::size_t> angle_forms;  ///< the forms that are angles
  std::vector<GainRipple> ripples;       ///< at a constant frequency only
  std::size_t error_form = 0;            ///< h(X_k) - omega_k, less the bias
  Ball bias;                             ///< over the band
  /// The listed state is steady up to rounding, and crosses no limit.
  bool is_at_rest = true;
  bool has_vector = false;      ///< two states are one angle: samples that are kept
  std::vector<long> turns;      ///< of the states in the steady state, of the phase
  std::vector<Ball> frequency;  ///< the row of the frequency
  Ball least_amplitude;         ///< noise must be below it
  bool is_rounded = false;      ///< a program's rounding is among the inputs
  /// A program has samples of this amplitude at most that are turned by up to so many rad.
  Ball turned, largest_amplitude;
  std::vector<Ball> rounding_of_start;  ///< by state; or empty
  Ball rounding_of_frequency;           ///< what the program's frequency is off from that of its states

  [[nodiscard]] std::size_t states() const { return matrix.size(); }
  /// Noise of at most that, and what turns the samples.
  [[nodiscard]] Ball with_turns(const Ball& noise) const {
    return noise + turned * (largest_amplitude + noise);
  }
  /// Whether the errors obey the matrix to first order. A ripple changes with them, at each phase otherwise.
  [[nodiscard]] bool has_one_matrix() const { return ripples.empty(); }
};

/// Throws NotCovered where the method says nothing. One steady state for each state; turns of angles alone.
/// With `has_one_noise` the noise of a sample is one input wherever it comes in.
GainNetwork gain_network(const ModelRecursion& recursion, const ModelDesign& design,
                         const std::vector<SteadyState>& steady, bool has_one_noise = false);

}  // namespace veritrack::checker

// The steady state of a tracker on a tone, by simulation: a proposal, with the numbers for a message when it
// does not settle as it should.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/steady_state/neutral_turn.hpp"
#include "analysis/model/steady_state/step_derivatives.hpp"
#include "analysis/search/deadline.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::model {

/// The state at phase 0 from which the user lets the simulation begin, for a frequency in rad/sample.
using StartState = std::function<std::vector<double>(double frequency)>;

/// A tracker on its signal.
struct TrackedTone {
  StepMap step;
  Signal signal;
  double amplitude = 1.0;
  StartState start;
  std::vector<std::string> names = {};  ///< of the states, for messages; or empty
  /// For a filter whose covariance tubes are to bound; otherwise none.
  const trackers::FilterParts* filter = nullptr;
  /// The meaning of an undefined operation of the step, one for each: for messages; or empty.
  std::vector<std::string> objections = {};
  /// The distance of the samples' amplitudes from this one, at most, where they vary.
  double amplitude_deviation = 0.0;
};

/// Approximately the largest error of a sample from the amplitudes, all channels together.
[[nodiscard]] double error_from_amplitude(const TrackedTone& tone);

enum class SteadyStateOutcome {
  settled,
  /// A state became infinite, undefined or huge after `samples`.
  diverges,
  /// After `samples` the state at phase 0 still moves by `drift` in `period` samples.
  still_drifts,
  /// It returns after `repetition` turns of the phase only (2, 3, ...), or jumps to and fro from one sample
  /// to the next.
  repeats_later,
  /// The mean of the estimated frequency is biased by `mean_error`: more than was allowed.
  locked_elsewhere,
  /// Errors grow by `rate` a sample, 1 within the accuracy of the simulation; `mode` shows in which states.
  not_exponentially_stable
};

struct SteadyStateSettings {
  int samples = 400000;                  ///< at most
  double largest_mean_error = INFINITY;  ///< rad/sample: half the band
  search::Deadline deadline = {};        ///< after which no further period is simulated
};

/// The simulation uses a frequency 2 pi p/q next to the one asked for, so that phases return exactly.
struct SteadyState {
  SteadyStateOutcome outcome = SteadyStateOutcome::diverges;
  std::vector<std::string> names;  ///< of the states; or empty
  double asked_frequency = 0.0;
  double frequency = 0.0;  ///< 2 pi p/q, rad/sample
  int period = 0;          ///< q, samples
  int samples = 0;         ///< that were simulated
  Eigen::VectorXd drift;   ///< of each state in the last period
  int slowest_state = -1;  ///< whose drift is the largest for its size
  int repetition = 1;
  double mean_frequency = 0.0;  ///< of the estimates over the last period
  double mean_error = 0.0;      ///< mean_frequency - frequency
  double rate = 1.0;            ///< growth of small errors per sample over the last period; 0 when unknown
  /// The left eigenvector of the product of the Jacobians over the last period, for states in units of their
  /// size; its largest entry is 1. Empty when unknown.
  Eigen::VectorXd mode;
  /// Where errors do not decay: a turn that the tracker does not notice.
  std::optional<NeutralTurn> neutral;
  std::vector<int> turns;  ///< of each state while the phase turns once
  /// n x q when settled: the states at phases 2 pi j/q, minus turns times the phase.
  Eigen::MatrixXd states;
  /// When it diverges because an operation of the step is undefined: the tone's words for it; or empty.
  std::string undefined = {};
};

/// Simulates until the state returns after every period, up to 1e-9 of its size. Deterministic; holds
/// round-to-nearest. Throws std::invalid_argument when the sizes do not fit.
[[nodiscard]] SteadyState find_steady_state(const TrackedTone& tone, double frequency,
                                            const SteadyStateSettings& settings = {});

}  // namespace veritrack::model

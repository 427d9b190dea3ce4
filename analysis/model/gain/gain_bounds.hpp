// Bounds of a loop's errors for ever, after some time and in the long run, from its gains
// (docs/gain-proof.md, section 5).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/model/gain/loop_network.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// The disturbances, and the start: the largest deviation of each state from the steady state.
struct LoopDisturbance {
  double noise = 0.0;              ///< signal units
  double slew = 0.0;               ///< rad/sample per sample
  std::vector<double> start = {};  ///< empty: in the steady state
};

/// The contributions to the frequency error in the long run, rad/sample, each at most.
struct ErrorBudget {
  double noise = 0.0, slew = 0.0, remainders = 0.0, steady_state = 0.0;
  double ripple = 0.0;    ///< one channel: what turns with the signal
  double rounding = 0.0;  ///< of the program
};

/// Bounds of the frequency error, rad/sample.
struct LoopBounds {
  double for_ever = 0.0;
  std::vector<double> from_block;  ///< from the first sample of each block on
  double long_run = 0.0;
  double mean =
      0.0;  ///< of the error without the bias, over the phase, in the long run at a constant frequency
  ErrorBudget budget;          ///< of the long run
  std::vector<double> states;  ///< with rounding: how far each is from the steady state, at most
  /// With rounding: from what a step of each state is off to the frequency error in the long run.
  std::vector<double> rounding_gains;
};

class GainBounds {
 public:
  /// Empty unless errors decay. `samples`: the horizon, a multiple of `blocks`. Needs the upward rounding
  /// mode, as all of this.
  [[nodiscard]] static std::optional<GainBounds> make(LoopNetwork network, std::size_t samples,
                                                      std::size_t blocks);

  [[nodiscard]] const LoopNetwork& network() const { return network_; }
  [[nodiscard]] std::size_t samples() const { return samples_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_; }
  /// The worst-case gain from inputs of this cause to the frequency error: its size in the long run where the
  /// loop is linear.
  [[nodiscard]] double linear_error(double noise, double slew) const;
  /// The frequency error from the listed steady state, which is only approximate.
  [[nodiscard]] double residual_error() const;

  /// Whether a remainder of this operation is above 0 where errors are what noise makes them to first order.
  [[nodiscard]] bool acts(std::string_view operation, double noise) const;

  /// Empty where no bound closes, or none has closed at the deadline.
  [[nodiscard]] std::optional<LoopBounds> bounds(const LoopDisturbance& disturbance,
                                                 const search::Deadline& deadline = {}) const;

 private:
  GainBounds(LoopNetwork network, linear::WorstCaseGains gains, std::size_t samples, std::size_t blocks);

  using Bounds = std::vector<double>;  // of the forms
  [[nodiscard]] std::vector<double> sizes(const LoopDisturbance& disturbance, const Bounds& bounds) const;
  [[nodiscard]] bool keeps_limits(const Bounds& bounds) const;
  [[nodiscard]] Bounds start_of_block(const LoopDisturbance& disturbance, std::size_t block) const;
  [[nodiscard]] std::optional<std::vector<Bounds>> sequence(const LoopDisturbance& disturbance,
                                                            const search::Deadline& deadline) const;
  [[nodiscard]] Bounds in_the_long_run(const LoopDisturbance& disturbance, Bounds bounds) const;
  class Block;

  LoopNetwork network_;
  linear::WorstCaseGains gains_;
  std::size_t samples_, blocks_;
  std::vector<std::vector<double>> total_;  // by form, by input: with direct terms
};

}  // namespace veritrack::model

// The covariances that an extended Kalman filter of [model.ekf] assigns to its innovation and to its
// frequency.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// Innovation and its covariance are intermediate results of the filter's step; this is the same step with
/// them as its results.
class FilterBelief {
 public:
  /// `states`: the number of states of the filter's model, without the covariance. Throws std::logic_error
  /// for a recursion that was not written out from a filter.
  FilterBelief(const Model& model, std::size_t states);

  struct Innovation {
    std::array<double, 2> value;
    double nis;
  };
  /// For the step from this state with these samples. `inputs`: constants, state, samples.
  [[nodiscard]] Innovation innovation(std::span<const double> inputs);

  /// The deviation of the estimated frequency, rad/sample, to first order. `inputs`: constants, state.
  [[nodiscard]] double frequency_deviation(std::span<const double> inputs);

 private:
  [[nodiscard]] std::size_t variance_of(std::size_t state) const;

  trackers::StraightLineProgram innovation_;
  trackers::StraightLineProgram frequency_;
  std::size_t constants_;
  std::size_t states_;
  std::size_t channels_;
  std::optional<std::size_t> frequency_state_;  ///< the place of its variance, where the frequency is a state
  std::vector<double> registers_;
  std::vector<double> results_;
  std::vector<double> shifted_;
  std::vector<double> gradient_;
};

}  // namespace veritrack::certificates

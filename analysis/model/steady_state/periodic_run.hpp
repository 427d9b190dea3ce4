// The simulation behind steady_state.hpp: period after period of a signal whose phases return exactly.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/model/steady_state/steady_state.hpp"

namespace veritrack::model::detail {

/// The frequency 2 pi turns/samples.
struct Fraction {
  int turns = 1;
  int samples = 1;
};

/// The fraction next to a frequency in (0, pi), rad/sample. Neither of its numbers has a factor that a short
/// repetition would share.
[[nodiscard]] Fraction nearby_fraction(double frequency);

/// A run of one period after the other. States that are angles are kept small by whole turns.
class PeriodicRun {
 public:
  PeriodicRun(const TrackedTone& tone, const Fraction& fraction, const std::vector<double>& start);

  /// One period more.
  void run();

  /// The states of the last period, its beginning and its end included, the angles unwound.
  [[nodiscard]] const Eigen::MatrixXd& states() const { return states_; }
  [[nodiscard]] const Eigen::MatrixXd& samples() const { return samples_; }
  [[nodiscard]] double mean_frequency() const { return mean_frequency_; }
  /// The state after it, angles wrapped, and the number of turns removed so far.
  [[nodiscard]] const Eigen::VectorXd& wrapped() const { return state_; }
  [[nodiscard]] const Eigen::VectorXd& wound() const { return wound_; }

 private:
  const TrackedTone* tone_;
  Eigen::VectorXd state_;
  Eigen::MatrixXd samples_;
  Eigen::MatrixXd states_;
  Eigen::VectorXd wound_;
  double mean_frequency_ = 0.0;
};

/// The states of the last period in the order of their phases, minus turns times the phase.
[[nodiscard]] Eigen::MatrixXd sorted_states(const PeriodicRun& run, const Fraction& fraction,
                                            const std::vector<int>& turns);

/// Remembers the ends of all periods.
class History {
 public:
  void add(const PeriodicRun& run);
  [[nodiscard]] bool reaches(int periods) const { return static_cast<int>(ends_.size()) > periods; }
  /// The change over the last `periods` periods, angles modulo 2 pi.
  [[nodiscard]] Eigen::VectorXd change(int periods, const std::vector<bool>& is_angle) const;
  /// The turns of each angle over the last `periods` periods, once it returns.
  [[nodiscard]] Eigen::VectorXd turns(int periods) const;

 private:
  std::vector<Eigen::VectorXd> ends_;
  std::vector<Eigen::VectorXd> wound_;
};

}  // namespace veritrack::model::detail

// Sets around the steady state as a few samples see them, in floating point: for proposals only.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/leak/steady_proposal.hpp"
#include "analysis/quadrature/leak/steady_step.hpp"

namespace veritrack::quadrature {

/// The samples of one request: settings of a step at each of its steady states.
class SteadySamples {
 public:
  SteadySamples(const SteadyRequest& request, SteadyJudgement judgement);

  /// [[e^x0, x3, x4], [0, 1, x2], [0, 0, e^x1]] times the root of the inverse of a steady covariance, which
  /// is the metric that the theory of linear Kalman filters suggests.
  [[nodiscard]] rigor::Matrix<3> metric(const Eigen::VectorXd& x) const;

  [[nodiscard]] std::vector<SteadySetting<double>> settings(const rigor::Matrix<3>& t) const;

  /// Moves the band out until it contains the images of the samples on the boundary, with the share `goal` of
  /// itself to spare. False when it runs away.
  bool find_band(std::vector<SteadySetting<double>>& settings, double noise, double goal, int angles) const;

  /// The fraction of the level s into which a step maps it: errors and covariance, noise and slew included;
  /// infinity when a sample makes no sense.
  [[nodiscard]] double rate(const std::vector<SteadySetting<double>>& settings, double level, double noise,
                            int angles) const;

 private:
  [[nodiscard]] rigor::Matrix<3> enter(const rigor::Matrix<3>& p) const;
  [[nodiscard]] double motion_of(const SteadySetting<double>& setting, std::size_t k) const;
  /// From the roots of the bounds of the band.
  [[nodiscard]] double covariance_motion(const rigor::Matrix<3>& below, const rigor::Matrix<3>& above,
                                         std::size_t k) const;

  /// The share of the level that the errors fill after a step from there; nothing when it makes no sense.
  [[nodiscard]] std::optional<double> error_share(const SteadySetting<double>& setting,
                                                  const SteadyPlace<double>& place, double noise) const;
  /// Calls `use` with (P+ - P*)/s of both bounds for samples on the boundary, a few inside and the middle,
  /// and several turns each. False when a sample makes no sense.
  template <typename Use>
  [[nodiscard]] bool for_each_image(const SteadySetting<double>& setting, double level, double noise,
                                    int angles, const Use& use) const;

  SteadyRequest request_;
  SteadyJudgement judgement_;
  rigor::Matrix<3> root_;
  rigor::Matrix<3> inverse_root_;
};

}  // namespace veritrack::quadrature

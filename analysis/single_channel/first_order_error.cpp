#include "analysis/single_channel/first_order_error.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::single_channel {

namespace {

/// What a sample does to the errors.
struct Step {
  Eigen::Matrix3d errors;  ///< A
  Eigen::Vector3d noise;   ///< K
};

/// In exact lock, from a covariance that forgets how it began.
std::vector<Step> steps_in_lock(const trackers::ToneModel<double>& design, double frequency, int count) {
  Eigen::Matrix3d prediction = Eigen::Matrix3d::Identity();
  prediction(1, 2) = 1.0;
  Eigen::Matrix3d process_noise = Eigen::Matrix3d::Zero();
  process_noise.diagonal() << design.q1, design.q1, design.q2;
  Eigen::Matrix3d covariance = process_noise + design.r * Eigen::Matrix3d::Identity();
  std::vector<Step> steps;
  for (int k = 0; k < count; ++k) {
    const Eigen::Matrix3d predicted = prediction * covariance * prediction.transpose() + process_noise;
    const double phase = k * frequency;
    const Eigen::Vector3d measured(std::cos(phase), -std::sin(phase), 0.0);
    const Eigen::Vector3d gain = predicted * measured / (measured.dot(predicted * measured) + design.r);
    const Eigen::Matrix3d kept = Eigen::Matrix3d::Identity() - gain * measured.transpose();
    covariance = kept * predicted;
    covariance = (0.5 * (covariance + covariance.transpose())).eval();
    steps.push_back({kept * prediction, gain});
  }
  return steps;
}

}  // namespace

double first_order_error(const trackers::ToneModel<double>& design, double frequency, double noise,
                         double slew) {
  constexpr int kSettling = 4000;
  constexpr int kPhases = 48;
  const rigor::NearestRounding nearest;
  const std::vector<Step> steps = steps_in_lock(design, frequency, kSettling + kPhases);
  double most = 0.0;
  for (int last = kSettling; last < kSettling + kPhases; ++last) {
    Eigen::RowVector3d row = Eigen::RowVector3d::UnitZ();
    double sum = 0.0;
    for (int k = last; k >= 0; --k) {
      const Step& step = steps[static_cast<std::size_t>(k)];
      sum += noise * std::fabs(row.dot(step.noise));
      row = (row * step.errors).eval();
      sum += slew * std::fabs(row(2));
    }
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace veritrack::single_channel

#include "analysis/quadrature/gaussian/leaking_filter.hpp"

#include <Eigen/LU>
#include <cmath>

#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

namespace {

using trackers::RotatingFrameState;

/// X = A X A' + Y, by doubling; nothing when it does not settle.
template <typename Matrix>
std::optional<Matrix> sum_of_images(Matrix power, Matrix sum) {
  constexpr int kDoublings = 40;
  constexpr double kGone = 1e-9;
  for (int k = 0; k < kDoublings; ++k) {
    sum = (sum + power * sum * power.transpose()).eval();
    power = (power * power).eval();
  }
  return sum.allFinite() && power.norm() < kGone ? std::optional(sum) : std::nullopt;
}

}  // namespace

std::optional<LeakingFilter> leaking_filter(const trackers::ToneModel<double>& design, double frequency) {
  const auto centre = lock_centre(design, frequency);
  if (!centre) {
    return std::nullopt;
  }
  const auto& [errors, p] = *centre;
  RotatingFrameState<double> x;
  x << errors[0], errors[1], errors[2], p.p11, p.p12, p.p13, p.p22, p.p23, p.p33;
  const auto image = [&](const RotatingFrameState<double>& from, double in_phase, double quadrature) {
    return trackers::rotating_frame_map(from, {in_phase, quadrature, 0.0, frequency}, design);
  };
  // Central differences; the noise enters linearly.
  constexpr double kStep = 1e-6;
  LeakingFilter filter{*centre, {}, {}, {}, {}};
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double size = i > trackers::kFrequencyError ? kStep * p.p33 : kStep;
    RotatingFrameState<double> way = RotatingFrameState<double>::Zero();
    way[i] = size;
    filter.step.col(i) = (image(x + way, 0.0, 0.0) - image(x - way, 0.0, 0.0)) / (2.0 * size);
  }
  const RotatingFrameState<double> still = image(x, 0.0, 0.0);
  filter.noise.col(0) = image(x, 1.0, 0.0) - still;
  filter.noise.col(1) = image(x, 0.0, 1.0) - still;
  const Eigen::Matrix3d a = filter.step.topLeftCorner<3, 3>();
  const Eigen::Vector3d e3 = Eigen::Vector3d::UnitZ();
  const auto later = sum_of_images<Eigen::Matrix3d>(a.transpose(), e3 * e3.transpose());
  if (!later) {
    return std::nullopt;
  }
  filter.later = *later;
  filter.later_sum = (Eigen::Matrix3d::Identity() - a.transpose()).lu().solve(e3);
  return filter;
}

std::optional<double> mean_square_frequency_error(const LeakingFilter& filter, double noise_deviation) {
  using Matrix = Eigen::Matrix<double, 9, 9>;
  const auto covariance = sum_of_images<Matrix>(
      filter.step, noise_deviation * noise_deviation * filter.noise * filter.noise.transpose());
  if (!covariance) {
    return std::nullopt;
  }
  const double bias = filter.steady.errors[2];
  return bias * bias + (*covariance)(trackers::kFrequencyError, trackers::kFrequencyError);
}

}  // namespace veritrack::quadrature

#include "certificates/quadrature/linear_filter.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/spectral_radius.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_simulation.hpp"
#include "certificates/sets/linear_loop_table.hpp"

namespace veritrack::certificates {

namespace {

/// The rows and columns 1 and 2 of the matrix, and of the gain times H F.
linear::DetectorLoop detector_of(const Eigen::Matrix3d& closed, const Eigen::Vector3d& gain,
                                 const Eigen::RowVector3d& predicted) {
  linear::DetectorLoop loop;
  for (Eigen::Index i = 1; i < 3; ++i) {
    loop.a.push_back({rigor::Interval(closed(i, 1)), rigor::Interval(closed(i, 2))});
    loop.effect.emplace_back(gain(i));
    loop.phase.emplace_back(predicted(i));
  }
  return loop;
}

/// Until errors are gone.
std::size_t samples_of(const Eigen::Matrix3d& closed) {
  constexpr double kGone = 1e-6;
  constexpr double kMost = 1e6;
  const double radius = rigor::spectral_radius(closed);
  return static_cast<std::size_t>(std::clamp(std::log(kGone) / std::log(radius), 16.0, kMost));
}

}  // namespace

std::optional<LinearFilter> linear_filter(const Design& design) {
  const rigor::NearestRounding nearest;
  const QuadratureEkfTables& tables = quadrature_tables(design);
  const auto& band = tables.assume.frequency;
  const SteadyState steady = find_steady_state(design, 0.5 * (band[0].nearest + band[1].nearest));
  if (tables.design.epsilon.nearest != 0.0 || !steady.settled) {
    return std::nullopt;
  }
  // Across the signal an error of the frequency adds its amplitude at each step.
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  transition(1, 2) = tables.assume.amplitude.nearest;
  const Eigen::Matrix<double, 3, 2> gain = steady.covariance.leftCols<2>() / tables.design.r.nearest;
  LinearFilter filter;
  const Eigen::Matrix3d closed = transition - gain * transition.topRows<2>();
  filter.loop.a = closed;
  filter.loop.noise = gain;
  filter.loop.step = Eigen::Vector3d(0.0, 0.0, -1.0);
  filter.loop.estimate = Eigen::RowVector3d(0.0, 0.0, 1.0);
  filter.detector = detector_of(closed, gain.col(1), transition.row(1));
  return filter;
}

std::string linear_filter_section(const Certificate& certificate) {
  const auto filter = linear_filter(certificate.design);
  if (!filter || !(rigor::spectral_radius(filter->loop.a) < 1.0)) {
    return "";
  }
  return "## The linear filter\n\nIn its steady state, on a tone in the middle of the band and to first "
         "order in "
         "the errors, the filter has constant gains in the frame that turns with the signal. Large errors, "
         "and a "
         "covariance that has not settled yet, are not covered by this table. Its detector is the innovation "
         "across the signal; margins are for gains that stay as they are.\n\n" +
         linear_loop_table(filter->loop, samples_of(filter->loop.a), filter->detector,
                           quadrature_tables(certificate.design).assume.sample_rate);
}

}  // namespace veritrack::certificates

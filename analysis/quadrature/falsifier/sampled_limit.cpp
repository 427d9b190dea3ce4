#include "analysis/quadrature/falsifier/sampled_limit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/quadrature/falsifier/falsifier_run.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

namespace {

/// A start on the boundary, by angles: two for the direction of T e, three for the eigenvectors and three for
/// the eigenvalues of the share Y of the covariance, one for the noise, one for the slew.
constexpr Eigen::Index kAngles = 10;

class Escape {
 public:
  explicit Escape(const SetClaim& claim) : claim_(claim), random_(20261121) {}

  /// The largest |T e+| / radius that ascent finds from the best start so far and a few new ones.
  double largest_ratio(double radius) {
    constexpr int kNewStarts = 6;
    search::SearchSpace space{best_, Eigen::VectorXd::Constant(kAngles, 0.2),
                              Eigen::VectorXd::Constant(kAngles, -20.0),
                              Eigen::VectorXd::Constant(kAngles, 20.0), 800};
    double largest = 0.0;
    for (int i = 0; i <= kNewStarts; ++i) {
      const search::BestPoint found =
          search::climb([&](const Eigen::VectorXd& x) { return ratio(x, radius); }, space);
      if (found.value > largest) {
        largest = found.value;
        best_ = found.point;
      }
      for (Eigen::Index k = 0; k < kAngles; ++k) {
        space.start[k] = random_.uniform() * 2.0 * std::numbers::pi;
      }
    }
    return largest;
  }

 private:
  [[nodiscard]] double ratio(const Eigen::VectorXd& x, double radius) const {
    const Eigen::Vector3d direction(std::sin(x[0]) * std::cos(x[1]), std::sin(x[0]) * std::sin(x[1]),
                                    std::cos(x[0]));
    const Eigen::Vector3d error = claim_.center() + claim_.inverse_metric() * direction * radius;
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(x[2], Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(x[3], Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(x[4], Eigen::Vector3d::UnitZ()))
                                     .toRotationMatrix();
    const Eigen::Vector3d share = 0.5 * (1.0 + x.segment<3>(5).array().sin());
    const PolarState state{{error[0], error[1], error[2]},
                           trackers::PolarCovariance<double>::from_matrix(
                               claim_.covariance_at(turn * share.asDiagonal() * turn.transpose()))};
    const double noise = claim_.set().noise;
    const trackers::PolarInput<double> input{noise * std::cos(x[8]), noise * std::sin(x[8]),
                                             claim_.set().slew * std::sin(x[9]), claim_.frequency()};
    const PolarState next = trackers::polar_frame_map(state, input, claim_.design());
    return claim_.level(as_vector(next.error)) / radius;
  }

  const SetClaim& claim_;
  trackers::RandomStream random_;
  Eigen::VectorXd best_ = Eigen::VectorXd::Constant(kAngles, 1.0);
};

}  // namespace

double sampled_radius_limit(const CertifiedSet& set, const trackers::ToneModel<double>& design) {
  const rigor::NearestRounding nearest;
  return sampled_radius_limit(SetClaim(set, design));
}

double sampled_radius_limit(const SetClaim& claim) {
  constexpr double kGrowth = 1.2;
  constexpr int kBisections = 8;
  const rigor::NearestRounding nearest;
  Escape escape(claim);
  const double amplitude_zero = (1.0 + claim.center()[0]) / claim.inverse_metric().row(0).norm();
  double inside = claim.set().radius;
  double outside = inside;
  do {
    inside = outside;
    outside = std::min(kGrowth * outside, amplitude_zero);
  } while (outside < amplitude_zero && !(escape.largest_ratio(outside) > 1.0));
  for (int i = 0; i < kBisections && outside < amplitude_zero; ++i) {
    const double middle = 0.5 * (inside + outside);
    (escape.largest_ratio(middle) > 1.0 ? outside : inside) = middle;
  }
  return outside;
}

}  // namespace veritrack::quadrature

#include "analysis/quadrature/gaussian/leaking_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/quadrature/gaussian/linear_filter.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

TEST_CASE("without a leak it is the linear filter, without a bias") {
  for (const trackers::ToneModel<double>& design : test_sets::kDesigns) {
    const auto filter = leaking_filter(design, 1.0);
    const auto linear = linear_filter(design, level_covariance(*steady_covariance(design)));
    REQUIRE(filter);
    CHECK(filter->steady.errors[2] == 0.0);
    CHECK(mean_square_frequency_error(*filter, 0.1).value() ==
          doctest::Approx(frequency_variance(*linear, 0.1, 0.0)).epsilon(1e-4));
    CHECK((filter->later.bottomRightCorner<2, 2>() - linear->later).norm() < 1e-4 * linear->later.norm());
  }
}

TEST_CASE("with a leak its mean square is that of a run in little noise") {
  const trackers::ToneModel<double> design{0.0065, 0.0065, 0.01, 0.05};
  constexpr double kDeviation = 0.02;
  constexpr double kFrequency = 1.5;
  const auto filter = leaking_filter(design, kFrequency);
  REQUIRE(filter);
  const double bias = filter->steady.errors[2];
  const double square = mean_square_frequency_error(*filter, kDeviation).value();
  CHECK(square > bias * bias);
  trackers::RandomStream random(4450);
  const LevelCovariance<double>& p = filter->steady.covariance;
  trackers::RotatingFrameState<double> x;
  x << filter->steady.errors[0], filter->steady.errors[1], bias, p.p11, p.p12, p.p13, p.p22, p.p23, p.p33;
  double sum = 0.0;
  double squares = 0.0;
  const std::int64_t samples = test::effort(40000);
  for (std::int64_t k = 0; k < samples; ++k) {
    x = trackers::rotating_frame_map(
        x, {kDeviation * random.normal(), kDeviation * random.normal(), 0.0, kFrequency}, design);
    sum += x[2] / static_cast<double>(samples);
    squares += x[2] * x[2] / static_cast<double>(samples);
  }
  CHECK(squares - sum * sum == doctest::Approx(square - bias * bias).epsilon(0.1));
  CHECK(squares == doctest::Approx(square).epsilon(0.02));
}

TEST_CASE("the sum of later changes of the frequency error is that of a run without noise") {
  const trackers::ToneModel<double> design{0.0013, 0.0013, 0.01, 0.01};
  const auto filter = leaking_filter(design, 1.0);
  REQUIRE(filter);
  const Eigen::Matrix3d a = filter->step.topLeftCorner<3, 3>();
  Eigen::Vector3d e(0.3, -1.0, 0.5);
  const double expected = filter->later_sum.dot(e);
  const double expected_squares = e.dot(filter->later * e);
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < 2000; ++k) {
    sum += e[2];
    squares += e[2] * e[2];
    e = (a * e).eval();
  }
  CHECK(sum == doctest::Approx(expected).epsilon(1e-6));
  CHECK(squares == doctest::Approx(expected_squares).epsilon(1e-6));
}

TEST_CASE("no steady state, no filter") {
  CHECK_FALSE(leaking_filter({0.0, 0.0, 0.01, 0.01}, 1.0));
}

}  // namespace veritrack::quadrature

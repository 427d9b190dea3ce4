#include "analysis/linear/loop_response.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace veritrack::linear {
namespace {

/// x+ = p x + (1 - p) u, and the error x - u after a step of u by 1.
LinearLoop low_pass(double pole) {
  LinearLoop loop;
  loop.a = Eigen::MatrixXd::Constant(1, 1, pole);
  loop.noise = Eigen::MatrixXd::Constant(1, 1, 1.0 - pole);
  loop.step = Eigen::VectorXd::Constant(1, -1.0);
  loop.estimate = Eigen::RowVectorXd::Constant(1, 1.0);
  return loop;
}

TEST_CASE("a low pass: closed forms") {
  const double pole = 0.9;
  const LinearLoop loop = low_pass(pole);
  const auto modes = modes_of(loop);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].time_constant == doctest::Approx(-1.0 / std::log(pole)));
  CHECK(modes[0].damping == doctest::Approx(1.0));
  CHECK(noise_deviation(loop, 1000) == doctest::Approx((1.0 - pole) / std::sqrt(1.0 - pole * pole)));
  const auto share = followed_share(loop, 50);
  CHECK(share[0] == 0.0);
  CHECK(share[10] == doctest::Approx(1.0 - std::pow(pole, 10)));
  CHECK(noise_gain(loop, 0.0) == doctest::Approx(1.0));
  CHECK(noise_gain(loop, std::numbers::pi) == doctest::Approx((1.0 - pole) / (1.0 + pole)));
}

TEST_CASE("a pair of modes: damping and frequency of the continuous one") {
  const double zeta = 0.3;
  const double omega = 0.05;
  const double decay = std::exp(-zeta * omega);
  const double turn = omega * std::sqrt(1.0 - zeta * zeta);
  LinearLoop loop;
  loop.a.resize(2, 2);
  loop.a << decay * std::cos(turn), -decay * std::sin(turn), decay * std::sin(turn), decay * std::cos(turn);
  const auto modes = modes_of(loop);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].damping == doctest::Approx(zeta));
  CHECK(modes[0].frequency == doctest::Approx(omega));
  CHECK(modes[0].time_constant == doctest::Approx(1.0 / (zeta * omega)));
}

TEST_CASE("the mode of a multiplier: at once, growing, and at rest") {
  const LoopMode quick = mode_of(0.0);
  CHECK(quick.time_constant == 0.0);
  CHECK(quick.damping == 1.0);
  const LoopMode pair = mode_of(std::polar(0.9, 0.3));
  CHECK(pair.multiplier == std::polar(0.9, 0.3));
  CHECK(pair.time_constant == doctest::Approx(-1.0 / std::log(0.9)));
  CHECK(pair.damping == doctest::Approx(-std::log(0.9) / std::hypot(std::log(0.9), 0.3)));
  CHECK(mode_of(std::polar(0.9, -0.3)).damping == doctest::Approx(pair.damping));
  CHECK(mode_of(std::polar(1.1, 0.3)).damping < 0.0);
  CHECK(mode_of(std::polar(1.1, 0.3)).time_constant < 0.0);
  CHECK(mode_of(1.0).damping == 0.0);
  CHECK(std::isinf(mode_of(1.0).time_constant));
}

}  // namespace
}  // namespace veritrack::linear

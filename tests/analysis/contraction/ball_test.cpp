#include "analysis/contraction/ball.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "analysis/contraction/fixed_point_branch.hpp"
#include "tests/support/random.hpp"

using namespace veritrack::contraction;
using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// x+ = x^2 / 2 + p + v / 4 - w: around x* = 1 - sqrt(1 - 2p) exactly e+ = (x* + e/2) e + v/4 - w, which
/// contracts on |e| <= R exactly when x* + R/2 < 1, and dx*/dp = 1 / (1 - x*).
struct Fold {
  static constexpr int kStates = 1;
  static constexpr int kNoises = 1;
  template <typename Scalar>
  Column<Scalar, 1> operator()(const Column<Scalar, 1>& x, const Scalar& p,
                               const Column<Scalar, 2>& d) const {
    return Column<Scalar, 1>(Scalar(0.5) * x[0] * x[0] + p + Scalar(0.25) * d[0] - d[1]);
  }
};

/// X+ = A X + B v.
struct Linear {
  static constexpr int kStates = 3;
  static constexpr int kNoises = 2;
  Eigen::Matrix3d a;
  Eigen::Matrix<double, 3, 2> b;
  template <typename Scalar>
  Column<Scalar, 3> operator()(const Column<Scalar, 3>& x, const Scalar&, const Column<Scalar, 3>& d) const {
    Column<Scalar, 3> next;
    for (Eigen::Index i = 0; i < 3; ++i) {
      next[i] = Scalar(b(i, 0)) * d[0] + Scalar(b(i, 1)) * d[1];
      for (Eigen::Index j = 0; j < 3; ++j) {
        next[i] = next[i] + Scalar(a(i, j)) * x[j];
      }
    }
    return next;
  }
};

/// (x, y, z)+ = (x^2 y / 4 + v (1 + x) / 8, sin(y) / 2 + x^3 / 8, z / 4), with the fixed point 0.
struct Curved {
  static constexpr int kStates = 3;
  static constexpr int kNoises = 1;
  template <typename Scalar>
  Column<Scalar, 3> operator()(const Column<Scalar, 3>& x, const Scalar&, const Column<Scalar, 2>& d) const {
    using std::sin;
    Column<Scalar, 3> next;
    next[0] = Scalar(0.25) * x[0] * x[0] * x[1] + Scalar(0.125) * d[0] * (Scalar(1.0) + x[0]);
    next[1] = Scalar(0.5) * sin(x[1]) + Scalar(0.125) * x[0] * x[0] * x[0];
    next[2] = Scalar(0.25) * x[2];
    return next;
  }
};

template <typename Loop>
FixedPointTube<Loop::kStates> tube_at(const Loop& loop, const Vector<Loop::kStates>& near,
                                      const Interval& parameter) {
  const auto tube = verify_fixed_point(loop, near, parameter);
  REQUIRE(tube.has_value());
  return *tube;
}

BallProposal<1> interval_of(double radius, double noise = 0.0, double slew = 0.0) {
  return {Matrix<1>::Identity(), radius, noise, slew};
}

}  // namespace

TEST_CASE(
    "one dimension: the constants are those computed by hand, and the ball ends where contraction does") {
  const Fold loop;
  const UpwardRounding upward;
  for (const double p : {-1.0, 0.0, 0.25, 0.375}) {
    const double fixed = 2.0 * p / (1.0 + std::sqrt(1.0 - 2.0 * p));
    const std::vector branch{tube_at(loop, Vector<1>(fixed), Interval(p))};
    const double edge = 2.0 * (1.0 - std::fabs(fixed));
    if (edge > 0.0) {
      for (const double fraction : {0.1, 0.5, 0.999}) {
        const auto certificate = verify_ball(loop, branch, interval_of(fraction * edge));
        CHECK(certificate.verdict == Verdict::proved);
        const double rate = std::fabs(fixed) + 0.5 * fraction * edge;
        CHECK(certificate.rate >= rate - 1e-14);
        CHECK(certificate.rate <= rate + 1e-9);
        CHECK(certificate.noise_gain >= 0.25);
        CHECK(certificate.noise_gain <= 0.25 + 1e-9);
      }
    }
    CHECK(verify_ball(loop, branch, interval_of(edge)).verdict == Verdict::undecided);
    CHECK(verify_ball(loop, branch, interval_of(1.01 * edge)).verdict == Verdict::undecided);
  }
}

TEST_CASE("one dimension: noise and slew up to the limit and not beyond it") {
  const Fold loop;
  const UpwardRounding upward;
  // The branch over p in [0, 0.3]; the worst fixed point is the one at 0.3.
  const auto branch = follow_branch(loop, IntervalVector<1>(Interval(0.0)), 0.0, 0.3, {0.01, 1e-5});
  REQUIRE(branch.complete);
  const double fixed = 1.0 - std::sqrt(0.4);
  const double radius = 0.3;
  const double room = radius * (1.0 - fixed - 0.5 * radius);
  const double slew_gain = 1.0 + 1.0 / (1.0 - fixed);
  const double slew = 0.3 * room / slew_gain;
  const double noise = 0.7 * room / 0.25;
  const auto held = verify_ball(loop, branch.cells, interval_of(radius, 0.93 * noise, 0.93 * slew));
  CHECK(held.verdict == Verdict::proved);
  CHECK(held.slew_gain >= slew_gain - 1e-12);
  CHECK(held.slew_gain <= 1.05 * slew_gain);
  CHECK(held.ultimate_level <= radius);
  CHECK(held.ultimate_level >=
        (0.25 * held.proposal.noise + slew_gain * held.proposal.slew) / (1.0 - held.rate) - 0.05 * radius);
  CHECK(state_bounds(held, Interval(radius))[0].upper() >= radius);
  CHECK(state_bounds(held, Interval(radius))[0].upper() <= radius + 1e-12);
  CHECK(verify_ball(loop, branch.cells, interval_of(radius, 1.01 * noise, 1.01 * slew)).verdict ==
        Verdict::undecided);
  CHECK(verify_ball(loop, branch.cells, interval_of(radius, 0.0, 1.01 * room / slew_gain)).verdict ==
        Verdict::undecided);
  CHECK(verify_ball(loop, branch.cells, interval_of(radius, 1.01 * room / 0.25, 0.0)).verdict ==
        Verdict::undecided);
  // Nothing can be said through a certificate that was not proved.
  const auto failed = verify_ball(loop, branch.cells, interval_of(2.0));
  CHECK(is_empty(state_bounds(failed, Interval(1.0))[0]));
  CHECK_FALSE(failed.reason.empty());
}

TEST_CASE("linear loops: rate and gain are the norms in the metric") {
  Random random(910);
  for (std::int64_t round = 0; round < effort(100); ++round) {
    Linear loop;
    Eigen::Matrix3d metric;
    for (Eigen::Index i = 0; i < 9; ++i) {
      loop.a(i) = random.uniform(-0.4, 0.4);
      metric(i) = random.uniform(-1.0, 1.0);
    }
    for (Eigen::Index i = 0; i < 6; ++i) {
      loop.b(i) = random.uniform(-1.0, 1.0);
    }
    metric.diagonal().array() += 2.0;
    const auto norm = [](const Eigen::MatrixXd& m) {
      return Eigen::JacobiSVD<Eigen::MatrixXd>(m).singularValues()[0];
    };
    const double rate = norm(metric * loop.a * metric.inverse());
    const double gain = norm(metric * loop.b);
    const double radius = std::pow(10.0, random.uniform(-3.0, 3.0));
    const UpwardRounding upward;
    const std::vector branch{tube_at(loop, Vector<3>(Vector<3>::Zero()), Interval(0.0))};
    const auto certificate = verify_ball(loop, branch, {metric, radius, 0.0, 0.0});
    CHECK((certificate.verdict == Verdict::proved) == (rate < 1.0));
    if (certificate.verdict != Verdict::proved) {
      continue;
    }
    CHECK(certificate.rate >= rate * (1.0 - 1e-12));
    CHECK(certificate.rate <= rate * (1.0 + 1e-9));
    CHECK(certificate.noise_gain >= gain * (1.0 - 1e-12));
    CHECK(certificate.noise_gain <= gain * (1.0 + 1e-9));
    const double largest = radius * (1.0 - rate) / gain;
    CHECK(verify_ball(loop, branch, {metric, radius, largest * (1.0 - 1e-6), 0.0}).verdict ==
          Verdict::proved);
    CHECK(verify_ball(loop, branch, {metric, radius, largest * (1.0 + 1e-6), 0.0}).verdict ==
          Verdict::undecided);
    CHECK(std::fabs(propose_largest_noise(certificate, 0.0) - largest) <= 1e-6 * largest);
  }
}

TEST_CASE("second and third derivatives over a box hold those at its points, computed by hand") {
  Random random(911);
  for (std::int64_t round = 0; round < effort(100); ++round) {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-3.0, 3.0);
    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(20)));
    const double sine = std::sin(y);
    const double cosine = std::cos(y);
    const UpwardRounding upward;
    const IntervalVector<3> box(Interval(x) + symmetric(reach), Interval(y) + symmetric(reach),
                                symmetric(reach));
    const auto second = second_derivatives(Curved{}, box, Interval(0.0));
    const auto third = third_derivatives(Curved{}, box, Interval(0.0));
    const auto holds = [](const Interval& enclosure, double truth) {
      return enclosure.lower() <= truth + 1e-13 && enclosure.upper() >= truth - 1e-13 && is_finite(enclosure);
    };
    CHECK(holds(second[0](0, 0), 0.5 * y));
    CHECK(holds(second[0](0, 1), 0.5 * x));
    CHECK(holds(second[0](1, 1), 0.0));
    CHECK(holds(second[1](0, 0), 0.75 * x));
    CHECK(holds(second[1](1, 1), -0.5 * sine));
    for (std::size_t k = 0; k < 2; ++k) {
      for (Eigen::Index i = 0; i < 2; ++i) {
        for (Eigen::Index j = 0; j < 2; ++j) {
          const Eigen::Index ones = i + j + static_cast<Eigen::Index>(k);
          CHECK(holds(third[0][k](i, j), ones == 1 ? 0.5 : 0.0));
          CHECK(holds(third[1][k](i, j), ones == 0 ? 0.75 : ones == 3 ? -0.5 * cosine : 0.0));
        }
      }
    }
    // The unfoldings give the values of the bilinear and trilinear maps.
    IntervalMatrix<3> metric = IntervalMatrix<3>::Identity();
    metric(0, 0) = Interval(2.0);
    metric(0, 1) = Interval(1.0);
    metric(1, 1) = Interval(4.0);
    const auto inverse_metric = veritrack::rigor::inverse(metric);
    REQUIRE(inverse_metric.has_value());
    const IntervalMatrix<3> inverse = *inverse_metric;
    const IntervalVector<3> u(Interval(random.uniform(-1.0, 1.0)), Interval(random.uniform(-1.0, 1.0)),
                              Interval(random.uniform(-1.0, 1.0)));
    const IntervalVector<3> e = inverse * u;
    IntervalVector<9> pairs;
    DynamicIntervalMatrix triples(27, 1);
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        pairs[3 * j + i] = u[i] * u[j];
        for (Eigen::Index k = 0; k < 3; ++k) {
          triples(9 * k + 3 * j + i, 0) = u[i] * u[j] * u[k];
        }
      }
    }
    const IntervalVector<3> twice = unfolded<3>(second, metric, inverse) * pairs;
    const DynamicIntervalMatrix thrice = unfolded<3>(third, metric, inverse) * triples;
    const double e0 = midpoint(e[0]);
    const double e1 = midpoint(e[1]);
    const double b0 = 0.5 * y * e0 * e0 + x * e0 * e1;
    const double b1 = 0.75 * x * e0 * e0 - 0.5 * sine * e1 * e1;
    const double c0 = 1.5 * e0 * e0 * e1;
    const double c1 = 0.75 * e0 * e0 * e0 - 0.5 * cosine * e1 * e1 * e1;
    CHECK(holds(twice[0], 2.0 * b0 + b1));
    CHECK(holds(twice[1], 4.0 * b1));
    CHECK(holds(thrice(0, 0), 2.0 * c0 + c1));
    CHECK(holds(thrice(1, 0), 4.0 * c1));
  }
}

TEST_CASE("how the derivatives drift along a branch: against the fold's, computed by hand") {
  // DG = x and D2G = 1 everywhere: along a curve with dx/dp = s they change by s and 0.
  const UpwardRounding upward;
  const auto drift = derivative_drift(Fold{}, IntervalVector<1>(Interval::from_bounds(0.1, 0.4)),
                                      Interval::from_bounds(0.0, 0.3), IntervalVector<1>(Interval(1.5)));
  CHECK(identical(drift.first(0, 0), Interval(1.5)));
  CHECK(identical(drift.second[0](0, 0), Interval(0.0)));
  // D2G of the curved loop in direction (1, 0, 0) is its third derivative there.
  const IntervalVector<3> at(Interval(0.25), Interval(0.5), Interval(0.0));
  const auto third = third_derivatives(Curved{}, at, Interval(0.0));
  const auto second = second_derivatives(Curved{}, at, Interval(0.0));
  const auto curved = derivative_drift(Curved{}, at, Interval(0.0),
                                       IntervalVector<3>(Interval(1.0), Interval(0.0), Interval(0.0)));
  for (std::size_t output = 0; output < 3; ++output) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(output);
      CHECK(std::fabs(midpoint(curved.first(row, i)) - midpoint(second[output](0, i))) <= 1e-14);
      for (Eigen::Index j = 0; j < 3; ++j) {
        CHECK(std::fabs(midpoint(curved.second[output](i, j)) - midpoint(third[output][0](i, j))) <= 1e-14);
      }
    }
  }
}

TEST_CASE("a curved loop: sampled steps never exceed what is proved") {
  const Curved loop;
  Random random(912);
  const UpwardRounding upward;
  const std::vector branch{tube_at(loop, Vector<3>(Vector<3>::Zero()), Interval(0.0))};
  std::int64_t proved = 0;
  for (std::int64_t round = 0; round < effort(200); ++round) {
    Matrix<3> metric;
    metric << random.uniform(0.3, 3.0), random.uniform(-1.0, 1.0), 0.0, 0.0, random.uniform(0.3, 3.0), 0.0,
        0.0, random.uniform(-0.2, 0.2), 1.0;
    const BallProposal<3> proposal{metric, random.uniform(0.05, 3.0), random.uniform(0.0, 0.5), 0.0};
    const auto certificate = verify_ball(loop, branch, proposal);
    if (certificate.verdict != Verdict::proved) {
      continue;
    }
    ++proved;
    const NearestRounding nearest;
    const Matrix<3> inverse = metric.inverse();
    for (int sample = 0; sample < 50; ++sample) {
      const double angle = random.uniform(0.0, 6.3);
      const double tilt = sample % 5 == 0 ? 0.0 : random.uniform(-1.6, 1.6);
      const double level = proposal.radius * (sample % 2 == 0 ? 1.0 : random.uniform());
      const Column<double, 3> e =
          inverse * Eigen::Vector3d(level * std::cos(angle) * std::cos(tilt),
                                    level * std::sin(angle) * std::cos(tilt), level * std::sin(tilt));
      const double noise = sample % 3 == 0 ? proposal.noise : random.uniform(-1.0, 1.0) * proposal.noise;
      const Column<double, 3> quiet = loop(e, 0.0, Column<double, 2>(0.0, 0.0));
      const Column<double, 3> driven = loop(e, 0.0, Column<double, 2>(noise, 0.0));
      CHECK((metric * quiet).norm() <= certificate.rate * level * (1 + 1e-12));
      CHECK((metric * (driven - quiet)).norm() <= certificate.noise_gain * std::fabs(noise) * (1 + 1e-12));
      CHECK((metric * driven).norm() <= proposal.radius * (1 + 1e-12));
    }
  }
  CHECK(proved > 20);
}

TEST_CASE("bad proposals are never proved") {
  const Fold loop;
  const UpwardRounding upward;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector branch{tube_at(loop, Vector<1>(0.0), Interval(0.0))};
  REQUIRE(verify_ball(loop, branch, interval_of(0.1, 0.01, 0.01)).verdict == Verdict::proved);
  for (const double bad : {nan, infinity, -infinity, -0.1}) {
    CHECK(verify_ball(loop, branch, interval_of(bad)).verdict == Verdict::undecided);
    CHECK(verify_ball(loop, branch, interval_of(0.1, bad, 0.0)).verdict == Verdict::undecided);
    CHECK(verify_ball(loop, branch, interval_of(0.1, 0.0, bad)).verdict == Verdict::undecided);
  }
  CHECK(verify_ball(loop, branch, interval_of(0.0)).verdict == Verdict::undecided);
  CHECK(verify_ball(loop, branch, interval_of(1e308)).verdict == Verdict::undecided);
  for (const double bad : {nan, infinity, 0.0}) {
    CHECK(verify_ball(loop, branch, {Matrix<1>(bad), 0.1, 0.0, 0.0}).verdict == Verdict::undecided);
  }
  CHECK(verify_ball(loop, {}, interval_of(0.1)).verdict == Verdict::undecided);
  Linear linear{Eigen::Matrix3d::Identity() * 0.5, Eigen::Matrix<double, 3, 2>::Zero()};
  const std::vector origin{tube_at(linear, Vector<3>(Vector<3>::Zero()), Interval(0.0))};
  Eigen::Matrix3d singular;
  singular << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  CHECK(verify_ball(linear, origin, {singular, 0.1, 0.0, 0.0}).verdict == Verdict::undecided);
  // On the unit circle: no contraction.
  linear.a(0, 0) = 1.0;
  linear.a(0, 1) = 0.25;
  linear.a(1, 1) = 0.5;
  FixedPointTube<3> fake = origin.front();
  CHECK(verify_ball(linear, {fake}, {Eigen::Matrix3d::Identity(), 0.1, 0.0, 0.0}).verdict ==
        Verdict::undecided);
}

#include "trackers/zarchan/zarchan_ekf.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Real = long double;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;

constexpr ZarchanDesign<double> kDesign{0.1, 0.25, 0.3, 0.2};

ZarchanEstimate<double, 3> random_start(Random& random) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) {
    a(i) = random.uniform(-1.0, 1.0);
  }
  const Eigen::Matrix3d p = a * a.transpose();
  return {Eigen::Vector3d(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)),
          0.5 * (p + p.transpose())};
}

/// The listing's update with the gain and (I - K H) M.
void listing_update(Vector3& x, Matrix3& P, const Matrix3& PHI, const Matrix3& Q, const Vector3& H,
                    Real residual) {
  const Matrix3 M = PHI * P * PHI.transpose() + Q;
  const Vector3 K = M * H / (H.dot(M * H) + Real(kDesign.measurement_variance));
  P = (Matrix3::Identity() - K * H.transpose()) * M;
  x += K * residual;
}

template <typename Filter>
void check_against(const Filter& filter, const Vector3& x, const Matrix3& P) {
  CHECK((filter.filtered().state - x.cast<double>()).norm() <= 1e-12 * (1.0 + x.cast<double>().norm()));
  CHECK((filter.filtered().covariance - P.cast<double>()).norm() <= 1e-12 * (1.0 + P.cast<double>().norm()));
  CHECK(filter.filtered().covariance == filter.filtered().covariance.transpose());
}

TEST_CASE("the three filters of three states do what the slides' listings do") {
  Random random(441);
  const Real TS = kDesign.interval;
  const Real PHIS = kDesign.frequency_noise;
  for (int k = 0; k < 500; ++k) {
    const auto start = random_start(random);
    const double y = random.uniform(-2.0, 2.0);
    const Vector3 x0 = start.state.cast<Real>();
    Matrix3 PHI = Matrix3::Identity();
    Matrix3 Q = Matrix3::Zero();
    PHI(0, 1) = TS;

    {
      Vector3 x(x0(0) + TS * x0(1), x0(1), x0(2));
      Matrix3 P = start.covariance.cast<Real>();
      Q(0, 0) = TS * TS * TS * PHIS / 3;
      Q(0, 1) = Q(1, 0) = TS * TS * PHIS / 2;
      Q(1, 1) = PHIS * TS;
      Q(2, 2) = Real(kDesign.amplitude_noise) * TS;
      const Vector3 H(x(2) * std::cos(x(0)), 0, std::sin(x(0)));
      listing_update(x, P, PHI, Q, H, Real(y) - x(2) * std::sin(x(0)));
      SinePhaseEkf<double> filter(kDesign, start);
      filter.step(y);
      check_against(filter, x, P);
    }
    for (const bool squared : {false, true}) {
      const Real z = squared ? x0(2) : x0(2) * x0(2);
      const Real slope = squared ? Real(1) : 2 * x0(2);
      Vector3 x = x0;
      Matrix3 P = start.covariance.cast<Real>();
      for (int i = 0; i < 100; ++i) {
        x(1) += Real(kDesign.interval) / 100 * (-z * x(0));
        x(0) += Real(kDesign.interval) / 100 * x(1);
      }
      PHI(1, 0) = -z * TS;
      PHI(1, 2) = -slope * x0(0) * TS;
      Q.setZero();
      Q(1, 1) = slope * slope * x0(0) * x0(0) * TS * TS * TS * PHIS / 3;
      Q(1, 2) = Q(2, 1) = -slope * x0(0) * TS * TS * PHIS / 2;
      Q(2, 2) = PHIS * TS;
      listing_update(x, P, PHI, Q, Vector3::UnitX(), Real(y) - x(0));
      if (squared) {
        SquaredFrequencyEkf<double> filter(kDesign, start);
        filter.step(y);
        check_against(filter, x, P);
      } else {
        OscillatorEkf<double> filter(kDesign, start);
        filter.step(y);
        check_against(filter, x, P);
      }
    }
  }
}

TEST_CASE("the filter of known amplitude is that of three states certain of the amplitude") {
  Random random(442);
  ZarchanDesign<double> design = kDesign;
  design.amplitude_noise = 0.0;
  for (int k = 0; k < 200; ++k) {
    auto start = random_start(random);
    start.covariance.row(2).setZero();
    start.covariance.col(2).setZero();
    SinePhaseEkf<double> larger(design, start);
    SineKnownAmplitudeEkf<double> smaller(design, start.state(2),
                                          {start.state.head<2>(), start.covariance.topLeftCorner<2, 2>()});
    for (int i = 0; i < 20; ++i) {
      const double y = random.uniform(-1.0, 1.0);
      larger.step(y);
      smaller.step(y);
    }
    CHECK((larger.filtered().state.head<2>() - smaller.filtered().state).norm() <= 1e-9);
    CHECK(larger.filtered().state(2) == start.state(2));
  }
}

TEST_CASE("symmetries, to the last bit") {
  Random random(443);
  for (int k = 0; k < 200; ++k) {
    const auto start = random_start(random);
    const auto mirrored = [&](double a, double b, double c) {
      const Eigen::DiagonalMatrix<double, 3> s(a, b, c);
      return ZarchanEstimate<double, 3>{s * start.state, s * start.covariance * s};
    };
    OscillatorEkf<double> plus(kDesign, start);
    OscillatorEkf<double> minus(kDesign, mirrored(1.0, 1.0, -1.0));
    OscillatorEkf<double> negated(kDesign, mirrored(-1.0, -1.0, 1.0));
    SquaredFrequencyEkf<double> square(kDesign, start);
    SquaredFrequencyEkf<double> square_negated(kDesign, mirrored(-1.0, -1.0, 1.0));
    SinePhaseEkf<double> phase(kDesign, start);
    SinePhaseEkf<double> phase_mirrored(kDesign, mirrored(-1.0, -1.0, -1.0));
    SinePhaseEkf<double> phase_negated(kDesign, mirrored(1.0, 1.0, -1.0));
    for (int i = 0; i < 10; ++i) {
      const double y = random.uniform(-1.0, 1.0);
      plus.step(y);
      minus.step(y);
      negated.step(-y);
      square.step(y);
      square_negated.step(-y);
      phase.step(y);
      phase_mirrored.step(y);
      phase_negated.step(-y);
    }
    const auto& x = plus.filtered().state;
    if (!x.allFinite() || !square.filtered().state.allFinite()) {
      continue;
    }
    CHECK(minus.filtered().state == Eigen::Vector3d(x(0), x(1), -x(2)));
    CHECK(negated.filtered().state == Eigen::Vector3d(-x(0), -x(1), x(2)));
    const auto& s = square.filtered().state;
    CHECK(square_negated.filtered().state == Eigen::Vector3d(-s(0), -s(1), s(2)));
    CHECK(phase_mirrored.filtered().state == -phase.filtered().state);
    const auto& p = phase.filtered().state;
    CHECK(phase_negated.filtered().state == Eigen::Vector3d(p(0), p(1), -p(2)));
  }
}

TEST_CASE("(phi + pi, omega, -A) is the same sine, and omega = 0 stays") {
  Random random(444);
  auto start = random_start(random);
  const Eigen::DiagonalMatrix<double, 3> s(1.0, 1.0, -1.0);
  ZarchanEstimate<double, 3> shifted{s * start.state, s * start.covariance * s};
  shifted.state(0) += std::numbers::pi;
  SinePhaseEkf<double> one(kDesign, start);
  SinePhaseEkf<double> other(kDesign, shifted);
  ZarchanDesign<double> quiet = kDesign;
  quiet.frequency_noise = 0.0;
  OscillatorEkf<double> still(
      quiet, {Eigen::Vector3d::Zero(), Eigen::Vector3d(1.0, 4.0, 4.0).asDiagonal().toDenseMatrix()});
  for (int i = 0; i < 100; ++i) {
    const double y = random.uniform(-1.0, 1.0);
    if (i < 10) {
      one.step(y);
      other.step(y);
    }
    still.step(y);
    CHECK(still.filtered().state(2) == 0.0);
  }
  CHECK(std::fabs(other.filtered().state(0) - one.filtered().state(0) - std::numbers::pi) <= 1e-9);
  CHECK(std::fabs(other.filtered().state(1) - one.filtered().state(1)) <= 1e-9);
  CHECK(std::fabs(other.filtered().state(2) + one.filtered().state(2)) <= 1e-9);
}

TEST_CASE("the filter of z finds the frequency of a sine with little noise, whatever its sign") {
  for (const double omega : {1.0, -1.0}) {
    Random random(445);
    SquaredFrequencyEkf<double> filter(
        {0.1, 0.01, 0.0, 0.0},
        {Eigen::Vector3d(0.0, 0.0, 4.0), Eigen::Vector3d(0.01, 4.0, 16.0).asDiagonal()});
    for (int k = 1; k <= 200; ++k) {
      filter.step(std::sin(omega * 0.1 * k) + random.uniform(-0.1, 0.1));
    }
    CHECK(filter.filtered().state(2) == doctest::Approx(1.0).epsilon(0.1));
  }
}

}  // namespace
}  // namespace veritrack::trackers

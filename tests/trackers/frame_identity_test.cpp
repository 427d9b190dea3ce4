// What is certified are maps in the frame of the signal or of the estimate; what runs is `step`. Both are
// templates, and they are the same function in other coordinates. Here that is an identity of values and of
// all first derivatives, on dual numbers over intervals: at random points each side encloses the exact value,
// tightly, and the enclosures meet. Two rational functions of the state, of sines and cosines and of square
// roots that differ would be told apart at any one of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::trackers {
namespace {

using rigor::Interval;
using DualNumber = rigor::Dual<Interval, 9>;
using Matrix3 = Eigen::Matrix<DualNumber, 3, 3>;
using Vector9 = Eigen::Matrix<DualNumber, 9, 1>;
using test::Random;

DualNumber constant(double x) {
  return DualNumber(Interval(x));
}

ToneModel<DualNumber> over_duals(const ToneModel<double>& design) {
  return {constant(design.q1), constant(design.q2), constant(design.r), constant(design.epsilon)};
}

/// Three errors and a covariance as nine variables.
struct Point {
  Vector9 x;
  [[nodiscard]] Matrix3 covariance() const {
    Matrix3 p;
    p << x(3), x(4), x(5), x(4), x(6), x(7), x(5), x(7), x(8);
    return p;
  }
};

Point random_point(Random& random) {
  const Eigen::Matrix3d p = test::random_covariance(random);
  const std::array<double, 9> values{random.uniform(-0.3, 0.3),
                                     random.uniform(-0.3, 0.3),
                                     random.uniform(-0.5, 0.5),
                                     p(0, 0),
                                     p(0, 1),
                                     p(0, 2),
                                     p(1, 1),
                                     p(1, 2),
                                     p(2, 2)};
  Point point;
  for (int i = 0; i < 9; ++i) {
    std::array<Interval, 9> unit;
    unit.fill(Interval(0.0));
    unit.at(static_cast<std::size_t>(i)) = Interval(1.0);
    point.x(i) = DualNumber(Interval(values.at(static_cast<std::size_t>(i))), unit);
  }
  return point;
}

/// U P U', U = diag(Rot(angle), 1), multiplied out.
Matrix3 turned_by(const Matrix3& p, const DualNumber& angle) {
  const auto [sine, cosine] = sin_cos(angle);
  const DualNumber zero = constant(0.0);
  Matrix3 u;
  u << cosine, -sine, zero, sine, cosine, zero, zero, zero, constant(1.0);
  Matrix3 turned;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      DualNumber sum = zero;
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          sum = sum + u(i, k) * p(k, l) * u(j, l);
        }
      }
      turned(i, j) = sum;
    }
  }
  return turned;
}

/// e^{i angle} (a + i b).
std::pair<DualNumber, DualNumber> turned_by(const DualNumber& a, const DualNumber& b,
                                            const DualNumber& angle) {
  const auto [sine, cosine] = sin_cos(angle);
  return {a * cosine - b * sine, a * sine + b * cosine};
}

/// What drives a step: the true phase at its start, the frequency, its change, and noise in the plane.
struct Drive {
  double phase, frequency, slew, noise_1, noise_2;
};
Drive random_drive(Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.5, 1.5), random.uniform(-0.1, 0.1),
          random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
}

/// Values and derivatives of both sides meet, and are tight.
void check_equal(const Vector9& one, const Vector9& other) {
  constexpr double kTight = 1e-6;
  for (int i = 0; i < 9; ++i) {
    const auto check = [&](const Interval& a, const Interval& b) {
      CHECK_FALSE(rigor::is_empty(rigor::intersection(a, b)));
      const double size = 1.0 + magnitude(a);
      CHECK(rigor::width(a) <= kTight * size);
      CHECK(rigor::width(b) <= kTight * size);
    };
    CAPTURE(i);
    check(one(i).value(), other(i).value());
    for (int j = 0; j < 9; ++j) {
      CAPTURE(j);
      check(one(i).derivative(j), other(i).derivative(j));
    }
  }
}

Vector9 entries(const PolarFrameState<DualNumber>& state) {
  const auto& [error, p] = state;
  Vector9 x;
  x << error.amplitude, error.phase, error.frequency, p.p11, p.p12, p.p13, p.p22, p.p23, p.p33;
  return x;
}

}  // namespace

TEST_CASE("polar_frame_map is `step` of the quadrature tracker: values and derivatives, over intervals") {
  Random random(71);
  for (std::int64_t k = 0; k < test::effort(100); ++k) {
    CAPTURE(k);
    const ToneModel<double> values = test::random_design(random);
    const rigor::UpwardRounding upward;
    const Point point = random_point(random);
    const Drive drive = random_drive(random);
    const auto& x = point.x;
    const ToneModel<DualNumber> design = over_duals(values);
    const DualNumber frequency = constant(drive.frequency);
    const DualNumber phase = constant(drive.phase);
    const Vector9 mapped = entries(polar_frame_map<DualNumber>(
        {{x(0), x(1), x(2)}, {x(3), x(4), x(5), x(6), x(7), x(8)}},
        {constant(drive.noise_1), constant(drive.noise_2), constant(drive.slew), frequency}, design));

    const DualNumber estimated_phase = phase + x(1);
    const auto [in_phase, quadrature] = turned_by(DualNumber(1.0) + x(0), constant(0.0), estimated_phase);
    const QuadratureEstimate<DualNumber> start{
        in_phase, quadrature, frequency + x(2),
        FactoredCovariance<DualNumber>::from_matrix(turned_by(point.covariance(), estimated_phase))};
    // The noise is given in the frame of the predicted phase.
    const DualNumber next_phase = phase + frequency;
    const auto [s1, s2] = turned_by(DualNumber(1.0), constant(0.0), next_phase);
    const auto [v1, v2] = turned_by(constant(drive.noise_1), constant(drive.noise_2),
                                    DualNumber(estimated_phase + frequency + x(2)));
    const auto filtered = step<DualNumber>(start, s1 + v1, s2 + v2, design).filtered;
    check_equal(mapped, entries(to_polar_frame<DualNumber>(filtered, DualNumber(1.0), next_phase,
                                                           frequency + constant(drive.slew))));
  }
}

TEST_CASE("rotating_frame_map is `step` of the quadrature tracker: values and derivatives, over intervals") {
  Random random(72);
  for (std::int64_t k = 0; k < test::effort(100); ++k) {
    CAPTURE(k);
    const ToneModel<double> values = test::random_design(random);
    const rigor::UpwardRounding upward;
    const Point point = random_point(random);
    const Drive drive = random_drive(random);
    const ToneModel<DualNumber> design = over_duals(values);
    const DualNumber frequency = constant(drive.frequency);
    const DualNumber phase = constant(drive.phase);
    const Vector9 mapped = rotating_frame_map<DualNumber>(
        point.x, {constant(drive.noise_1), constant(drive.noise_2), constant(drive.slew), frequency}, design);

    const auto [in_phase, quadrature] = turned_by(DualNumber(1.0) + point.x(0), point.x(1), phase);
    const QuadratureEstimate<DualNumber> start{
        in_phase, quadrature, frequency + point.x(2),
        FactoredCovariance<DualNumber>::from_matrix(turned_by(point.covariance(), phase))};
    const DualNumber next_phase = phase + frequency;
    const auto [y1, y2] =
        turned_by(DualNumber(1.0) + constant(drive.noise_1), constant(drive.noise_2), next_phase);
    const auto filtered = step<DualNumber>(start, y1, y2, design).filtered;
    check_equal(mapped, to_rotating_frame<DualNumber>(filtered, DualNumber(1.0), next_phase,
                                                      frequency + constant(drive.slew)));
  }
}

TEST_CASE(
    "single_channel_map is a step of the single-channel tracker: values and derivatives, over intervals") {
  Random random(73);
  for (std::int64_t k = 0; k < test::effort(100); ++k) {
    CAPTURE(k);
    const ToneModel<double> values = test::random_design(random);
    const rigor::UpwardRounding upward;
    const Point point = random_point(random);
    const Drive drive = random_drive(random);
    const ToneModel<DualNumber> design = over_duals(values);
    const DualNumber frequency = constant(drive.frequency);
    const DualNumber phase = constant(drive.phase);
    const DualNumber next_phase = phase + frequency;
    const Vector9 mapped = single_channel_map<DualNumber>(
        point.x, {next_phase, constant(drive.noise_1), constant(drive.slew), frequency}, design);

    const auto [in_phase, quadrature] = turned_by(DualNumber(1.0) + point.x(0), point.x(1), phase);
    SingleChannelEkf<DualNumber> tracker(
        single_channel_design(design),
        {in_phase, quadrature, frequency + point.x(2),
         FactoredCovariance<DualNumber>::from_matrix(turned_by(point.covariance(), phase))});
    tracker.step(sin_cos(next_phase).second + constant(drive.noise_1));
    check_equal(mapped, to_rotating_frame<DualNumber>(tracker.filtered(), DualNumber(1.0), next_phase,
                                                      frequency + constant(drive.slew)));
  }
}

TEST_CASE("the identity would be missed by a map that is wrong in one place") {
  Random random(74);
  const ToneModel<double> values{0.01, 0.02, 0.5, 0.1};
  const rigor::UpwardRounding upward;
  const Point point = random_point(random);
  const ToneModel<DualNumber> design = over_duals(values);
  ToneModel<DualNumber> other = design;
  other.epsilon = constant(0.1 + 1e-9);
  const RotatingFrameInput<DualNumber> input{constant(0.01), constant(0.02), constant(0.0), constant(0.5)};
  const Vector9 one = rotating_frame_map<DualNumber>(point.x, input, design);
  const Vector9 two = rotating_frame_map<DualNumber>(point.x, input, other);
  CHECK(rigor::is_empty(rigor::intersection(one(2).value(), two(2).value())));
}

}  // namespace veritrack::trackers

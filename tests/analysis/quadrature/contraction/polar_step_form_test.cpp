#include "analysis/quadrature/contraction/polar_step_form.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "analysis/quadrature/contraction/step_inequality.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

const trackers::ToneModel<double> kDesign{0.0013, 0.002, 0.01, 0.0};
const BlockCovariance<double> kLow{0.003, 0.004, 0.001, 0.002};
const BlockCovariance<double> kHigh{0.004, 0.006, 0.002, 0.003};

StepSetting<double> random_setting(test::Random& random, const BlockCovariance<double>& high, double noise) {
  return {kDesign, {2.0, 3.0, -1.0, 4.0}, kLow, high, random.uniform(0.1, 0.5), random.uniform(0.1, 1.0),
          noise};
}

BlockCovariance<Interval> exact(const BlockCovariance<double>& p) {
  return {Interval(p.p11), Interval(p.p22), Interval(p.p23), Interval(p.p33)};
}
StepSetting<Interval> exact(const StepSetting<double>& s) {
  return {{Interval(s.design.q1), Interval(s.design.q2), Interval(s.design.r), Interval(0.0)},
          {Interval(s.metric.amplitude), Interval(s.metric.phase), Interval(s.metric.coupling),
           Interval(s.metric.frequency)},
          exact(s.covariance_lower),
          exact(s.covariance_upper),
          Interval(s.largest_amplitude),
          Interval(s.largest_chi),
          Interval(s.noise)};
}

TEST_CASE("the form is the polar map, whatever the axis") {
  test::Random random(75);
  for (int k = 0; k < 5000; ++k) {
    const StepSetting<double> setting = random_setting(random, kLow, 0.0);
    const double s = random.uniform(0.05, 1.0);
    const double beta = random.uniform(0.0, 3.14);
    const double turn = random.uniform(-1.0, 1.0);  // from the axis to beta
    const double nu = random.uniform(-1.0, 1.0);
    const auto form = polar_step_form<double, double>(
        setting, {s, beta, std::cos(beta - turn), std::sin(beta - turn), 0.0, 0.0, {0.0, 0.0}});
    const double a = s * setting.largest_amplitude * std::cos(beta);
    const double psi = s * setting.largest_chi * std::sin(beta) - nu;
    const trackers::PolarFrameState<double> state{{a, psi, nu},
                                                  {kLow.p11, 0.0, 0.0, kLow.p22, kLow.p23, kLow.p33}};
    const auto next = trackers::polar_frame_map(state, {0.0, 0.0, 0.0, 0.7}, kDesign);
    // T e and T e+, with equal bounds of the covariance nothing is left to chance.
    const Eigen::Vector3d te(2.0 * a, 3.0 * psi - nu, 4.0 * nu);
    const Eigen::Vector3d image(2.0 * next.error.amplitude, 3.0 * next.error.phase - next.error.frequency,
                                4.0 * next.error.frequency);
    const double x = s * std::cos(turn);
    const double y = s * std::sin(turn);
    Eigen::Vector3d predicted(0.0, -nu, 4.0 * nu);
    for (int i = 0; i < 3; ++i) {
      const auto row = static_cast<std::size_t>(i);
      predicted[i] += form.centre[0][row] * x + form.centre[1][row] * y;
    }
    CHECK((image - predicted).norm() <= 1e-11);
    const Gram<double>& q = form.size;
    const double size = q.g11 * x * x + q.g22 * y * y + q.g33 * nu * nu +
                        2.0 * (q.g12 * x * y + q.g13 * x * nu + q.g23 * y * nu);
    CHECK(std::fabs(te.squaredNorm() - size) <= 1e-11);
    CHECK(std::fabs(form.spread[0]) + std::fabs(form.spread[1]) <= 1e-12);
  }
}

/// T J averaged between z and z + d, by Simpson's rule.
Eigen::Matrix<double, 3, 2> averaged(const BlockMetric<double>& t, std::complex<double> z,
                                     std::complex<double> d) {
  constexpr int kParts = 40;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = 0; i <= kParts; ++i) {
    const double weight = i == 0 || i == kParts ? 1.0 : i % 2 == 0 ? 2.0 : 4.0;
    const std::complex<double> at = z + d * (static_cast<double>(i) / kParts);
    const double length = std::abs(at);
    Eigen::Matrix2d j;
    j << at.real() / length, at.imag() / length, -at.imag() / (length * length),
        at.real() / (length * length);
    sum += weight / (3.0 * kParts) * j;
  }
  Eigen::Matrix<double, 3, 2> result;
  result << t.amplitude * sum.row(0), t.phase * sum.row(1), 0.0, 0.0;
  return result;
}

TEST_CASE("over a cell the derivatives lead from the middle to every point") {
  test::Random random(76);
  for (std::int64_t k = 0; k < test::effort(1500); ++k) {
    const StepSetting<double> setting = random_setting(random, kHigh, random.uniform(0.0, 0.2));
    const double size = std::pow(10.0, random.uniform(-4.0, -1.0));
    const std::array<double, 4> middle{random.uniform(0.1, 0.9), random.uniform(0.2, 3.0),
                                       random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8)};
    std::array<double, 4> point{};
    for (std::size_t i = 0; i < 4; ++i) {
      point[i] = middle[i] + size * random.uniform(-1.0, 1.0);
    }
    const std::array<double, 2> reach{random.uniform(0.0, 0.3), random.uniform(0.0, 0.3)};
    const double axis = middle[1];
    const double c0 = std::cos(axis);
    const double s0 = std::sin(axis);
    const auto expected =
        polar_step_form<double, double>(setting, {point[0], point[1], c0, s0, point[2], point[3], reach});
    const double a = setting.largest_amplitude * point[0] * std::cos(point[1]);
    const double chi = setting.largest_chi * point[0] * std::sin(point[1]);
    const auto correction = correction_at(setting, a, chi);
    const Eigen::Matrix<double, 3, 2> j =
        averaged(setting.metric, {correction.z1, correction.z2}, {point[2] * reach[0], point[3] * reach[1]});

    const rigor::UpwardRounding upward;
    const std::array<Interval, 2> exact_reach{Interval(reach[0]), Interval(reach[1])};
    const auto side = [&](std::size_t i) {
      std::array<Interval, kCellVariables> unit;
      unit.fill(Interval(0.0));
      unit[i] = Interval(1.0);
      return Derivatives(Interval(middle[i]) + rigor::symmetric(size), unit);
    };
    const auto at = polar_step_form<Interval, Interval>(
        exact(setting), {Interval(middle[0]), Interval(middle[1]), Interval(c0), Interval(s0),
                         Interval(middle[2]), Interval(middle[3]), exact_reach});
    const auto over = polar_step_form<Interval, Derivatives>(
        exact(setting), {side(0), side(1), Interval(c0), Interval(s0), side(2), side(3), exact_reach});
    const auto holds = [&](const Interval& start, const Derivatives& slope, double value) {
      Interval reached = start;
      for (int i = 0; i < kCellVariables; ++i) {
        const auto index = static_cast<std::size_t>(i);
        reached += slope.derivative(i) * (Interval(point[index]) - Interval(middle[index]));
      }
      const double room = 1e-7 * (1.0 + std::fabs(value));
      CHECK(reached.lower() <= value + room);
      CHECK(reached.upper() >= value - room);
      return width(reached);
    };
    for (std::size_t b = 0; b < 2; ++b) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double spread = holds(at.centre[b][i], over.centre[b][i], expected.centre[b][i]);
        CHECK((size > 1e-3 || spread <= 1e-3 * (1.0 + std::fabs(expected.centre[b][i]))));
      }
      for (std::size_t i = 0; i < 2; ++i) {
        holds(at.innovation[b][i], over.innovation[b][i], expected.innovation[b][i]);
      }
      holds(at.spread[b], over.spread[b], expected.spread[b]);
      CHECK(over.reach[b].lower() <= expected.reach[b]);
      CHECK(over.reach[b].upper() >= expected.reach[b]);
    }
    const auto& gains = correction.gains;
    holds(at.gain[0][0], over.gain[0][0], j(0, 0) * gains.mean_amplitude);
    holds(at.gain[0][1], over.gain[0][1], j(1, 0) * gains.mean_amplitude);
    holds(at.gain[1][0], over.gain[1][0], j(0, 1) * gains.mean_phase);
    holds(at.gain[1][1], over.gain[1][1],
          j(1, 1) * gains.mean_phase + setting.metric.coupling * gains.mean_frequency);
    Eigen::Matrix3d t_j;
    t_j << j, Eigen::Vector3d(0.0, setting.metric.coupling, setting.metric.frequency);
    Eigen::Matrix3d delta;
    delta << gains.spread.p11, 0.0, 0.0, 0.0, gains.spread.p22, gains.spread.p23, 0.0, gains.spread.p23,
        gains.spread.p33;
    const Eigen::Matrix3d gram = t_j * delta * t_j.transpose() / (kDesign.r * kDesign.r);
    holds(at.gram.g11, over.gram.g11, gram(0, 0));
    holds(at.gram.g12, over.gram.g12, gram(0, 1));
    holds(at.gram.g13, over.gram.g13, gram(0, 2));
    holds(at.gram.g22, over.gram.g22, gram(1, 1));
    holds(at.gram.g23, over.gram.g23, gram(1, 2));
    holds(at.gram.g33, over.gram.g33, gram(2, 2));
  }
}

TEST_CASE("the proposed rate bounds every step on the axis that the form allows") {
  test::Random random(77);
  int finite = 0;
  double closest = 0.0;
  for (int k = 0; k < 400; ++k) {
    const StepSetting<double> setting = random_setting(random, kHigh, 0.05);
    const double beta = random.uniform(0.0, 3.14);
    const auto form = polar_step_form<double, double>(setting, {random.uniform(0.1, 1.0),
                                                                beta,
                                                                std::cos(beta),
                                                                std::sin(beta),
                                                                random.uniform(-1.0, 1.0),
                                                                random.uniform(-1.0, 1.0),
                                                                {0.05, 0.05}});
    const StepConstants<double> constants{0.0, random.uniform(2.0, 40.0), random.uniform(20.0, 90.0),
                                          random.below(2) == 0, random.below(2) == 0};
    const RayRate found = propose_rate(form, setting.metric, constants);
    if (!std::isfinite(found.rate_squared)) {
      continue;
    }
    ++finite;
    Eigen::Matrix3d gram;
    gram << form.gram.g11, form.gram.g12, form.gram.g13, form.gram.g12, form.gram.g22, form.gram.g23,
        form.gram.g13, form.gram.g23, form.gram.g33;
    const Eigen::Matrix3d root = oracle::cholesky_factor(gram);
    const Eigen::Vector3d t(0.0, setting.metric.coupling, setting.metric.frequency);
    for (int i = 0; i < 200; ++i) {
      const double nu = random.uniform(-2.0, 2.0);
      const double scale = std::pow(10.0, random.uniform(-3.0, 0.0));
      const Eigen::Vector2d v = constants.noisy ? Eigen::Vector2d(scale * random.uniform(-1.0, 1.0),
                                                                  scale * random.uniform(-1.0, 1.0))
                                                : Eigen::Vector2d::Zero();
      const double w = constants.slewing ? scale * random.uniform(-1.0, 1.0) : 0.0;
      const double i1 = form.innovation[0][0] + v[0];
      const double i2 = form.innovation[0][1] + v[1];
      const double eta = std::sqrt(form.spread[0] * i1 * i1 + form.spread[1] * i2 * i2);
      const Eigen::Vector3d z =
          eta *
          Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
      Eigen::Vector3d image = (nu - w) * t + root * z;
      for (int row = 0; row < 3; ++row) {
        const auto index = static_cast<std::size_t>(row);
        image[row] += form.centre[0][index] + form.gain[0][index] * v[0] + form.gain[1][index] * v[1];
      }
      const double size = form.size.g11 + 2.0 * form.size.g13 * nu + form.size.g33 * nu * nu;
      const double allowed = found.rate_squared * size + constants.noise_gain_squared * v.squaredNorm() +
                             constants.slew_gain_squared * w * w;
      CHECK(image.squaredNorm() <= allowed * (1.0 + 1e-9));
      closest = std::max(closest, image.squaredNorm() / allowed);
    }
  }
  CHECK(finite > 100);
  CHECK(closest > 0.8);
}

}  // namespace
}  // namespace veritrack::quadrature

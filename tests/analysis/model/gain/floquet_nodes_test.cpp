// Bases at some frequencies against multipliers on paper, Liouville's formula, and what a step of the loop
// does to errors, along simulated runs.
#include "analysis/model/gain/floquet_nodes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

constexpr double kNodeOmega = 0.31;
constexpr int kNodeHarmonics = 32;

/// x' = a x + y, z' = x + exp(b y - 2) z: a mode, and what decays faster, by a factor that depends on the
/// phase.
test::ExampleTracker mode_and_fast_state(double a, double b) {
  test::ExampleTracker example;
  test::Recursion& r = example.recursion;
  r.constants = 4;  // a, b, 2, 1/16
  r.states = 2;
  r.samples = 1;
  r.is_angle = {false, false};
  test::StraightLineProgram step(7);
  const auto product = [&](int one, int two) { return step.append(test::Operation::multiply, one, two); };
  const int exponent = step.append(test::Operation::subtract, product(1, 6), 2);
  const int x = step.append(test::Operation::add, product(0, 4), 6);
  step.add_result(x);
  const int faster = product(step.append(test::Operation::exp, exponent), 5);
  step.add_result(step.append(test::Operation::add, product(3, 4), faster));
  r.step = step;
  r.frequency = test::frequency_of_state(4, 2, 0);
  example.constants = {a, b, 2.0, 0.0625};
  example.start = [](double) { return std::vector<double>{0.0, 0.0}; };
  return example;
}

std::optional<std::vector<FloquetNode>> nodes_at(const test::ExampleTracker& tracker,
                                                 const std::vector<double>& frequencies, FloquetGauge gauge) {
  const TrackedTone tone = test::tone_of(tracker);
  std::vector<NodeCurve> curves;
  for (const double frequency : frequencies) {
    const SteadyState settled = find_steady_state(tone, frequency);
    REQUIRE(settled.outcome == SteadyStateOutcome::settled);
    curves.push_back(fit_curve_at(tone, frequency, settled).value());
  }
  return floquet_nodes(tone, curves, gauge, kNodeHarmonics);
}

Eigen::MatrixXd basis_of(const FloquetNode& node, double phase) {
  const Eigen::Index n = node.matrix.rows();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index h = 0; h < node.basis.cols(); ++h) {
    for (Eigen::Index i = 0; i < n * n; ++i) {
      basis(i / n, i % n) += (node.basis(i, h) * std::polar(1.0, static_cast<double>(h) * phase)).real();
    }
  }
  return basis;
}

/// P(phi + omega)^-1 A(phi) P(phi).
Eigen::MatrixXd seen_in(const FloquetNode& node, const Eigen::MatrixXd& jacobian, double phase,
                        double omega) {
  return oracle::solution(basis_of(node, phase + omega), jacobian * basis_of(node, phase));
}

/// Of the loop w' = w + ki e, theta' = theta + w + kp e, e = -y sin theta: at a phase, after a long run.
Eigen::Matrix2d settled_jacobian(const test::ExampleTracker& loop, double phase, double omega) {
  constexpr int kRun = 4000;
  const double ki = loop.constants[0];
  const double kp = loop.constants[1];
  double w = omega;
  double theta = phase - kRun * omega;
  for (int k = 1; k <= kRun; ++k) {
    const double e = -std::cos(phase - (kRun - k) * omega) * std::sin(theta);
    theta += w + kp * e;
    w += ki * e;
  }
  const double slope = -std::cos(phase + omega) * std::cos(theta);
  Eigen::Matrix2d jacobian;
  jacobian << 1.0, ki * slope, 1.0, 1.0 + kp * slope;
  return jacobian;
}

TEST_CASE("a mode has its multiplier, and what decays faster is apart and evened out as far as it may be") {
  // b = 1.95: the factor of a sample is up to exp(-0.05), and its logarithm is changed by at most 1.2.
  const double step_of_scale = 2.0 * std::sin(0.5 * kNodeOmega);
  for (const auto& [b, largest] : {std::pair(1.5, -0.5), std::pair(1.95, -0.05 - 1.2 * step_of_scale)}) {
    CAPTURE(b);
    const auto nodes = nodes_at(mode_and_fast_state(0.9, b), {kNodeOmega}, FloquetGauge::by_mode);
    REQUIRE(nodes);
    const FloquetNode& node = nodes->front();
    double most = 0.0;
    double sum = 0.0;
    constexpr int kPhases = 512;
    for (int j = 0; j < kPhases; ++j) {
      const double phase = 2.0 * std::numbers::pi * j / kPhases;
      Eigen::Matrix2d jacobian;
      jacobian << 0.9, 0.0, 0.0625, std::exp(b * std::cos(phase + kNodeOmega) - 2.0);
      const Eigen::MatrixXd seen = seen_in(node, jacobian, phase, kNodeOmega);
      CHECK(std::fabs(seen(0, 0) - 0.9) < 1e-7);
      CHECK(std::fabs(seen(0, 1)) < 1e-7);
      CHECK(std::fabs(seen(1, 0)) < 1e-6);
      most = std::max(most, seen(1, 1));
      sum += seen(1, 1);
    }
    CHECK(most == doctest::Approx(std::exp(largest)).epsilon(0.01));
    CHECK(node.matrix(0, 0) == doctest::Approx(0.9).epsilon(1e-9));
    CHECK(node.matrix(1, 1) == doctest::Approx(sum / kPhases).epsilon(1e-6));
  }
}

TEST_CASE("a loop's errors have one matrix at all phases, with the determinant of Liouville's formula") {
  const test::ExampleTracker loop = test::phase_locked_loop(0.05);
  for (const FloquetGauge gauge : {FloquetGauge::by_mode, FloquetGauge::by_state}) {
    const auto nodes = nodes_at(loop, {kNodeOmega}, gauge);
    REQUIRE(nodes);
    const FloquetNode& node = nodes->front();
    constexpr int kPhases = 64;
    double logarithms = 0.0;
    for (int j = 0; j < kPhases; ++j) {
      const double phase = 2.0 * std::numbers::pi * j / kPhases;
      const Eigen::Matrix2d jacobian = settled_jacobian(loop, phase, kNodeOmega);
      CHECK((seen_in(node, jacobian, phase, kNodeOmega) - node.matrix).cwiseAbs().maxCoeff() < 1e-8);
      logarithms += std::log(jacobian.determinant());
    }
    CHECK(node.matrix.determinant() == doctest::Approx(std::exp(logarithms / kPhases)).epsilon(1e-9));
    if (gauge == FloquetGauge::by_mode) {  // the pair of complex modes is evened out
      CHECK(std::fabs(node.matrix(0, 0) - node.matrix(1, 1)) < 1e-9);
    }
  }
}

TEST_CASE("from the middle frequency on bases change smoothly, and not in the mean") {
  constexpr double kApart = 0.01;
  const std::vector<double> frequencies{kNodeOmega - kApart, kNodeOmega, kNodeOmega + kApart};
  test::Random random(941);
  for (const auto& [tracker, gauge] : {std::pair(test::phase_locked_loop(0.05), FloquetGauge::by_mode),
                                       std::pair(test::phase_locked_loop(0.05), FloquetGauge::by_state),
                                       std::pair(mode_and_fast_state(0.9, 1.95), FloquetGauge::by_mode)}) {
    const auto nodes = nodes_at(tracker, frequencies, gauge);
    REQUIRE(nodes);
    REQUIRE(nodes->size() == 3);
    double first = 0.0;
    double second = 0.0;
    constexpr int kPhases = 101;
    const double begin = random.uniform();
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(2, 2);
    for (int j = 0; j < kPhases; ++j) {
      const double phase = begin + 2.0 * std::numbers::pi * j / kPhases;
      const Eigen::MatrixXd low = basis_of((*nodes)[0], phase);
      const Eigen::MatrixXd middle = basis_of((*nodes)[1], phase);
      const Eigen::MatrixXd high = basis_of((*nodes)[2], phase);
      first = std::max(first, (high - low).cwiseAbs().maxCoeff());
      second = std::max(second, (high - 2.0 * middle + low).cwiseAbs().maxCoeff());
      mean += oracle::solution(middle, high) / kPhases;
    }
    CHECK(first > 0.0);
    CHECK(second < 0.2 * first);
    CHECK(std::fabs(mean(0, 0) - 1.0) < 1e-7);
    CHECK(std::fabs(mean(1, 1) - 1.0) < 1e-7);
  }
}

TEST_CASE("where all parts decay at once there is no mode, and no basis") {
  CHECK_FALSE(nodes_at(mode_and_fast_state(0.01, 0.0), {kNodeOmega}, FloquetGauge::by_mode));
  CHECK_FALSE(nodes_at(mode_and_fast_state(0.01, 0.0), {kNodeOmega}, FloquetGauge::by_state));
}

}  // namespace
}  // namespace veritrack::model

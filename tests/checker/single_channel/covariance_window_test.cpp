// What the checker accepts of a window, against the covariance of the tracker that runs.
#include "checker/single_channel/covariance_window.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "trackers/single_channel/single_channel_ekf.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::WindowStatement;

constexpr double kFrequency = 1.45;  // rad/sample
constexpr double kQ = 0.005;
constexpr double kR = 0.01;

/// Extremes along the steady state of the tracker on a tone, without errors.
struct Extremes {
  double most_p33 = 0.0, most_signal = 0.0, least_p33 = 1.0, least_predicted = 1.0, most_inverse = 0.0;
};

Extremes along_a_tone() {
  trackers::SingleChannelEkf<double> tracker({trackers::identity_process_noise(kQ), kR, 0.0},
                                             {1.0, 0.0, kFrequency, trackers::identity_process_noise(kQ)});
  Extremes found;
  for (int k = 1; k <= 2000; ++k) {
    tracker.step(std::cos(kFrequency * k));
    if (k < 200) {
      continue;
    }
    const Eigen::Matrix3d p = tracker.filtered().covariance.matrix();
    const Eigen::Matrix3d predicted = tracker.predicted().covariance.matrix();
    const auto eigenvalues = [](const Eigen::Matrix3d& m) {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(m.topLeftCorner<2, 2>()).eigenvalues().eval();
    };
    found.most_p33 = std::max(found.most_p33, p(2, 2));
    found.least_p33 = std::min(found.least_p33, p(2, 2));
    found.most_signal = std::max(found.most_signal, eigenvalues(p)(1));
    found.least_predicted = std::min(found.least_predicted, eigenvalues(predicted)(0));
    found.most_inverse = std::max(found.most_inverse, p.inverse()(2, 2));
  }
  return found;
}

checker::SingleChannelDesign design_of_the_tone() {
  checker::SingleChannelDesign design;
  design.q1 = design.q2 = Ball(kQ);
  design.r = Ball(kR);
  design.lowest = design.highest = Ball(kFrequency);
  return design;
}

/// True of the tone, with room.
WindowStatement true_statement(const Extremes& seen) {
  WindowStatement statement;
  statement.radius = Ball(1e-3);
  statement.frequency_variance = Ball(1.1 * seen.most_p33);
  statement.signal_variance = Ball(1.1 * seen.most_signal);
  statement.loosening = Ball(0.01);
  statement.slew = Ball(0.0);
  statement.shares = {Ball(0.01), Ball(0.02), Ball(0.05), Ball(0.1), Ball(0.2)};
  statement.curvature = Ball(0.1);
  statement.curvature_weight = Ball(2.0);
  statement.signal_uncertainty = Ball(0.5 * kQ);
  statement.has_least = true;
  statement.least_p33 = Ball(0.8 * seen.least_p33);
  statement.has_starts = true;
  statement.start_signal = Ball(1e-6);
  statement.start_frequency = Ball(0.25 / seen.most_inverse);
  return statement;
}

bool is_proved(const WindowStatement& statement, const checker::SingleChannelDesign& design) {
  std::int64_t cells = 0;
  return window_is_proved(statement, design, cells);
}

TEST_CASE("what is true of the tracker that runs is accepted, what is not is refused") {
  const Extremes seen = along_a_tone();
  const checker::SingleChannelDesign design = design_of_the_tone();
  const WindowStatement statement = true_statement(seen);
  REQUIRE(is_proved(statement, design));
  const auto refused = [&](Ball WindowStatement::*number, double value) {
    WindowStatement changed = statement;
    changed.*number = Ball(value);
    return !is_proved(changed, design);
  };
  CHECK(refused(&WindowStatement::frequency_variance, 0.999 * seen.most_p33));
  CHECK(refused(&WindowStatement::signal_variance, 0.999 * seen.most_signal));
  CHECK(refused(&WindowStatement::signal_uncertainty, 1.001 * seen.least_predicted));
  CHECK(refused(&WindowStatement::least_p33, 1.001 * seen.least_p33));
  CHECK(refused(&WindowStatement::start_frequency, 1.001 / seen.most_inverse));
  CHECK(refused(&WindowStatement::curvature, 1e-4));
  CHECK(refused(&WindowStatement::radius, 0.1));
  CHECK(refused(&WindowStatement::radius, -1e-3));
  CHECK(refused(&WindowStatement::loosening, 1.0));
  CHECK(refused(&WindowStatement::slew, 0.1));
  CHECK(refused(&WindowStatement::least_p11, 1e3));
  CHECK(refused(&WindowStatement::least_p22, 1e3));
  // Of these the proof uses squares, or what they leave of 1.
  CHECK(refused(&WindowStatement::slew, -1e-9));
  CHECK(refused(&WindowStatement::start_signal, -1e-6));
  CHECK(refused(&WindowStatement::start_frequency, 0.0));
  WindowStatement negative_share = statement;
  negative_share.shares[2] = Ball(-0.05);
  CHECK(!is_proved(negative_share, design));
  WindowStatement all_forgotten = statement;
  all_forgotten.shares = {Ball(0.9)};
  CHECK(!is_proved(all_forgotten, design));
  WindowStatement empty = statement;
  empty.shares.clear();
  CHECK(!is_proved(empty, design));
}

TEST_CASE("a window is only for a tracker without a leak, with process noise in the amplitude") {
  const WindowStatement statement = true_statement(along_a_tone());
  checker::SingleChannelDesign leaking = design_of_the_tone();
  leaking.epsilon = Ball(1e-6);
  CHECK(!is_proved(statement, leaking));
  checker::SingleChannelDesign undriven = design_of_the_tone();
  undriven.q1 = Ball(0.0);
  CHECK(!is_proved(statement, undriven));
}

TEST_CASE("a frequency and pi less it are the same to the covariance") {
  const Extremes seen = along_a_tone();
  checker::SingleChannelDesign mirrored = design_of_the_tone();
  mirrored.lowest = mirrored.highest = checker::pi() - Ball(kFrequency);
  WindowStatement statement = true_statement(seen);
  CHECK(is_proved(statement, mirrored));
  statement.frequency_variance = Ball(0.999 * seen.most_p33);
  CHECK(!is_proved(statement, mirrored));
}

}  // namespace

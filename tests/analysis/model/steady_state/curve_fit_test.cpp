#include "analysis/model/steady_state/curve_fit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using test::tone_of;

/// The state after so many samples from the start, at phase 0 then.
Eigen::VectorXd simulated(const TrackedTone& tone, double frequency, int samples) {
  const std::vector<double> start = tone.start(frequency);
  Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(start.data(), tone.step.states());
  for (int k = 1; k <= samples; ++k) {
    const double phase = (k - samples) * frequency;
    state = tone.step.next(state, samples_of(tone.signal, tone.amplitude, phase));
  }
  return state;
}

TEST_CASE("derivatives of a step agree with differences") {
  const rigor::NearestRounding nearest;
  const test::ExampleTracker example = test::notch_filter();
  const StepMap step(example.recursion, example.constants);
  const Eigen::Vector4d x(1.2, -0.7, 1.6, 0.03);
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 0.4);
  const StepDerivatives d = step.derivatives(x, y, Eigen::Vector4d(1.0, 1.0, 1e-2, 1e-3));
  CHECK((d.state - step.jacobian(x, y).leftCols(4)).norm() < 1e-12);
  CHECK((d.sample - step.jacobian(x, y).rightCols(1)).norm() < 1e-12);
  const double h = 1e-5;
  for (int k = 0; k < 4; ++k) {
    const Eigen::VectorXd change = h * Eigen::Vector4d::Unit(k);
    const StepDerivatives up = step.derivatives(x + change, y, Eigen::Vector4d::Ones());
    const StepDerivatives down = step.derivatives(x - change, y, Eigen::Vector4d::Ones());
    const Eigen::MatrixXd slope = (up.state - down.state) / (2.0 * h);
    const Eigen::MatrixXd sample_slope = (up.sample - down.sample) / (2.0 * h);
    for (std::size_t row = 0; row < 4; ++row) {
      const auto i = static_cast<Eigen::Index>(row);
      CHECK((d.second[row].col(k).head(4).transpose() - slope.row(i)).norm() < 1e-6 * (1.0 + slope.norm()));
      CHECK(std::fabs(d.second[row](4, k) - sample_slope(i, 0)) < 1e-6 * (1.0 + slope.norm()));
      const Eigen::MatrixXd curve = (up.second[row] - down.second[row]).topLeftCorner(4, 4) / (2.0 * h);
      const Eigen::MatrixXd third = d.third.row(i).segment(16 * k, 16).reshaped(4, 4);
      CHECK((third - curve).norm() < 1e-5 * (1.0 + curve.norm()));
    }
  }
  const double bend = (step.frequency_gradient(x + h * Eigen::Vector4d::Unit(2))[2] -
                       step.frequency_gradient(x - h * Eigen::Vector4d::Unit(2))[2]) /
                      (2.0 * h);
  CHECK(step.frequency_hessian(x)(2, 2) == doctest::Approx(bend).epsilon(1e-6));
}

TEST_CASE("curves are invariant to rounding, and simulations come to them") {
  const rigor::NearestRounding nearest;
  struct Case {
    test::ExampleTracker example;
    double frequency;
    double half_width;
  };
  // The last one: a period of four samples, where a simulation sees four phases only.
  for (const Case& c :
       {Case{test::phase_locked_loop(), 0.3, 0.02}, Case{test::integrator_loop(), 0.0314, 6e-4},
        Case{test::notch_filter(), 0.5, 0.01}, Case{test::aranovskiy_observer(), 0.1, 0.005},
        Case{test::kalman_filter(1, 0.005, 0.01), 0.45, 0.02},
        Case{test::kalman_filter(1, 0.005, 0.01), 0.5 * M_PI, 0.02}}) {
    const TrackedTone tone = tone_of(c.example);
    const SteadyState steady = find_steady_state(tone, c.frequency);
    REQUIRE(steady.outcome == SteadyStateOutcome::settled);
    const auto fit = fit_curve(tone, c.frequency, c.half_width, steady);
    REQUIRE(fit);
    CHECK(fit->frequency_error < 1e-9);
    for (const NodeCurve& node : fit->nodes) {
      CHECK(node.residual < 1e-12);
    }
    for (const double z : {-1.0, 0.2, 1.0}) {
      const NodeCurve curve = fit->at(z);
      const Eigen::VectorXd expected = simulated(tone, curve.frequency, 6000);
      Eigen::VectorXd difference = state_at(curve, 0.0) - expected;
      for (std::size_t i = 0; i < curve.turns.size(); ++i) {
        auto& d = difference[static_cast<Eigen::Index>(i)];
        d = curve.turns[i] != 0 ? std::remainder(d, 2.0 * M_PI) : d;
      }
      CHECK(std::fabs(tone.step.frequency_gradient(expected).dot(difference)) < 1e-8);
      CHECK(difference.cwiseAbs().maxCoeff() < 1e-7 * (1.0 + expected.cwiseAbs().maxCoeff()));
    }
    // The slope against a difference.
    const Eigen::MatrixXcd slope =
        (fit->at(0.01).harmonics - fit->at(-0.01).harmonics) / (0.02 * c.half_width);
    CHECK((fit->slope_at(0.0) - slope).norm() < 1e-3 * (1e-6 + slope.norm()));
  }
}

TEST_CASE("more frequencies of a cell, and the curve between them is known further") {
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  const SteadyState steady = find_steady_state(tone, 0.3);
  const auto coarse = fit_curve(tone, 0.3, 0.05, steady, 1e-15);
  const auto fine = fit_curve(tone, 0.3, 0.05, steady, 1e-15, kFineNodes);
  REQUIRE(coarse);
  REQUIRE(fine);
  CHECK(coarse->coefficients.size() == kNodes);
  CHECK(fine->coefficients.size() == kFineNodes);
  CHECK(fine->frequency_error < 0.05 * coarse->frequency_error);
  for (const double z : {-1.0, 0.77, 1.0}) {
    const NodeCurve curve = fine->at(z);
    CHECK(std::fabs((state_at(curve, 0.0) - simulated(tone, curve.frequency, 6000))[0]) < 1e-9);
  }
}

TEST_CASE("a cell without width is refused") {
  const TrackedTone tone = tone_of(test::phase_locked_loop());
  CHECK_THROWS_AS((void)fit_curve(tone, 0.3, 0.0, find_steady_state(tone, 0.3)), std::invalid_argument);
  CHECK_THROWS_AS((void)fit_curve(tone, 0.3, 0.01, find_steady_state(tone, 0.3), 1e-13, 4),
                  std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model

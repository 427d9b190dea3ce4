// Trackers as the verification sees them, and their tubes in floating point: for attacks that share no code
// with what they attack.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <span>
#include <utility>
#include <vector>

#include "analysis/model/step/tube_step.hpp"
#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::test {

/// A cos(phi), and with two channels A sin(phi).
inline StraightLineProgram tone(int constants, bool quadrature = false) {
  StraightLineProgram program(constants + 2);
  const int phase = constants + 1;
  program.add_result(program.append(Operation::multiply, constants, program.append(Operation::cos, phase)));
  if (quadrature) {
    program.add_result(program.append(Operation::multiply, constants, program.append(Operation::sin, phase)));
  }
  return program;
}

/// An example as the verification sees it, on a tone of amplitude 1.
struct Example {
  ExampleTracker tracker;
  StraightLineProgram signal;
  model::TrackerModel model;

  explicit Example(ExampleTracker example)
      : tracker(std::move(example)), signal(tone(tracker.recursion.constants)) {
    model.recursion = &tracker.recursion;
    model.signal = &signal;
    for (const double constant : tracker.constants) {
      model.constants.emplace_back(constant);
    }
    model.amplitude = rigor::Interval(1.0);
  }
  Example(const Example&) = delete;
  Example& operator=(const Example&) = delete;
  Example(Example&&) = delete;
  Example& operator=(Example&&) = delete;
  ~Example() = default;
};

/// The next state of a tracker with one channel.
inline Eigen::VectorXd next_state(const ExampleTracker& tracker, const Eigen::VectorXd& state,
                                  double sample) {
  std::vector<double> inputs = tracker.constants;
  inputs.insert(inputs.end(), state.begin(), state.end());
  inputs.push_back(sample);
  std::vector<double> registers;
  std::vector<double> next(static_cast<std::size_t>(state.size()));
  tracker.recursion.step.run(std::span<const double>(inputs), registers, std::span(next));
  return Eigen::Map<const Eigen::VectorXd>(next.data(), state.size());
}

/// A tube in floating point.
class PointTube {
 public:
  explicit PointTube(const model::Tube& tube) : tube_(&tube) {}

  [[nodiscard]] double low() const { return tube_->frequency - tube_->half_width; }
  [[nodiscard]] double high() const { return tube_->frequency + tube_->half_width; }

  [[nodiscard]] Eigen::VectorXd curve(double phase, double frequency) const {
    Eigen::VectorXd point(static_cast<Eigen::Index>(tube_->curve.size()));
    for (Eigen::Index i = 0; i < point.size(); ++i) {
      const auto state = static_cast<std::size_t>(i);
      point[i] = tube_->turns[state] * phase + value(tube_->curve[state], phase, frequency);
    }
    return point;
  }
  [[nodiscard]] Eigen::MatrixXd shape(double phase, double frequency) const {
    const auto n = static_cast<Eigen::Index>(tube_->curve.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    std::size_t place = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        matrix(i, j) = value(tube_->shape[place++], phase, frequency);
      }
    }
    return matrix;
  }
  /// |U^-1 (state - C)|.
  [[nodiscard]] double level(const Eigen::VectorXd& state, double phase, double frequency) const {
    return shape(phase, frequency)
        .triangularView<Eigen::Lower>()
        .solve(state - curve(phase, frequency))
        .norm();
  }

 private:
  [[nodiscard]] double value(const model::PhaseSeries& series, double phase, double frequency) const {
    const double z = (frequency - tube_->frequency) / tube_->half_width;
    double sum = 0.0;
    for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
      for (std::size_t d = 0; d < series.coefficients[h].size(); ++d) {
        sum += (series.coefficients[h][d] * std::polar(1.0, static_cast<double>(h) * phase)).real() *
               std::pow(z, static_cast<double>(d));
      }
    }
    return sum;
  }

  const model::Tube* tube_;
};

}  // namespace veritrack::test

// Loops of two channels, for the tests of gains.
#pragma once

#include <cmath>
#include <utility>

#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::test {

enum class Detector {
  arctangent2,   ///< atan2(q, i)
  arctangent,    ///< atan(q / i)
  sine,          ///< q
  normalised,    ///< q / sqrt(i^2 + q^2)
  knee,          ///< half of e and half of clamp(e, -kp, kp), e = atan2(q, i)
  four_quarters  ///< sign(i) q - sign(q) i: at rest an eighth of a turn away
};

/// e of the samples turned back by theta; theta' = theta + w + kp e, w' = w + ki e. States theta, w.
inline ExampleTracker two_channel_loop(double kp, double ki, Detector detector) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;
  r.states = 2;
  r.samples = 2;
  r.is_angle = {true, false};
  StraightLineProgram step(6);
  const int proportional = 0, integral = 1, theta = 2, w = 3, y1 = 4, y2 = 5;
  const int c = step.append(Operation::cos, theta);
  const int s = step.append(Operation::sin, theta);
  const auto product = [&](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int i = step.append(Operation::add, product(y1, c), product(y2, s));
  const int q = step.append(Operation::subtract, product(y2, c), product(y1, s));
  int e = q;
  if (detector == Detector::arctangent2) {
    e = step.append(Operation::atan2, q, i);
  } else if (detector == Detector::arctangent) {
    e = step.append(Operation::atan, step.append(Operation::divide, q, i));
  } else if (detector == Detector::normalised) {
    const int squares = step.append(Operation::add, product(i, i), product(q, q));
    e = step.append(Operation::divide, q, step.append(Operation::sqrt, squares));
  }
  if (detector == Detector::knee) {
    const int whole = step.append(Operation::atan2, q, i);
    const int low = step.append(Operation::negate, proportional);
    const int sum =
        step.append(Operation::add, whole, step.append(Operation::clamp, whole, low, proportional));
    const int two =
        step.append(Operation::divide, step.append(Operation::add, proportional, proportional), proportional);
    e = step.append(Operation::divide, sum, two);
  } else if (detector == Detector::four_quarters) {
    e = step.append(Operation::subtract, product(step.append(Operation::sign, i), q),
                    product(step.append(Operation::sign, q), i));
  }
  step.add_result(
      step.append(Operation::add, step.append(Operation::add, theta, w), product(proportional, e)));
  step.add_result(step.append(Operation::add, w, product(integral, e)));
  r.step = std::move(step);
  r.frequency = frequency_of_state(2, 2, 1);
  example.constants = {kp, ki};
  example.start = [](double omega) { return std::vector<double>{omega, omega}; };
  return example;
}

/// The turn from the last pair of samples to this one, smoothed. States p1, p2 (the last samples) and w;
/// w' = w + gain (atan2(y2 p1 - y1 p2, y1 p1 + y2 p2) - w). Both samples are kept times `kept`.
inline ExampleTracker turn_between_samples(double gain, double kept = 1.0) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;
  r.states = 3;
  r.samples = 2;
  r.is_angle = {false, false, false};
  StraightLineProgram step(7);
  const int g = 0, k = 1, p1 = 2, p2 = 3, w = 4, y1 = 5, y2 = 6;
  const auto product = [&](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int cross = step.append(Operation::subtract, product(y2, p1), product(y1, p2));
  const int dot = step.append(Operation::add, product(y1, p1), product(y2, p2));
  const int e = step.append(Operation::subtract, step.append(Operation::atan2, cross, dot), w);
  step.add_result(product(k, y1));
  step.add_result(product(k, y2));
  step.add_result(step.append(Operation::add, w, product(g, e)));
  r.step = std::move(step);
  r.frequency = frequency_of_state(2, 3, 2);
  example.constants = {gain, kept};
  example.start = [kept](double omega) { return std::vector<double>{kept, 0.0, omega}; };
  return example;
}

/// The turn by products of this pair of samples and the last one. States p1, p2 (the last samples) and w;
/// w' = w + gain ((y2 p1 - y1 p2) cos w - (y1 p1 + y2 p2) sin w).
inline ExampleTracker product_of_samples(double gain) {
  ExampleTracker example = turn_between_samples(gain);
  StraightLineProgram step(7);
  const int g = 0, p1 = 2, p2 = 3, w = 4, y1 = 5, y2 = 6;
  const auto product = [&](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int cross = step.append(Operation::subtract, product(y2, p1), product(y1, p2));
  const int dot = step.append(Operation::add, product(y1, p1), product(y2, p2));
  const int turned = step.append(Operation::subtract, product(cross, step.append(Operation::cos, w)),
                                 product(dot, step.append(Operation::sin, w)));
  step.add_result(y1);
  step.add_result(y2);
  step.add_result(step.append(Operation::add, w, product(g, turned)));
  example.recursion.step = std::move(step);
  return example;
}

/// The loop as the verification sees it, on a tone of two channels.
struct TwoChannelExample {
  ExampleTracker tracker;
  StraightLineProgram signal;
  model::TrackerModel model;
  model::TrackedTone tone;

  explicit TwoChannelExample(ExampleTracker example)
      : tracker(std::move(example)),
        signal(test::tone(tracker.recursion.constants, true)),
        tone(tone_of(tracker, true)) {
    model.recursion = &tracker.recursion;
    model.signal = &signal;
    for (const double constant : tracker.constants) {
      model.constants.emplace_back(constant);
    }
    model.amplitude = rigor::Interval(1.0);
  }
  TwoChannelExample(const TwoChannelExample&) = delete;
  TwoChannelExample& operator=(const TwoChannelExample&) = delete;
  TwoChannelExample(TwoChannelExample&&) = delete;
  TwoChannelExample& operator=(TwoChannelExample&&) = delete;
  ~TwoChannelExample() = default;
};

}  // namespace veritrack::test

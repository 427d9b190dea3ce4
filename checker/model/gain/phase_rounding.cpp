#include "checker/model/gain/phase_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "checker/model/gain/phase_range.hpp"
#include "checker/model/gain/wide_number.hpp"

namespace veritrack::checker {

namespace {

void raise_each(std::vector<double>& most, const std::vector<double>& values) {
  most.resize(std::max(most.size(), values.size()), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    most[i] = std::isfinite(values[i]) ? std::max(most[i], values[i]) : HUGE_VAL;
  }
}

/// Of a value that may be this much off.
Ball range_of(const BallPolynomial& value, double off) {
  const DoubleRange range = range_over_cell(value);
  return Ball::hull(Ball(range.low), Ball(range.high)) + Ball::within(Ball(off));
}

}  // namespace

void PhaseRounding::raise(const PhaseRounding& other) {
  raise_each(of_step, other.of_step);
  raise_each(of_start, other.of_start);
  of_frequency = std::isfinite(other.of_frequency) ? std::max(of_frequency, other.of_frequency) : HUGE_VAL;
}

PhaseRounding rounding_over(const RoundedProgram& program, const PhaseRun& run) {
  const std::size_t n = run.curve.size();
  std::vector<Ball> states;
  for (std::size_t i = 0; i < n; ++i) {
    states.push_back(std::isfinite(program.room[i]) ? range_of(run.curve[i], program.room[i])
                                                    : Ball::everything());
  }
  Ball samples = range_of(run.signal.front(), program.most_noise);
  for (const BallPolynomial& channel : run.signal) {
    samples = Ball::hull(samples, range_of(channel, program.most_noise));
  }
  const auto off = program.of_step(states, samples);
  if (!off || off->size() != n + 1) {
    throw NotCovered("no bound of the program's rounding is known");
  }
  PhaseRounding found;
  for (std::size_t i = 0; i < n; ++i) {
    Ball sum;
    for (std::size_t j = 0; j < n; ++j) {
      sum += Ball(largest_over_cell(run.inverse[i][j])) * (*off)[j];
    }
    found.of_step.push_back(upper(sum));
    found.of_start.push_back(upper((*off)[i]));
  }
  found.of_frequency = upper(off->back());
  return found;
}

}  // namespace veritrack::checker

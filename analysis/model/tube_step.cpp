#include "analysis/model/tube_step.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "analysis/model/map_bound.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

/// A tube at a phase, as ball models of the place in a cell.
struct TubeHere {
  std::vector<BallModel> curve;
  std::vector<BallModel> shape;  ///< the lower triangle, row by row
};

std::size_t harmonics_of(const Tube& tube) {
  std::size_t most = 0;
  for (const std::vector<PhaseSeries>* part : {&tube.curve, &tube.shape}) {
    for (const PhaseSeries& series : *part) {
      most = std::max(most, series.coefficients.size());
    }
  }
  return most;
}

std::size_t powers_of(const Tube& tube) {
  std::size_t most = 0;
  for (const std::vector<PhaseSeries>* part : {&tube.curve, &tube.shape}) {
    for (const PhaseSeries& series : *part) {
      for (const auto& harmonic : series.coefficients) {
        most = std::max(most, harmonic.size());
      }
    }
  }
  return most;
}

/// The sum of a series, without the terms that are zero.
BallModel sum_of(const PhaseSeries& series, const std::vector<std::pair<BallModel, BallModel>>& harmonics,
                 const std::vector<BallModel>& powers) {
  BallModel sum;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    BallModel real;
    BallModel imaginary;
    for (std::size_t d = 0; d < series.coefficients[h].size(); ++d) {
      const std::complex<double>& coefficient = series.coefficients[h][d];
      if (coefficient.real() != 0.0) {
        real = real + BallModel(coefficient.real()) * powers[d];
      }
      if (coefficient.imag() != 0.0 && h > 0) {
        imaginary = imaginary + BallModel(coefficient.imag()) * powers[d];
      }
    }
    sum = h == 0 ? sum + real : sum + (real * harmonics[h].first - imaginary * harmonics[h].second);
  }
  return sum;
}

TubeHere tube_at(const Tube& tube, const BallModel& phase, const BallModel& z) {
  std::vector<std::pair<BallModel, BallModel>> harmonics;
  for (std::size_t h = 0; h < harmonics_of(tube); ++h) {
    const BallModel angle = BallModel(static_cast<double>(h)) * phase;
    harmonics.emplace_back(cos(angle), sin(angle));
  }
  std::vector<BallModel> powers{BallModel(1.0)};
  while (powers.size() < powers_of(tube)) {
    powers.push_back(powers.back() * z);
  }
  TubeHere here;
  for (std::size_t i = 0; i < tube.curve.size(); ++i) {
    here.curve.push_back(BallModel(static_cast<double>(tube.turns[i])) * phase +
                         sum_of(tube.curve[i], harmonics, powers));
  }
  for (const PhaseSeries& entry : tube.shape) {
    here.shape.push_back(sum_of(entry, harmonics, powers));
  }
  return here;
}

/// Constants, then these.
std::vector<BallModel> inputs_of(const TrackerModel& model, const std::vector<BallModel>& more) {
  std::vector<BallModel> inputs;
  inputs.reserve(model.constants.size() + more.size());
  for (const Interval& constant : model.constants) {
    inputs.emplace_back(constant);
  }
  inputs.insert(inputs.end(), more.begin(), more.end());
  return inputs;
}

std::vector<BallModel> run(const trackers::StraightLineProgram& program,
                           const std::vector<BallModel>& inputs) {
  std::vector<BallModel> registers;
  std::vector<BallModel> results(program.results().size());
  program.run(std::span<const BallModel>(inputs), registers, std::span(results));
  return results;
}

void require_sizes(const TrackerModel& model, const Tube& tube) {
  const auto states = static_cast<std::size_t>(model.recursion->states);
  if (tube.curve.size() != states || tube.turns.size() != states ||
      tube.shape.size() != states * (states + 1) / 2 || !(tube.half_width > 0.0) ||
      model.constants.size() != static_cast<std::size_t>(model.recursion->constants) ||
      model.signal->results().size() != static_cast<std::size_t>(model.recursion->samples)) {
    throw std::invalid_argument("a tube that does not fit the recursion");
  }
}

}  // namespace

StepBounds bound_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell, double radius,
                      double noise, const std::vector<double>& scales) {
  require_sizes(model, tube);
  const auto states = static_cast<std::size_t>(model.recursion->states);
  const auto samples = static_cast<std::size_t>(model.recursion->samples);
  const rigor::BallModelScope scope(static_cast<int>(states), noise > 0.0 ? static_cast<int>(samples) : 0);

  const Interval turn = Interval(2.0) * rigor::pi();
  const BallModel phase =
      BallModel(turn * Interval(cell.turn)) + BallModel(turn * Interval(cell.half_turn)) * BallModel::s();
  const BallModel z = BallModel(cell.z) + BallModel(cell.half_z) * BallModel::z();
  const BallModel omega = BallModel(tube.frequency) + BallModel(tube.half_width) * z;
  const BallModel next_phase = phase + omega;
  const TubeHere here = tube_at(tube, phase, z);
  const TubeHere there = tube_at(tube, next_phase, z);

  std::vector<BallModel> state = here.curve;
  for (std::size_t i = 0; i < states; ++i) {
    BallModel deviation;
    for (std::size_t j = 0; j <= i; ++j) {
      deviation = deviation + here.shape[i * (i + 1) / 2 + j] * BallModel::ball(static_cast<int>(j));
    }
    state[i] = state[i] + BallModel(radius) * deviation;
  }
  std::vector<BallModel> inputs = inputs_of(model, state);
  const std::vector<BallModel> signal =
      run(*model.signal, inputs_of(model, {BallModel(model.amplitude), next_phase}));
  for (std::size_t c = 0; c < samples; ++c) {
    inputs.push_back(noise > 0.0 ? signal[c] + BallModel(noise) * BallModel::disturbance(static_cast<int>(c))
                                 : signal[c]);
  }
  const std::vector<BallModel> next = run(model.recursion->step, inputs);

  std::vector<BallModel> deviation;  // F, by forward substitution
  for (std::size_t i = 0; i < states; ++i) {
    BallModel rest = next[i] - there.curve[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest = rest - there.shape[i * (i + 1) / 2 + j] * deviation[j];
    }
    deviation.push_back(rest / there.shape[i * (i + 1) / 2 + i]);
  }
  StepBounds bounds;
  for (const double scale : scales) {
    bounds.steps.push_back(length_bound(deviation, scale));
  }
  const auto& classes = deviation.front().monomials().classes();
  for (const BallModel& component : deviation) {
    for (std::size_t number = 0; number < classes.size(); ++number) {
      bounds.by_phase += classes[number].s > 0 ? component.norm(number) : 0.0;
      bounds.by_frequency += classes[number].z > 0 ? component.norm(number) : 0.0;
    }
  }
  const std::vector<BallModel> frequency = run(model.recursion->frequency, inputs_of(model, state));
  bounds.frequency_error = (frequency.front() - omega).range();
  // The shape must be one: no component of it vanishes, here or there.
  for (std::size_t i = 0; i < states; ++i) {
    if (!rigor::certainly_positive(here.shape[i * (i + 1) / 2 + i].range())) {
      bounds.steps.assign(scales.size(), std::numeric_limits<double>::quiet_NaN());
      bounds.frequency_error = Interval::empty();
    }
  }
  return bounds;
}

}  // namespace veritrack::model

#include "analysis/model/tube_models.hpp"

#include <algorithm>
#include <complex>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

std::size_t most_harmonics(const Tube& tube) {
  std::size_t most = 0;
  for (const std::vector<PhaseSeries>* part : {&tube.curve, &tube.shape}) {
    for (const PhaseSeries& series : *part) {
      most = std::max(most, series.coefficients.size());
    }
  }
  return most;
}

std::size_t most_powers(const Tube& tube) {
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

}  // namespace

TubeHere tube_at(const Tube& tube, const BallModel& phase, const BallModel& z) {
  std::vector<std::pair<BallModel, BallModel>> harmonics;
  for (std::size_t h = 0; h < most_harmonics(tube); ++h) {
    const BallModel angle = BallModel(static_cast<double>(h)) * phase;
    harmonics.emplace_back(cos(angle), sin(angle));
  }
  std::vector<BallModel> powers{BallModel(1.0)};
  while (powers.size() < most_powers(tube)) {
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

CellFrame frame_of(const TrackerModel& model, const Tube& tube, const TubeCell& cell, bool with_next) {
  const auto plane = [&] {
    const rigor::BallModelScope scope(0, 0);
    const Interval turn = Interval(2.0) * rigor::pi();
    CellFrame frame;
    frame.phase =
        BallModel(turn * Interval(cell.turn)) + BallModel(turn * Interval(cell.half_turn)) * BallModel::s();
    frame.z = BallModel(cell.z) + BallModel(cell.half_z) * BallModel::z();
    frame.frequency = BallModel(tube.frequency) + BallModel(tube.half_width) * frame.z;
    frame.next_phase = frame.phase + frame.frequency;
    frame.here = tube_at(tube, frame.phase, frame.z);
    if (with_next) {
      frame.there = tube_at(tube, frame.next_phase, frame.z);
      frame.next = run(model, *model.signal, {BallModel(model.amplitude), frame.next_phase});
    }
    return frame;
  };
  CellFrame frame = plane();
  for (BallModel* each : {&frame.phase, &frame.z, &frame.frequency, &frame.next_phase}) {
    *each = each->lifted();
  }
  for (std::vector<BallModel>* list :
       {&frame.here.curve, &frame.here.shape, &frame.there.curve, &frame.there.shape, &frame.next}) {
    for (BallModel& each : *list) {
      each = each.lifted();
    }
  }
  return frame;
}

std::vector<BallModel> state_in(const TubeHere& here, double radius) {
  std::vector<BallModel> x;
  for (std::size_t i = 0; i < here.curve.size(); ++i) {
    x.push_back(BallModel::ball(static_cast<int>(i)));
  }
  return state_in(here, radius, x);
}

std::vector<BallModel> state_in(const TubeHere& here, double radius, const std::vector<BallModel>& x) {
  std::vector<BallModel> state = here.curve;
  for (std::size_t i = 0; i < state.size(); ++i) {
    BallModel deviation;
    for (std::size_t j = 0; j <= i; ++j) {
      deviation = deviation + here.shape[i * (i + 1) / 2 + j] * x[j];
    }
    state[i] = state[i] + BallModel(radius) * deviation;
  }
  return state;
}

std::vector<BallModel> in_units_of(const TubeHere& there, const std::vector<BallModel>& deviation) {
  std::vector<BallModel> x;
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    BallModel rest = deviation[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest = rest - there.shape[i * (i + 1) / 2 + j] * x[j];
    }
    x.push_back(rest / there.shape[i * (i + 1) / 2 + i]);
  }
  return x;
}

bool is_shape(const TubeHere& here) {
  for (std::size_t i = 0; i < here.curve.size(); ++i) {
    if (!rigor::certainly_positive(here.shape[i * (i + 1) / 2 + i].range())) {
      return false;
    }
  }
  return true;
}

std::vector<BallModel> run(const TrackerModel& model, const trackers::StraightLineProgram& program,
                           const std::vector<BallModel>& inputs) {
  std::vector<BallModel> all;
  all.reserve(model.constants.size() + inputs.size());
  for (const Interval& constant : model.constants) {
    all.emplace_back(constant);
  }
  all.insert(all.end(), inputs.begin(), inputs.end());
  std::vector<BallModel> registers;
  std::vector<BallModel> results(program.results().size());
  program.run(std::span<const BallModel>(all), registers, std::span(results));
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

}  // namespace veritrack::model

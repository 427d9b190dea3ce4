#include "analysis/model/step/tube_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "analysis/model/step/place_store.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_coefficients.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

std::size_t most_harmonics(const Tube& tube) {
  std::size_t most = 0;
  for (const std::vector<PhaseSeries>* part :
       {&tube.curve, &tube.shape, &tube.covariance_low, &tube.covariance_high}) {
    for (const PhaseSeries& series : *part) {
      most = std::max(most, series.coefficients.size());
    }
  }
  return most;
}

std::size_t most_powers(const Tube& tube) {
  std::size_t most = 0;
  for (const std::vector<PhaseSeries>* part :
       {&tube.curve, &tube.shape, &tube.covariance_low, &tube.covariance_high}) {
    for (const PhaseSeries& series : *part) {
      for (const auto& harmonic : series.coefficients) {
        most = std::max(most, harmonic.size());
      }
    }
  }
  return most;
}

/// cos and sin of h phi.
using Harmonics = std::vector<std::pair<BallModel, BallModel>>;

/// All from the powers of the varying part u of the phase: cos(h (c + u)) = sum_{k <= 4} f^(k)(h c)/k! (h
/// u)^k + f^(5)(t)/5! (h u)^5.
Harmonics harmonics_at(const BallModel& phase, std::size_t count) {
  const Interval range = phase.range();
  Harmonics harmonics;
  harmonics.reserve(count);
  if (is_empty(range)) {
    const BallModel unknown{Interval::empty()};
    harmonics.assign(count, {unknown, unknown});
    return harmonics;
  }
  const BallModel u = phase.without_constant();
  std::vector<BallModel> powers{BallModel(1.0), u, u * u};
  powers.push_back(powers[2] * u);
  powers.push_back(powers[2] * powers[2]);
  std::array<Interval, 5> sizes;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sizes.at(k) = abs(powers[k].range());
  }
  const Interval fifth = pow(Interval(u.deviation()), 5);
  const auto sum_of = [&](const rigor::TaylorCoefficients& at_constant,
                          const rigor::TaylorCoefficients& on_range, const Interval& h) {
    BallModel sum;
    Interval more(0.0);
    Interval power(1.0);
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const Interval coefficient = at_constant.at(k) * power;
      const double middle = rigor::midpoint(coefficient);
      sum.add_multiple(powers[k], middle);
      more = more + abs(coefficient - Interval(middle)) * sizes.at(k);
      power = power * h;
    }
    return sum.widened((more + abs(on_range.back()) * power * fifth).upper());
  };
  for (std::size_t number = 0; number < count; ++number) {
    const Interval h(static_cast<double>(number));
    const Interval constant = h * Interval(phase.constant());
    const Interval whole = h * range;
    harmonics.emplace_back(sum_of(rigor::taylor_of_cos(constant), rigor::taylor_of_cos(whole), h),
                           sum_of(rigor::taylor_of_sin(constant), rigor::taylor_of_sin(whole), h));
  }
  return harmonics;
}

std::vector<BallModel> powers_at(const BallModel& z, std::size_t count) {
  std::vector<BallModel> powers{BallModel(1.0)};
  powers.reserve(std::max<std::size_t>(count, 1));
  while (powers.size() < count) {
    powers.push_back(powers.back() * z);
  }
  return powers;
}

/// The coefficient of harmonic h, real and imaginary part, without the terms that are zero.
std::pair<BallModel, BallModel> coefficient_of(const PhaseSeries& series, std::size_t h,
                                               const std::vector<BallModel>& powers) {
  std::pair<BallModel, BallModel> sum;
  for (std::size_t d = 0; h < series.coefficients.size() && d < series.coefficients[h].size(); ++d) {
    const std::complex<double>& coefficient = series.coefficients[h][d];
    if (coefficient.real() != 0.0) {
      sum.first.add_multiple(powers[d], coefficient.real());
    }
    if (coefficient.imag() != 0.0 && h > 0) {
      sum.second.add_multiple(powers[d], coefficient.imag());
    }
  }
  return sum;
}

BallModel sum_of(const PhaseSeries& series, const Harmonics& harmonics,
                 const std::vector<BallModel>& powers) {
  BallModel sum;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    if (series.coefficients[h].empty()) {
      continue;  // many series have every second harmonic only
    }
    const auto [real, imaginary] = coefficient_of(series, h, powers);
    sum += h == 0 ? real : real * harmonics[h].first - imaginary * harmonics[h].second;
  }
  return sum;
}

BallModel difference_of(const PhaseSeries& a, const std::vector<BallModel>& powers_of_a, const PhaseSeries& b,
                        const std::vector<BallModel>& powers_of_b, const Harmonics& harmonics) {
  BallModel sum;
  for (std::size_t h = 0; h < std::max(a.coefficients.size(), b.coefficients.size()); ++h) {
    const std::pair<BallModel, BallModel> of_a = coefficient_of(a, h, powers_of_a);
    const std::pair<BallModel, BallModel> of_b = coefficient_of(b, h, powers_of_b);
    const BallModel real = of_a.first - of_b.first;
    const BallModel imaginary = of_a.second - of_b.second;
    sum = h == 0 ? sum + real : sum + (real * harmonics[h].first - imaginary * harmonics[h].second);
  }
  return sum;
}

}  // namespace

CellPlace place_of(const TubeCell& cell) {
  const Interval turn = Interval(2.0) * rigor::pi();
  return {BallModel(turn * Interval(cell.turn)) + BallModel(turn * Interval(cell.half_turn)) * BallModel::s(),
          BallModel(cell.z) + BallModel(cell.half_z) * BallModel::z()};
}

BallModel frequency_at(const Tube& tube, const BallModel& z) {
  return BallModel(tube.frequency) + BallModel(tube.half_width) * z;
}

TubeHere tube_at(const Tube& tube, const BallModel& phase, const BallModel& z) {
  const Harmonics harmonics = harmonics_at(phase, most_harmonics(tube));
  const std::vector<BallModel> powers = powers_at(z, most_powers(tube));
  TubeHere here;
  for (std::size_t i = 0; i < tube.curve.size(); ++i) {
    here.curve.push_back(BallModel(static_cast<double>(tube.turns[i])) * phase +
                         sum_of(tube.curve[i], harmonics, powers));
  }
  for (const PhaseSeries& entry : tube.shape) {
    here.shape.push_back(sum_of(entry, harmonics, powers));
  }
  for (const PhaseSeries& entry : tube.covariance_low) {
    here.covariance_low.push_back(sum_of(entry, harmonics, powers));
  }
  for (const PhaseSeries& entry : tube.covariance_high) {
    here.covariance_high.push_back(sum_of(entry, harmonics, powers));
  }
  return here;
}

std::vector<BallModel> curve_slope_at(const Tube& tube, const BallModel& phase, const BallModel& z) {
  const Harmonics harmonics = harmonics_at(phase, most_harmonics(tube));
  std::vector<BallModel> slopes{BallModel(0.0)};  // of z^d
  for (const BallModel& power : powers_at(z, most_powers(tube))) {
    slopes.push_back(power * BallModel(static_cast<double>(slopes.size())));
  }
  std::vector<BallModel> result;
  for (const PhaseSeries& each : tube.curve) {
    result.push_back(sum_of(each, harmonics, slopes));
  }
  return result;
}

CellFrame frame_of(const TrackerModel& model, const Tube& tube, const TubeCell& cell, FrameParts parts,
                   PlaceStore* store) {
  const auto plane = [&] {
    const rigor::BallModelScope scope(0, 0);
    CellFrame frame;
    const CellPlace place = place_of(cell);
    frame.phase = place.phase;
    frame.z = place.z;
    frame.frequency = frequency_at(tube, frame.z);
    frame.next_phase = frame.phase + frame.frequency;
    frame.here = tube_at(tube, frame.phase, frame.z);
    if (parts == FrameParts::with_next) {
      frame.there = tube_at(tube, frame.next_phase, frame.z);
    }
    if (parts != FrameParts::here) {
      frame.next = run(model, *model.signal, {BallModel(model.amplitude), frame.next_phase});
    }
    return frame;
  };
  CellFrame frame = *kept_at<CellFrame>(store, model, tube, cell, static_cast<double>(parts), plane);
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

std::vector<BallModel> noisy_samples(const TrackerModel& model, const std::vector<BallModel>& samples,
                                     double noise, double stretch) {
  if (!is_disturbed(model, noise)) {
    return samples;
  }
  std::vector<BallModel> result = samples;
  double most = noise;
  if (model.amplitude_varies) {
    Interval squares(0.0);
    for (BallModel& sample : result) {
      squares += rigor::square(Interval(sample.error()));
      sample = sample.without_error();
    }
    most = (Interval(noise) + rigor::sqrt(squares)).upper();
    if (!std::isfinite(most)) {
      return std::vector<BallModel>(samples.size(), BallModel(Interval::empty()));
    }
  }
  for (std::size_t c = 0; c < result.size(); ++c) {
    result[c] = result[c] + BallModel(most * stretch) * BallModel::disturbance(static_cast<int>(c));
  }
  return result;
}

TubeHere tube_difference(const Tube& a, const BallModel& z_of_a, const Tube& b, const BallModel& z_of_b,
                         const BallModel& phase) {
  const Harmonics harmonics = harmonics_at(phase, std::max(most_harmonics(a), most_harmonics(b)));
  const std::vector<BallModel> of_a = powers_at(z_of_a, most_powers(a));
  const std::vector<BallModel> of_b = powers_at(z_of_b, most_powers(b));
  TubeHere difference;
  difference.curve.reserve(a.curve.size());
  difference.shape.reserve(a.shape.size());
  for (std::size_t i = 0; i < a.curve.size(); ++i) {
    difference.curve.push_back(difference_of(a.curve[i], of_a, b.curve[i], of_b, harmonics));
  }
  for (std::size_t i = 0; i < a.shape.size(); ++i) {
    difference.shape.push_back(difference_of(a.shape[i], of_a, b.shape[i], of_b, harmonics));
  }
  return difference;
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
      deviation += here.shape[i * (i + 1) / 2 + j] * x[j];
    }
    state[i].add_multiple(deviation, radius);
  }
  return state;
}

std::vector<BallModel> in_units_of(const TubeHere& there, const std::vector<BallModel>& deviation) {
  std::vector<BallModel> x;
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    BallModel rest = deviation[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest -= there.shape[i * (i + 1) / 2 + j] * x[j];
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

BallModel frequency_of(const TrackerModel& model, std::vector<BallModel> state) {
  const auto states = static_cast<std::size_t>(model.recursion->states);
  while (state.size() < states) {
    state.emplace_back(Interval::empty());
  }
  return run(model, model.recursion->frequency, state).front();
}

void require_sizes(const TrackerModel& model, const Tube& tube) {
  const bool is_filter = tube.bounds_covariance();
  if (is_filter && model.filter == nullptr) {
    throw std::invalid_argument("a tube that bounds a covariance, of a tracker without one");
  }
  const auto states = static_cast<std::size_t>(is_filter ? model.filter->states : model.recursion->states);
  const std::size_t entries = is_filter ? states * (states + 1) / 2 : 0;
  if (tube.covariance_low.size() != entries || tube.covariance_high.size() != entries ||
      tube.curve.size() != states || tube.turns.size() != states ||
      tube.shape.size() != states * (states + 1) / 2 || !(tube.half_width > 0.0) ||
      model.constants.size() != static_cast<std::size_t>(model.recursion->constants) ||
      model.signal->results().size() != static_cast<std::size_t>(model.recursion->samples)) {
    throw std::invalid_argument("a tube that does not fit the recursion");
  }
}

}  // namespace veritrack::model

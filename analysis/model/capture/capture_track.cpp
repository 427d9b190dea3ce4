#include "analysis/model/capture/capture_track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_functions.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

/// The same functions of s among those of all variables.
CaptureModel lifted(const OverPhase& model) {
  const CaptureModel s = CaptureModel::variable(Interval::from_bounds(-1.0, 1.0), of_phase);
  CaptureModel power(1.0);
  CaptureModel sum(model.coefficients()[0]);
  for (std::size_t k = 1; k < OverPhase::kTerms; ++k) {
    power = power * s;
    sum += CaptureModel(model.coefficients()[k]) * power;
  }
  return sum.widened(model.remainder());
}

/// The inverse of a lower triangular matrix.
SlopeMatrix inverse_of(const SlopeMatrix& triangle) {
  SlopeMatrix inverse(triangle.rows, triangle.rows);
  for (std::size_t i = 0; i < triangle.rows; ++i) {
    inverse(i, i) = SlopeModel(1.0) / triangle(i, i);
  }
  for (std::size_t column = 0; column < triangle.rows; ++column) {
    for (std::size_t i = column + 1; i < triangle.rows; ++i) {
      SlopeModel rest(0.0);
      for (std::size_t j = column; j < i; ++j) {
        rest -= triangle(i, j) * inverse(j, column);
      }
      inverse(i, column) = rest * inverse(i, i);
    }
  }
  return inverse;
}

}  // namespace

CaptureTrack::CaptureTrack(const CaptureProblem& problem, const PhaseCell& phases)
    : problem_(&problem), phases_(phases), points_(*problem.tube, rigor::midpoint(problem.frequency)) {
  require_sizes(*problem.tracker, *problem.tube);
  if (problem.tube->curve.size() > SlopeMatrix::kMost) {
    throw std::invalid_argument("starts of more than four states cannot be followed");
  }
  for (const PhaseSeries& series : problem.tube->curve) {
    curve_.push_back(harmonics_of(series));
  }
  for (const PhaseSeries& series : problem.tube->shape) {
    shape_.push_back(harmonics_of(series));
  }
  for (const std::vector<Harmonics>* part : {&curve_, &shape_}) {
    for (const Harmonics& harmonics : *part) {
      most_harmonics_ = std::max(most_harmonics_, harmonics.size());
    }
  }
  signal_inputs_.reserve(problem.tracker->constants.size() + 2);
  for (const Interval& constant : problem.tracker->constants) {
    signal_inputs_.emplace_back(constant);
  }
  signal_inputs_.emplace_back(problem.tracker->amplitude);
  signal_inputs_.emplace_back(0.0);
}

CaptureTrack::Harmonics CaptureTrack::harmonics_of(const PhaseSeries& series) const {
  const Interval z =
      (problem_->frequency - Interval(problem_->tube->frequency)) / Interval(problem_->tube->half_width);
  Harmonics harmonics;
  harmonics.reserve(series.coefficients.size());
  for (const auto& powers : series.coefficients) {
    Interval real(0.0);
    Interval imaginary(0.0);
    for (std::size_t d = powers.size(); d-- > 0;) {
      real = real * z + Interval(powers[d].real());
      imaginary = imaginary * z + Interval(powers[d].imag());
    }
    harmonics.emplace_back(real, imaginary);
  }
  return harmonics;
}

CaptureTrack::Place& CaptureTrack::place(std::size_t sample) {
  while (places_.size() <= sample) {
    places_.emplace_back();
  }
  Place& here = places_[sample];
  if (!here.phase) {
    // Whole turns make no difference and only cost digits.
    const Interval full_turn = Interval(2.0) * rigor::pi();
    const Interval turned = Interval(static_cast<double>(sample)) * problem_->frequency;
    const double turns = std::floor(phases_.turn + rigor::midpoint(turned) / (2.0 * std::numbers::pi));
    const Interval middle = full_turn * (Interval(phases_.turn) - Interval(turns)) + turned;
    const OverPhase s = OverPhase::variable(Interval::from_bounds(-1.0, 1.0), of_phase);
    here.phase = OverPhase(middle) + OverPhase(full_turn * Interval(phases_.half_turn)) * s;
  }
  return here;
}

const std::vector<CaptureModel>& CaptureTrack::samples(std::size_t sample) {
  Place& here = place(sample);
  if (!here.samples) {
    signal_inputs_.back() = *here.phase;
    std::vector<OverPhase> values(problem_->tracker->signal->results().size());
    problem_->tracker->signal->run(std::span<const OverPhase>(signal_inputs_), registers_, std::span(values));
    here.samples.emplace();
    here.sample_errors = problem_->noise;
    if (problem_->tracker->amplitude_varies) {
      Interval squares(0.0);
      for (OverPhase& value : values) {
        squares += square(Interval(value.remainder()));
        value = value.polynomial();
      }
      const Interval errors = Interval(problem_->noise) + sqrt(squares);
      here.sample_errors =
          rigor::is_finite(errors) ? errors.upper() : std::numeric_limits<double>::infinity();
    }
    for (const OverPhase& value : values) {
      here.samples->push_back(lifted(value));
    }
  }
  return *here.samples;
}

double CaptureTrack::sample_errors(std::size_t sample) {
  (void)samples(sample);
  return place(sample).sample_errors;
}

const CaptureTarget& CaptureTrack::target(std::size_t sample) {
  Place& here = place(sample);
  if (!here.target) {
    here.target = target_at(*here.phase);
  }
  return *here.target;
}

CaptureTarget CaptureTrack::target_at(const OverPhase& phase) const {
  std::vector<std::pair<OverPhase, OverPhase>> turned;  // cos and sin of h phase
  turned.reserve(most_harmonics_);
  for (std::size_t h = 0; h < most_harmonics_; ++h) {
    const auto [sine, cosine] = sin_cos(OverPhase(static_cast<double>(h)) * phase);
    turned.emplace_back(cosine, sine);
  }
  const auto sum_of = [&](const Harmonics& harmonics) {
    OverPhase sum(0.0);
    for (std::size_t h = 0; h < harmonics.size(); ++h) {
      sum += OverPhase(harmonics[h].first) * turned[h].first;
      if (h > 0) {
        sum -= OverPhase(harmonics[h].second) * turned[h].second;
      }
    }
    return sum;
  };
  CaptureTarget target;
  points_.at(phase.constant(), target.middle);
  const std::size_t states = curve_.size();
  target.curve.reserve(states);
  for (std::size_t i = 0; i < states; ++i) {
    target.curve.push_back(
        lifted(sum_of(curve_[i]) + OverPhase(static_cast<double>(problem_->tube->turns[i])) * phase));
  }
  target.shape.reserve(shape_.size());
  target.reciprocal.reserve(states);
  target.row_length.reserve(states);
  target.shape_slopes = SlopeMatrix(states, states);
  for (std::size_t i = 0, number = 0; i < states; ++i) {
    Interval squares(0.0);
    for (std::size_t j = 0; j <= i; ++j, ++number) {
      const OverPhase entry = sum_of(shape_[number]);
      target.shape.push_back(lifted(entry));
      target.shape_slopes(i, j) = target.shape.back().lowered<2>();
      squares += square(entry.range());
      if (i == j) {
        target.reciprocal.push_back(lifted(OverPhase(1.0) / entry));
      }
    }
    target.row_length.push_back(sqrt(squares).upper());
  }
  target.inverse_slopes = inverse_of(target.shape_slopes);
  return target;
}

}  // namespace veritrack::model

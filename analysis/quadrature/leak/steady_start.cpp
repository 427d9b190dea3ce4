#include "analysis/quadrature/leak/steady_start.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "analysis/quadrature/capture/capture.hpp"
#include "analysis/quadrature/capture/capture_starts.hpp"
#include "analysis/quadrature/leak/steady_target.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/definiteness.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;

IntervalMatrix<3> covariance_of(const IntervalVector<sets::QuadraturePolarLoop::kStates>& x) {
  IntervalMatrix<3> p;
  p << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
  return p;
}

/// As SteadyStart, over a part of the frequencies of a cell.
SteadyStart start_of(const sets::ContractionQuestion& question, const sets::BranchCell& cell,
                     const Interval& part, const SteadySet& set) {
  const IntervalVector<sets::QuadraturePolarLoop::kStates> steady = cell.at(part);
  const StartBox starts = assumed_starts(question);
  IntervalVector<3> error;
  error << starts.amplitude_error, starts.phase_error, starts.frequency_error;
  SteadyStart result;
  std::optional<double> covariance;
  if (question.start_covariance) {
    const IntervalMatrix<3> p = covariance_of(steady);
    covariance = covariance_level(IntervalMatrix<3>(question.start_covariance->lower_end() - p),
                                  IntervalMatrix<3>(question.start_covariance->upper_end() - p), set);
  }
  const Interval norm = metric_norm(set, IntervalVector<3>(error - steady.head<3>()));
  if (covariance && is_finite(norm)) {
    result.level = std::max(norm.upper(), *covariance);
    result.reached = *result.level <= 1.0;
    result.level_when_reached = *result.level;
    result.frequency_error = magnitude(starts.frequency_error);
  }
  return result;
}

/// Follows the starts of a part of the frequencies of a cell, for at most so many samples.
SteadyStart follow_part(const sets::ContractionQuestion& question, const sets::BranchCell& cell,
                        const Interval& part, const SteadySet& set, int most_samples) {
  SteadyStart result = start_of(question, cell, part, set);
  if (result.reached || !(question.slew == Interval(0.0)) || !question.start_covariance) {
    return result;
  }
  const IntervalMatrix<3> covariance = question.start_covariance->enclosure();
  // Beyond the boundary, which gives a smaller bound.
  constexpr double kLevel = 0.5;
  const CaptureProblem problem{question.design,
                               covariance,
                               part,
                               set.noise,
                               0.0,
                               most_samples,
                               {question.amplitude, question.largest_frequency}};
  const CaptureResult found =
      follow_starts(problem, SteadySetTarget(set, cell.at(part), kLevel), assumed_starts(question));
  if (found.outcome == CaptureOutcome::locked) {
    result.reached = true;
    result.samples = found.samples;
    result.level_when_reached = found.level;
    result.frequency_error = *std::max_element(found.frequency_errors.begin(), found.frequency_errors.end());
  }
  return result;
}

/// The start that covers both.
SteadyStart both(const SteadyStart& a, const SteadyStart& b) {
  SteadyStart result;
  if (a.level && b.level) {
    result.level = std::max(*a.level, *b.level);
  }
  result.reached = a.reached && b.reached;
  result.samples = std::max(a.samples, b.samples);
  result.level_when_reached = std::max(a.level_when_reached, b.level_when_reached);
  result.frequency_error = std::max(a.frequency_error, b.frequency_error);
  result.failure = a.failure.empty() ? b.failure : a.failure;
  return result;
}

/// Narrower parts of the frequencies where the whole is too much to follow at once.
SteadyStart follow_cell(const sets::ContractionQuestion& question, const sets::BranchCell& cell,
                        const Interval& part, const SteadySet& set, int halvings) {
  // Narrower parts often come in soon where a wide one never does.
  constexpr int kFewSamples = 30;
  constexpr int kMostSamples = 100;
  SteadyStart whole = follow_part(question, cell, part, set, halvings == 0 ? kMostSamples : kFewSamples);
  if (whole.reached) {
    return whole;
  }
  if (halvings == 0 || !(question.slew == Interval(0.0))) {
    whole.failure = "for frequencies near " + rigor::to_decimal(midpoint(part), 4, rigor::Direction::down) +
                    " rad/sample the starts could not be followed into the set";
    return whole;
  }
  const double middle = midpoint(part);
  const SteadyStart low =
      follow_cell(question, cell, Interval::from_bounds(part.lower(), middle), set, halvings - 1);
  if (!low.reached) {
    return both(whole, low);
  }
  return both(low,
              follow_cell(question, cell, Interval::from_bounds(middle, part.upper()), set, halvings - 1));
}

}  // namespace

std::optional<double> covariance_level(const IntervalMatrix<3>& deviation, const SteadySet& set) {
  return covariance_level(deviation, deviation, set);
}

std::optional<double> covariance_level(const IntervalMatrix<3>& least, const IntervalMatrix<3>& largest,
                                       const SteadySet& set) {
  constexpr int kSteps = 40;
  const IntervalMatrix<3> below = rigor::to_interval(set.below);
  const IntervalMatrix<3> above = rigor::to_interval(set.above);
  const auto level_of = [](int step) { return Interval(step) / Interval(kSteps); };
  const auto is_inside = [&](int step) {
    const Interval level = level_of(step);
    return rigor::is_positive_definite(IntervalMatrix<3>(least + below * level)) == rigor::Verdict::proved &&
           rigor::is_positive_definite(IntervalMatrix<3>(above * level - largest)) == rigor::Verdict::proved;
  };
  if (!is_inside(kSteps)) {
    return std::nullopt;
  }
  // The sets grow with the level.
  int proved = kSteps;
  int failed = 0;
  while (proved - failed > 1) {
    const int middle = (proved + failed) / 2;
    (is_inside(middle) ? proved : failed) = middle;
  }
  return level_of(proved).upper();
}

SteadyStart joined(const std::vector<SteadyStart>& starts) {
  if (starts.empty()) {
    throw std::invalid_argument("there are no frequencies to start at");
  }
  return std::accumulate(starts.begin() + 1, starts.end(), starts.front(), both);
}

std::vector<SteadyStart> follow_to_steady_set(const sets::ContractionQuestion& question,
                                              const std::vector<sets::BranchCell>& cells,
                                              const SteadySet& set) {
  constexpr int kHalvings = 2;
  // In blocks, so that a failure is found early, and the same one whatever the number of threads.
  constexpr std::size_t kBlock = 4;
  std::vector<SteadyStart> starts;
  starts.reserve(cells.size());
  bool reached = true;
  while (reached && starts.size() < cells.size()) {
    const std::size_t begin = starts.size();
    starts.resize(std::min(begin + kBlock, cells.size()));
    tbb::parallel_for(begin, starts.size(), [&](std::size_t i) {
      const rigor::UpwardRounding upward;
      starts[i] = follow_cell(question, cells[i], cells[i].parameter, set, kHalvings);
    });
    reached = std::all_of(starts.begin(), starts.end(), [](const SteadyStart& s) { return s.reached; });
  }
  return starts;
}

}  // namespace veritrack::quadrature

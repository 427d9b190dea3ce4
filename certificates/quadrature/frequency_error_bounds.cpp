#include "certificates/quadrature/frequency_error_bounds.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/quadrature/capture/capture_starts.hpp"
#include "analysis/quadrature/contraction/certified_level.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::certificates {

namespace {

using quadrature::CertifiedSet;
using rigor::Interval;
using PolarState = trackers::PolarFrameState<double>;
using Input = trackers::PolarInput<double>;

constexpr std::size_t kShortest = 30;
constexpr std::size_t kLongestShown = 300;

/// The tracker, its signal, and the admissible disturbances.
struct Loop {
  trackers::ToneModel<double> design;
  double noise = 0.0;
  double slew = 0.0;

  /// After the noise direction and the slew, out of a few, that push the frequency error out the most.
  [[nodiscard]] PolarState pushed(const PolarState& state) const {
    constexpr int kDirections = 16;
    PolarState worst = trackers::polar_frame_map<double>(state, {0.0, 0.0, 0.0, 0.0}, design);
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      for (const double change : {-slew, slew}) {
        const Input input{noise * std::cos(angle), noise * std::sin(angle), change, 0.0};
        const PolarState next = trackers::polar_frame_map<double>(state, input, design);
        worst = std::fabs(next.error.frequency) > std::fabs(worst.error.frequency) ? next : worst;
      }
    }
    return worst;
  }

  [[nodiscard]] std::vector<double> run(PolarState state, bool disturbed, std::size_t samples) const {
    std::vector<double> errors;
    errors.reserve(samples);
    while (errors.size() < samples) {
      errors.push_back(std::fabs(state.error.frequency));
      state =
          disturbed ? pushed(state) : trackers::polar_frame_map<double>(state, {0.0, 0.0, 0.0, 0.0}, design);
    }
    return errors;
  }
};

PolarState state_of(const rigor::Vector<3>& error, const rigor::Matrix<3>& covariance) {
  return {{error[0], error[1], error[2]}, trackers::PolarCovariance<double>::from_matrix(covariance)};
}

/// Starts where |T e| = R and one of the errors is as large as possible, with the covariance at either end.
std::vector<PolarState> rim_of_set(const CertifiedSet& set) {
  const rigor::Matrix<3> inverse = set.metric.inverse();
  std::vector<PolarState> starts;
  for (int i = 0; i < 3; ++i) {
    const rigor::Vector<3> error = set.radius * (inverse * inverse.row(i).transpose().normalized());
    starts.push_back(state_of(error, set.covariance_lower));
    starts.push_back(state_of(error, set.covariance_upper));
  }
  return starts;
}

/// The corners of the assumed starts, as far as they are not each other's mirror images.
std::vector<PolarState> corners(const quadrature::StartBox& box, const rigor::Matrix<3>& covariance) {
  std::vector<PolarState> starts;
  for (const double amplitude : {box.amplitude_error.lower(), box.amplitude_error.upper()}) {
    for (const double phase : {box.phase_error.lower(), box.phase_error.upper()}) {
      starts.push_back(state_of({amplitude, phase, box.frequency_error.upper()}, covariance));
    }
  }
  return starts;
}

/// Until it is within twice the bound of the long run, within reason.
std::vector<double> bound_from(quadrature::CertifiedLevel level) {
  std::vector<double> bound;
  const double settled = 2.0 * level.ultimate_frequency_error();
  while (bound.size() < kLongestShown &&
         !(bound.size() >= kShortest && settled > 0.0 && level.settled(settled))) {
    bound.push_back(level.frequency_error());
    level.step();
  }
  return bound;
}

}  // namespace

std::optional<FrequencyErrorBounds> frequency_error_bounds(const Certificate& certificate) {
  const auto named = std::find_if(quadrature_particulars(certificate).certified_sets.begin(),
                                  quadrature_particulars(certificate).certified_sets.end(),
                                  [](const NamedSet& one) { return one.purpose == "start-error"; });
  const std::optional<Interval> bound = proved_frequency_bound(certificate);
  if (named == quadrature_particulars(certificate).certified_sets.end() || !bound) {
    return std::nullopt;
  }
  FrequencyErrorBounds tube;
  std::vector<PolarState> starts;
  Loop loop;
  {
    const rigor::UpwardRounding upward;
    const sets::ContractionQuestion question = contraction_question(certificate.design);
    loop.design = {midpoint(question.design.q1), midpoint(question.design.q2), midpoint(question.design.r),
                   0.0};
    loop.noise = midpoint(question.noise);
    loop.slew = midpoint(question.slew);
    tube.from_assumed_starts = quadrature_particulars(certificate).followed_starts.has_value();
    if (tube.from_assumed_starts) {
      const auto problem = quadrature::capture_problem(question);
      if (!problem) {
        return std::nullopt;
      }
      tube.bound = quadrature_particulars(certificate).followed_starts->frequency_errors;
      tube.bound.resize(std::min(tube.bound.size(), kLongestShown));
      starts = corners(quadrature::assumed_starts(question), rigor::midpoint(problem->initial_covariance));
    } else {
      tube.bound = bound_from(
          quadrature::CertifiedLevel(named->set, Interval(named->set.radius), question.noise, question.slew));
      tube.bound_of_assumed_starts.assign(tube.bound.size(), bound->upper());
    }
  }
  const rigor::NearestRounding nearest;
  if (!tube.from_assumed_starts) {
    starts = rim_of_set(named->set);
  }
  for (const PolarState& start : starts) {
    for (const bool disturbed : {false, true}) {
      tube.runs.push_back(loop.run(start, disturbed, tube.bound.size()));
    }
  }
  return tube;
}

}  // namespace veritrack::certificates

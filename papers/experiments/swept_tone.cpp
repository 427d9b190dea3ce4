#include "papers/experiments/swept_tone.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "analysis/search/maximize.hpp"
#include "papers/experiments/repeated_runs.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::experiments {

namespace {

constexpr double kLargestSlew = 0.04;  // rad/sample per sample
constexpr double kCloseError = -0.01;  // rad/sample
constexpr double kLargestPart = 0.2;   // of the frequency
constexpr double kDiverged = std::numeric_limits<double>::infinity();

/// `visit` receives the estimate at every sample.
template <typename Visit>
void run_tracker(const ToneRun& run, const trackers::ToneModel<double>& design, double start_variance,
                 const Visit& visit) {
  const Eigen::Vector3d diagonal = start_variance > 0.0 ? Eigen::Vector3d::Constant(start_variance)
                                                        : Eigen::Vector3d(design.q1, design.q1, design.q2);
  trackers::QuadratureEkf<double> tracker(
      design, {1.0, 0.0, run.start,
               trackers::FactoredCovariance<double>::from_matrix(Eigen::Matrix3d(diagonal.asDiagonal()))});
  for (std::size_t k = 0; k < run.frequency.size(); ++k) {
    if (k > 0) {
      tracker.time_update();
    }
    tracker.measurement_update(run.in_phase[k], run.quadrature[k]);
    visit(k, tracker.filtered().frequency);
  }
}

template <typename Filter, typename Step>
double notch_errors(const ToneRun& run, Filter notch, const Step& step) {
  double sum = 0.0;
  for (std::size_t k = 0; k < run.frequency.size(); ++k) {
    step(notch, run.in_phase[k], run.quadrature[k]);
    sum += (notch.frequency() - run.frequency[k]) * (notch.frequency() - run.frequency[k]);
  }
  if (!std::isfinite(sum)) {
    return kDiverged;
  }
  return sum;
}

/// The best point of local searches from these starts.
Eigen::VectorXd best_of(const std::vector<Eigen::Vector3d>& starts, search::SearchSpace space,
                        const std::function<double(const Eigen::VectorXd&)>& objective) {
  constexpr int kEvaluations = 120;
  space.evaluations = kEvaluations;
  search::BestPoint best{{}, -kDiverged};
  for (const Eigen::Vector3d& start : starts) {
    space.start = start;
    const search::BestPoint found = search::maximize(objective, space);
    if (best.point.size() == 0 || found.value > best.value) {
      best = found;
    }
  }
  return best.point;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double logistic(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

trackers::ToneModel<double> tracker_at(const Eigen::VectorXd& point) {
  const double q = std::exp(point(0));
  return {q, q, std::exp(point(2)), logistic(point(1))};
}

trackers::NotchDesign<double> notch_at(const Eigen::VectorXd& point) {
  return {logistic(point(0)), std::exp(point(1)), point(2)};
}

}  // namespace

std::vector<double> frequencies_of(const SweptTone& tone) {
  const double length = tone.samples;
  const double slow_slew = std::min(2.0 * tone.slow_rise / length, 0.5 * kLargestSlew);
  const double fast_start = std::floor(tone.fast_place * length);
  std::vector<double> frequencies;
  frequencies.reserve(static_cast<std::size_t>(tone.samples));
  double current = tone.start;
  for (int k = 0; k < tone.samples; ++k) {
    frequencies.push_back(current);
    const double time = k + 0.5;
    current +=
        slow_slew * trackers::detail::raised_cosine(time / length) +
        (kLargestSlew - slow_slew) * trackers::detail::raised_cosine((time - fast_start) / tone.fast_samples);
  }
  return frequencies;
}

ToneRun tone_run(const SweptToneExperiment& experiment, std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  trackers::RandomStream random(seed);
  ToneRun run;
  run.frequency = frequencies_of(experiment.tone);
  const double drawn = 2.0 * random.uniform() - 1.0;
  run.start = experiment.start == FrequencyStart::close
                  ? run.frequency.front() + kCloseError
                  : run.frequency.front() * (1.0 + kLargestPart * drawn);
  const double deviation = std::sqrt(experiment.noise_variance);
  run.in_phase.reserve(run.frequency.size());
  run.quadrature.reserve(run.frequency.size());
  double phase = 0.0;
  for (const double frequency : run.frequency) {
    const auto [cosine, sine] = trackers::unit_phasor(phase);
    run.in_phase.push_back(cosine + deviation * random.normal());
    run.quadrature.push_back(sine + deviation * random.normal());
    phase = trackers::wrapped(phase + frequency);
  }
  return run;
}

std::vector<ToneRun> tone_runs(const SweptToneExperiment& experiment, int runs) {
  return repeat(runs, [&](std::uint64_t seed) { return tone_run(experiment, seed); });
}

std::vector<double> tracked(const ToneRun& run, const trackers::ToneModel<double>& design,
                            double start_variance) {
  const rigor::NearestRounding nearest;
  std::vector<double> estimates;
  estimates.reserve(run.frequency.size());
  run_tracker(run, design, start_variance,
              [&](std::size_t /*k*/, double estimate) { estimates.push_back(estimate); });
  return estimates;
}

std::vector<double> squared_errors(const std::vector<ToneRun>& runs,
                                   const trackers::ToneModel<double>& design, double start_variance) {
  return repeat(static_cast<int>(runs.size()), [&](std::uint64_t seed) {
    const ToneRun& run = runs[seed - 1];
    double sum = 0.0;
    run_tracker(run, design, start_variance, [&](std::size_t k, double estimate) {
      sum += (estimate - run.frequency[k]) * (estimate - run.frequency[k]);
    });
    return sum;
  });
}

std::vector<double> squared_errors(const std::vector<ToneRun>& runs, NotchInput input,
                                   const trackers::NotchDesign<double>& design) {
  return repeat(static_cast<int>(runs.size()), [&](std::uint64_t seed) {
    const ToneRun& run = runs[seed - 1];
    return input == NotchInput::quadrature
               ? notch_errors(run, trackers::QuadratureNotch<double>(design, run.start),
                              [](auto& notch, double in_phase, double quadrature) {
                                notch.step(in_phase, quadrature);
                              })
               : notch_errors(
                     run, trackers::RealNotch<double>(design, run.start),
                     [](auto& notch, double in_phase, double /*quadrature*/) { notch.step(in_phase); });
  });
}

trackers::ToneModel<double> best_tracker(const std::vector<ToneRun>& runs, double noise_variance,
                                         double start_variance) {
  search::SearchSpace space;
  space.step = Eigen::Vector3d(0.7, 1.5, 0.7);
  space.lower = Eigen::Vector3d(-14.0, -20.0, -10.0);
  space.upper = Eigen::Vector3d(0.0, 0.0, 5.0);
  const double start_r = std::log(5.0 * noise_variance);
  return tracker_at(best_of({Eigen::Vector3d(-6.0, -4.6, start_r), Eigen::Vector3d(-7.5, -12.0, start_r)},
                            space, [&](const Eigen::VectorXd& point) {
                              return -mean_of(squared_errors(runs, tracker_at(point), start_variance));
                            }));
}

trackers::NotchDesign<double> best_notch(const std::vector<ToneRun>& runs, NotchInput input) {
  search::SearchSpace space;
  space.step = Eigen::Vector3d(0.5, 0.5, 0.3);
  space.lower = Eigen::Vector3d(-3.0, -12.0, 1.0);
  space.upper = Eigen::Vector3d(6.0, 2.0, 4.0);
  return notch_at(best_of(
      {Eigen::Vector3d(1.4, -3.0, 2.0), Eigen::Vector3d(1.4, -4.0, 3.0)}, space,
      [&](const Eigen::VectorXd& point) { return -mean_of(squared_errors(runs, input, notch_at(point))); }));
}

}  // namespace veritrack::experiments

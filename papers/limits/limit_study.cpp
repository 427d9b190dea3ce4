#include "papers/limits/limit_study.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "analysis/rigor/rounding.hpp"
#include "papers/limits/posterior_bound.hpp"

namespace veritrack::limits {

namespace {

constexpr std::array<Channels, 2> kBoth{Channels::quadrature, Channels::single};

/// Experiments, as they are done.
class Counter {
 public:
  Counter(const StudyProgress& progress, int most) : progress_(progress), most_(most) {}
  void tell() {
    ++done_;
    if (progress_) {
      progress_(done_, most_);
    }
  }

 private:
  const StudyProgress& progress_;
  int done_ = 0;
  int most_;
};

LimitPoint random_walk_point(const RandomWalkSeries& series, double decibels, int runs) {
  TrackingExperiment experiment;
  experiment.model.channels = series.channels;
  experiment.model.noise_variance = noise_variance_of(decibels);
  experiment.model.walk_variance = series.walk_variance;
  experiment.tracker_q1 = series.q1_share * series.walk_variance;
  experiment.tracker_q2 = series.walk_variance;
  experiment.samples = kRandomWalkSamples;
  experiment.first_sample = kRandomWalkSamples / 2 + 1;
  experiment.runs = runs;
  const TrackingErrors errors = simulate_tracking(experiment);
  const std::vector<double> bounds = posterior_frequency_bounds(experiment.model, experiment.samples);
  const double bound = std::accumulate(bounds.begin() + experiment.first_sample - 1, bounds.end(), 0.0) /
                       (experiment.samples - experiment.first_sample + 1);
  return {decibels, bound, errors.window_mean, errors.standard_error, errors.lost};
}

/// After the first `samples` of a run, at the last of them only.
LimitPoint constant_point(Channels channels, double decibels, int samples, int runs) {
  TrackingExperiment experiment;
  experiment.model = constant_frequency_model(channels, decibels);
  experiment.tracker_q2 = kNearlyZeroQ2;
  experiment.samples = samples;
  experiment.first_sample = samples;
  experiment.runs = runs;
  const TrackingErrors errors = simulate_tracking(experiment);
  return {decibels, posterior_frequency_bounds(experiment.model, samples).back(), errors.window_mean,
          errors.standard_error, errors.lost};
}

}  // namespace

double decibels_above_bound(const LimitPoint& point) {
  const rigor::NearestRounding nearest;
  return 10.0 * std::log10(point.error / point.bound);
}

Nearness nearness_of(const LimitPoint& point) {
  const rigor::NearestRounding nearest;
  const double allowed = point.bound * std::pow(10.0, 0.1 * kNearBound);
  const double reserve = kStandardErrors * point.standard_error;
  if (point.error + reserve <= allowed) {
    return Nearness::near;
  }
  // A value that is not a number is not near, and a single run decides nothing.
  return point.error - reserve > allowed || std::isnan(point.error) ? Nearness::far : Nearness::undecided;
}

Threshold threshold_of(const std::vector<LimitPoint>& points) {
  Threshold threshold;
  bool all_near = true;
  for (auto point = points.rbegin(); point != points.rend(); ++point) {
    const Nearness nearness = nearness_of(*point);
    if (nearness == Nearness::far) {
      break;
    }
    all_near = all_near && nearness == Nearness::near;
    threshold.at_least = point->decibels;
    if (all_near) {
      threshold.at_most = point->decibels;
    }
  }
  return threshold;
}

std::vector<double> studied_decibels() {
  return {0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0, 24.0, 27.0, 30.0};
}

std::vector<RandomWalkSeries> study_random_walks(int runs, const StudyProgress& progress) {
  std::vector<RandomWalkSeries> study;
  Counter counter(progress, static_cast<int>(4 * kWalkVariances.size() * studied_decibels().size()));
  for (const Channels channels : kBoth) {
    for (const double walk_variance : kWalkVariances) {
      for (const double q1_share : {0.0, kSomeQ1}) {
        RandomWalkSeries series{channels, walk_variance, q1_share, {}};
        for (const double decibels : studied_decibels()) {
          series.points.push_back(random_walk_point(series, decibels, runs));
          counter.tell();
        }
        study.push_back(std::move(series));
      }
    }
  }
  return study;
}

std::vector<ConstantSeries> study_constant_frequency(int runs, const StudyProgress& progress) {
  std::vector<ConstantSeries> study;
  Counter counter(progress, static_cast<int>(2 * studied_decibels().size()));
  for (const Channels channels : kBoth) {
    ConstantSeries series{channels, {}, {}};
    for (const double decibels : studied_decibels()) {
      series.early.push_back(constant_point(channels, decibels, kEarlySample, runs));
      series.late.push_back(constant_point(channels, decibels, kLateSample, runs));
      counter.tell();
    }
    study.push_back(std::move(series));
  }
  return study;
}

std::vector<ErrorOverTime> study_errors_over_time(int runs, const StudyProgress& progress) {
  std::vector<ErrorOverTime> study;
  Counter counter(progress, 8);
  for (const Channels channels : kBoth) {
    for (const double tracker_q2 : {kNearlyZeroQ2, 1e-10, 1e-8, 1e-6}) {
      TrackingExperiment experiment;
      experiment.model = constant_frequency_model(channels, kOverTimeDecibels);
      experiment.tracker_q2 = tracker_q2;
      experiment.samples = kLateSample;
      experiment.first_sample = kLateSample;
      experiment.runs = runs;
      const TrackingErrors errors = simulate_tracking(experiment);
      study.push_back({channels, tracker_q2, errors.mean_square, errors.standard_error});
      counter.tell();
    }
  }
  return study;
}

TrackingModel constant_frequency_model(Channels channels, double decibels) {
  TrackingModel model;
  model.channels = channels;
  model.noise_variance = noise_variance_of(decibels);
  model.drawn = DrawnAtStart::start;
  return model;
}

}  // namespace veritrack::limits

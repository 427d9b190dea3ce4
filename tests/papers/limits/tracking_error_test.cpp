#include "papers/limits/tracking_error.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <numeric>
#include <stdexcept>

#include "papers/limits/posterior_bound.hpp"

namespace veritrack::limits {
namespace {

TrackingExperiment random_walk_at(Channels channels, double decibels) {
  TrackingExperiment experiment;
  experiment.model.channels = channels;
  experiment.model.noise_variance = noise_variance_of(decibels);
  experiment.model.walk_variance = 1e-6;
  experiment.tracker_q2 = 1e-6;
  experiment.runs = 300;
  return experiment;
}

double bound_over_window(const TrackingExperiment& experiment) {
  const std::vector<double> bounds = posterior_frequency_bounds(experiment.model, experiment.samples);
  return std::accumulate(bounds.begin() + experiment.first_sample - 1, bounds.end(), 0.0) /
         (experiment.samples - experiment.first_sample + 1);
}

TEST_CASE("with a small error, where the problem is nearly linear, the trackers meet the bound") {
  for (const Channels channels : {Channels::quadrature, Channels::single}) {
    const TrackingExperiment experiment = random_walk_at(channels, 20.0);
    const TrackingErrors errors = simulate_tracking(experiment);
    const double bound = bound_over_window(experiment);
    CHECK(errors.lost == 0.0);
    CHECK(errors.window_mean < 1.1 * bound);
    CHECK(errors.window_mean > bound - 4.0 * errors.standard_error);
    CHECK(errors.standard_error < 0.05 * bound);
  }
}

TEST_CASE("a tracker without hope is lost, and says so") {
  TrackingExperiment experiment = random_walk_at(Channels::single, -20.0);
  experiment.model.walk_variance = 1e-3;
  experiment.tracker_q2 = 1e-3;
  experiment.runs = 100;
  const TrackingErrors errors = simulate_tracking(experiment);
  CHECK(errors.lost > 0.5);
  CHECK(errors.window_mean > kLockThreshold * kLockThreshold * errors.lost / 2.0);
}

TEST_CASE("the same numbers whatever the number of threads; the window is that of the samples asked for") {
  TrackingExperiment experiment = random_walk_at(Channels::single, 5.0);
  experiment.runs = 47;
  const TrackingErrors many = simulate_tracking(experiment);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TrackingErrors one = simulate_tracking(experiment);
  CHECK(one.mean_square == many.mean_square);
  CHECK(one.standard_error == many.standard_error);
  CHECK(one.window_mean ==
        doctest::Approx(std::accumulate(one.mean_square.begin() + 100, one.mean_square.end(), 0.0) / 100.0));
}

TEST_CASE("an experiment that makes no sense is refused") {
  TrackingExperiment experiment;
  experiment.runs = 0;
  CHECK_THROWS_AS((void)simulate_tracking(experiment), std::invalid_argument);
  experiment.runs = 1;
  experiment.first_sample = experiment.samples + 1;
  CHECK_THROWS_AS((void)simulate_tracking(experiment), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::limits

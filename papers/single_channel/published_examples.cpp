#include "papers/single_channel/published_examples.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "trackers/signals/phasor.hpp"
#include "trackers/signals/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::single_channel {

namespace {

constexpr double kLow = std::numbers::pi / 6.0;
constexpr double kHigh = 2.0 * std::numbers::pi / 3.0;
constexpr std::size_t kSamples = 1000;
constexpr std::size_t kWindow = 100;

double frequency_at(Example example, std::size_t t) {
  if (example == Example::two) {
    return t <= 500 ? kLow : kHigh;
  }
  if (t <= 300) {
    return kLow;
  }
  return t > 700 ? kHigh : kLow + (kHigh - kLow) * static_cast<double>(t - 300) / 400.0;
}

WindowSummary summarize(const ExampleRun& run, std::size_t end) {
  WindowSummary summary;
  if (run.frequency.size() < end) {
    return summary;
  }
  double mean = 0.0;
  for (std::size_t i = end - kWindow; i < end; ++i) {
    mean += run.frequency[i] / kWindow;
  }
  double square = 0.0;
  for (std::size_t i = end - kWindow; i < end; ++i) {
    square += (run.frequency[i] - mean) * (run.frequency[i] - mean) / kWindow;
  }
  summary.mean_error = mean - run.true_frequency[end - 1];
  summary.deviation = std::sqrt(square);
  const bool steady = summary.deviation < 0.5;
  summary.locked = steady && std::fabs(summary.mean_error) < 0.35;
  summary.near_zero = steady && std::fabs(mean) < 0.1;
  return summary;
}

using Tracker = trackers::SingleChannelEkf<double>;
using Estimate = trackers::SingleChannelEstimate<double>;

/// The recursion as printed. F(t) enters the covariance alone: what it predicts from the estimate one sample
/// earlier, with the covariance of now, is P(t+1); the state is predicted from the estimate of now.
class PrintedTracker {
 public:
  PrintedTracker(const trackers::SingleChannelEkfDesign<double>& design, const Estimate& start)
      : design_(design), before_(start), filtered_(start) {}

  void step(double measurement) {
    Estimate late = before_;
    late.covariance = filtered_.covariance;
    Estimate predicted = trackers::time_update(filtered_, design_);
    predicted.covariance = trackers::time_update(late, design_).covariance;
    before_ = filtered_;
    filtered_ = trackers::measurement_update(predicted, measurement, design_);
  }
  [[nodiscard]] const Estimate& filtered() const { return filtered_; }

 private:
  trackers::SingleChannelEkfDesign<double> design_;
  Estimate before_;  ///< x(t-1|t-1); at the start the start itself
  Estimate filtered_;
};

/// The share of seeds for which `holds` of the run's summary.
template <typename Predicate>
double share(const std::vector<RunSummary>& runs, const Predicate& holds) {
  std::size_t count = 0;
  for (const RunSummary& run : runs) {
    count += holds(run) ? 1U : 0U;
  }
  return static_cast<double>(count) / static_cast<double>(runs.size());
}

}  // namespace

std::vector<ExampleStart> example_starts() {
  return {{"x = (0, 0, 0), P = I", 0.0, 0.0, 0.0, 1.0},
          {"x = (1, 0, 0.1), P = I", 1.0, 0.0, 0.1, 1.0},
          {"x = (0, 0, π/2), P = I", 0.0, 0.0, 0.5 * std::numbers::pi, 1.0},
          {"x = (1, 0, π/6), P = I", 1.0, 0.0, kLow, 1.0},
          {"x = (1, 0, π/6), P = 0.01 I", 1.0, 0.0, kLow, 0.01}};
}

namespace {

template <typename AnyTracker>
ExampleRun run_with(AnyTracker tracker, const ExampleSetting& setting, std::uint64_t seed) {
  trackers::RandomStream random(seed);
  ExampleRun run;
  double phase = 0.0;
  for (std::size_t t = 1; t <= kSamples; ++t) {
    const double frequency = frequency_at(setting.example, t);
    phase = trackers::wrapped(phase + frequency);
    constexpr double kDeviation = 0.1;
    try {
      tracker.step(trackers::unit_phasor(phase).first + kDeviation * random.normal());
    } catch (const trackers::ZeroInnovationVariance&) {
      run.completed = false;
      return run;
    }
    run.true_frequency.push_back(frequency);
    run.frequency.push_back(tracker.filtered().frequency);
    run.quadrature.push_back(tracker.filtered().quadrature);
  }
  return run;
}

}  // namespace

ExampleRun run_example(const ExampleSetting& setting, std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  const auto process_noise = setting.reading == ProcessNoiseReading::identity
                                 ? trackers::identity_process_noise(setting.q)
                                 : trackers::frequency_only_process_noise(setting.q);
  const ExampleStart& start = setting.start;
  const trackers::SingleChannelEkfDesign<double> design{process_noise, setting.r, setting.epsilon};
  const Estimate from{start.in_phase, start.quadrature, start.frequency,
                      trackers::identity_process_noise(start.variance)};
  return setting.linearization == LinearizationPoint::as_printed
             ? run_with(PrintedTracker(design, from), setting, seed)
             : run_with(Tracker(design, from), setting, seed);
}

std::vector<RunSummary> summarize_runs(const ExampleSetting& setting, int seeds) {
  std::vector<RunSummary> summaries(static_cast<std::size_t>(seeds));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, summaries.size()), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const ExampleRun run = run_example(setting, i + 1);
      summaries[i] = {summarize(run, setting.example == Example::one ? 300 : 500), summarize(run, kSamples)};
    }
  });
  return summaries;
}

int locked_runs(ProcessNoiseReading reading, double epsilon, const ExampleStart& start,
                LinearizationPoint linearization, int seeds) {
  const auto runs =
      summarize_runs({Example::one, reading, 0.005, 0.01, epsilon, start, linearization}, seeds);
  return static_cast<int>(std::count_if(
      runs.begin(), runs.end(), [](const RunSummary& run) { return run.first.locked && run.last.locked; }));
}

std::vector<StatementRate> statement_rates(ProcessNoiseReading reading, const ExampleStart& start,
                                           int seeds) {
  const auto example_1 = [&](double epsilon) {
    return summarize_runs({Example::one, reading, 0.005, 0.01, epsilon, start}, seeds);
  };
  const auto example_2 = [&](double lambda) {
    return summarize_runs({Example::two, reading, 1.0, lambda, 0.0, start}, seeds);
  };
  const auto both_locked = [](const RunSummary& run) { return run.first.locked && run.last.locked; };
  const std::vector<RunSummary> leaking = example_1(0.05);
  const std::vector<RunSummary> unbiased = example_1(0.0);
  const std::vector<RunSummary> zero = example_2(0.0);
  const std::vector<RunSummary> one = example_2(1.0);
  const std::vector<RunSummary> ten = example_2(10.0);
  std::size_t ordered = 0;
  for (std::size_t i = 0; i < zero.size(); ++i) {
    const bool locked = zero[i].first.locked && one[i].first.locked && ten[i].first.locked;
    ordered += locked && zero[i].first.deviation > one[i].first.deviation &&
                       one[i].first.deviation > ten[i].first.deviation
                   ? 1U
                   : 0U;
  }
  return {
      {"Example 1, ε = 0.05: locks at both frequencies", share(leaking, both_locked)},
      {"Example 1, ε = 0.05: estimates too low by more than 0.03 rad/sample, and lower still at the higher "
       "frequency",
       share(leaking,
             [&](const RunSummary& run) {
               return both_locked(run) && run.first.mean_error < -0.03 &&
                      run.last.mean_error < run.first.mean_error;
             })},
      {"Example 1, ε = 0: locks at both frequencies, with mean errors below 0.03 rad/sample",
       share(unbiased,
             [&](const RunSummary& run) {
               return both_locked(run) && std::fabs(run.first.mean_error) < 0.03 &&
                      std::fabs(run.last.mean_error) < 0.03;
             })},
      {"Example 2, λ = 0: locks before and after the jump", share(zero, both_locked)},
      {"Example 2, λ = 1: locks before and after the jump", share(one, both_locked)},
      {"Example 2, λ = 10: locks before the jump and is lost after it",
       share(ten, [](const RunSummary& run) { return run.first.locked && !run.last.locked; })},
      {"Example 2: before the jump the estimate fluctuates less for λ = 1 than for 0, and less for 10 than "
       "for 1",
       static_cast<double>(ordered) / static_cast<double>(seeds)}};
}

}  // namespace veritrack::single_channel

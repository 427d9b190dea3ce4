// The KKL observer: one step, the enclosure of ell (wanted: 2 ms at most), and bounds on the error under a
// disturbance.
#include <benchmark/benchmark.h>

#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;

kkl_observer::KklRange range(double low, double high) {
  return {rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0)), Interval::from_bounds(low, high)};
}

void step_and_estimate(benchmark::State& state) {
  trackers::KklObserver<double> observer({Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), 3e-4}, 1e-3);
  double y = 0.0;
  for (auto _ : state) {
    observer.step_interpolated(y, y + 1e-3);
    y += 1e-3;
    benchmark::DoNotOptimize(observer.estimate());
  }
}
BENCHMARK(step_and_estimate);

void enclose_ell(benchmark::State& state) {
  const kkl_observer::KklRange over = range(1.0, static_cast<double>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(kkl_observer::enclose_ell(over));
  }
}
BENCHMARK(enclose_ell)->Arg(5)->Arg(1000)->Unit(benchmark::kMillisecond);

void bound_errors(benchmark::State& state) {
  kkl_observer::KklRobustnessQuestion question;
  question.range = range(2.0, 4.0);
  question.amplitude = Interval(2.0);
  question.ell = Interval(3e-4);
  question.disturbance = kkl_observer::SinusoidalDisturbance{Interval(0.2), Interval(100.0)};
  for (auto _ : state) {
    benchmark::DoNotOptimize(kkl_observer::bound_kkl_errors(question));
  }
}
BENCHMARK(bound_errors)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

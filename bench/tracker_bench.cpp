// One sample of the quadrature tracker: double against the textbook's matrices, and over intervals and duals.
//
// The counter double_steps is the cost of a step in double steps, measured in the same run. The aim is at
// least 1.5 for the textbook version and at most 40 for intervals. The counter of_lanes of a batch is its
// throughput in single trackers over the same scalar, divided by the number of lanes; the aim is 0.9. Every
// tracker processes the same 1024 measurements of a locked signal, so that each step depends on the one
// before, as in use.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <vector>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "bench/lanes/map_lanes.hpp"
#include "tests/trackers/textbook_ekf.hpp"
#include "trackers/quadrature/batch/quadrature_batch.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/test_signals.hpp"

namespace {

using veritrack::rigor::Interval;
using namespace veritrack::trackers;

constexpr double kFrequency = 0.3;

const std::vector<Sample>& signal() {
  static const std::vector<Sample> samples = make_signal(
      "constant",
      {.samples = 1024, .frequency_low = kFrequency, .frequency_high = kFrequency, .noise_bound = 0.1});
  return samples;
}

/// The design of Table 3.2, Figure 3.5.
template <typename Scalar>
ToneModel<Scalar> design() {
  return {Scalar(0.0023), Scalar(0.0023), Scalar(0.05), Scalar(0.01)};
}

template <typename Scalar>
QuadratureEstimate<Scalar> start() {
  const Scalar zero(0.0);
  const Scalar variance = Scalar(0.01);
  return {Scalar(1.0), zero, Scalar(kFrequency), {variance, zero, variance, zero, zero, variance}};
}

/// Processor time of `run`, in seconds.
template <typename Run>
double processor_time(const Run& run) {
  const std::clock_t begin = std::clock();
  run();
  return static_cast<double>(std::clock() - begin) / static_cast<double>(CLOCKS_PER_SEC);
}

/// The samples over `Scalar`, in-phase and quadrature part one after the other.
template <typename Scalar>
const std::vector<Scalar>& pairs() {
  static const std::vector<Scalar> samples = [] {
    std::vector<Scalar> all;
    for (const Sample& sample : signal()) {
      all.insert(all.end(), {static_cast<Scalar>(sample.in_phase), static_cast<Scalar>(sample.quadrature)});
    }
    return all;
  }();
  return samples;
}

template <typename Scalar>
void run_single(QuadratureEkf<Scalar>& tracker) {
  const std::vector<Scalar>& samples = pairs<Scalar>();
  for (std::size_t k = 0; k < samples.size(); k += 2) {
    tracker.step(samples[k], samples[k + 1]);
  }
  benchmark::DoNotOptimize(tracker.filtered().frequency);
}

/// The shortest time of some runs, in seconds.
template <typename Run>
double shortest(int runs, const Run& run) {
  double result = processor_time(run);
  for (int i = 1; i < runs; ++i) {
    result = std::min(result, processor_time(run));
  }
  return result;
}

/// Seconds of one step over `Scalar`.
template <typename Scalar>
double single_step() {
  static const double seconds = [] {
    const veritrack::rigor::NearestRounding nearest;
    QuadratureEkf<Scalar> tracker(design<Scalar>(), start<Scalar>());
    constexpr int kRuns = 100;
    return shortest(100,
                    [&] {
                      for (int i = 0; i < kRuns; ++i) {
                        run_single(tracker);
                      }
                    }) /
           (kRuns * static_cast<double>(signal().size()));
  }();
  return seconds;
}

/// Times `run`, which processes all samples of the signal, and reports the cost of one sample, also in double
/// steps.
template <typename Run>
void measure(benchmark::State& state, const Run& run, std::size_t trackers = 1) {
  const double seconds = processor_time([&] {
    for (auto _ : state) {
      run();
    }
  });
  const double step =
      seconds / (static_cast<double>(state.iterations()) * static_cast<double>(signal().size() * trackers));
  state.counters["ns_per_step"] = step * 1e9;
  state.counters["double_steps"] = step / single_step<double>();
}

template <typename Scalar>
void step_single(benchmark::State& state) {
  QuadratureEkf<Scalar> tracker(design<Scalar>(), start<Scalar>());
  measure(state, [&] { run_single(tracker); });
}
BENCHMARK(step_single<double>);
BENCHMARK(step_single<float>);

/// 128 trackers side by side, of which the estimates are wanted at the end only.
template <typename Scalar, InstructionSet set>
void step_in_a_batch(benchmark::State& state) {
  if (!has(set)) {
    state.SkipWithError("this processor has no such instructions");
    return;
  }
  constexpr std::size_t kTrackers = 128;
  constexpr std::size_t kBytes = set == InstructionSet::avx512 ? 64 : set == InstructionSet::avx2 ? 32 : 16;
  constexpr std::size_t kLanes = kBytes / sizeof(Scalar);
  QuadratureBatch<Scalar> batch(std::vector(kTrackers, design<Scalar>()),
                                std::vector(kTrackers, start<Scalar>()));
  const auto run = [&] { batch.run({pairs<Scalar>().data(), 0, signal().size()}, {}, set); };
  measure(state, run, kTrackers);
  const double step = shortest(100, run) / static_cast<double>(signal().size() * kTrackers);
  state.counters["of_lanes"] = single_step<Scalar>() / step / kLanes;
}
BENCHMARK(step_in_a_batch<double, InstructionSet::sse2>);
BENCHMARK(step_in_a_batch<double, InstructionSet::avx2>);
BENCHMARK(step_in_a_batch<double, InstructionSet::avx512>);
BENCHMARK(step_in_a_batch<float, InstructionSet::sse2>);
BENCHMARK(step_in_a_batch<float, InstructionSet::avx2>);
BENCHMARK(step_in_a_batch<float, InstructionSet::avx512>);

void step_textbook(benchmark::State& state) {
  const auto d = design<double>();
  const auto s = start<double>();
  veritrack::test::TextbookEkf<double> tracker{d.q1, d.q2, d.r, d.epsilon, s.state(), s.covariance.matrix()};
  measure(state, [&] {
    for (const Sample& sample : signal()) {
      tracker.step({sample.in_phase, sample.quadrature});
    }
    benchmark::DoNotOptimize(tracker.x(2));
  });
}
BENCHMARK(step_textbook);

// Over intervals the boxes of a run would widen, since boxes do not contract. So the step from a box of
// typical width is timed.
void step_interval(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding upward;
  const auto d = design<Interval>();
  QuadratureEstimate<Interval> from = start<Interval>();
  from.frequency = from.frequency + veritrack::rigor::symmetric(1e-6);
  measure(state, [&] {
    for (const Sample& sample : signal()) {
      benchmark::DoNotOptimize(from);
      benchmark::DoNotOptimize(
          step(from, Interval(sample.in_phase), Interval(sample.quadrature), d).filtered);
    }
  });
}
BENCHMARK(step_interval);

template <typename Scalar>
void rotating_frame(benchmark::State& state, const RotatingFrameState<Scalar>& from) {
  const RotatingFrameInput<Scalar> input{Scalar(0.01), Scalar(-0.02), Scalar(0.0), Scalar(kFrequency)};
  const auto d = design<Scalar>();
  RotatingFrameState<Scalar> x = from;
  measure(state, [&] {
    for (std::size_t k = 0; k < signal().size(); ++k) {
      benchmark::DoNotOptimize(x);
      benchmark::DoNotOptimize(rotating_frame_map(x, input, d));
    }
  });
}

RotatingFrameState<double> locked() {
  RotatingFrameState<double> x;
  x << 0.01, -0.02, 0.03, 0.01, 0.001, 0.001, 0.02, 0.01, 0.01;
  return x;
}

template <typename Scalar>
RotatingFrameState<veritrack::rigor::Dual<Scalar, 9>> differentiated() {
  RotatingFrameState<veritrack::rigor::Dual<Scalar, 9>> x;
  for (int i = 0; i < 9; ++i) {
    std::array<Scalar, 9> unit;
    unit.fill(Scalar(0.0));
    unit[static_cast<std::size_t>(i)] = Scalar(1.0);
    x(i) = veritrack::rigor::Dual<Scalar, 9>(Scalar(locked()(i)), unit);
  }
  return x;
}

void map_double(benchmark::State& state) {
  rotating_frame<double>(state, locked());
}
BENCHMARK(map_double);

void map_dual_of_double(benchmark::State& state) {
  rotating_frame<veritrack::rigor::Dual<double, 9>>(state, differentiated<double>());
}
BENCHMARK(map_dual_of_double);

void map_interval(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding upward;
  rotating_frame<Interval>(state, veritrack::rigor::to_interval(locked()));
}
BENCHMARK(map_interval);

void map_dual_of_interval(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding upward;
  rotating_frame<veritrack::rigor::Dual<Interval, 9>>(state, differentiated<Interval>());
}
BENCHMARK(map_dual_of_interval);

/// Several maps side by side; the counters are of one.
template <InstructionSet set, bool over_intervals>
void map_in_lanes(benchmark::State& state) {
  if (!has(set)) {
    state.SkipWithError("this processor has no such instructions");
    return;
  }
  using namespace veritrack::bench;
  constexpr std::size_t kLanes = set == InstructionSet::avx512 ? 8 : set == InstructionSet::avx2 ? 4 : 2;
  constexpr RunMap* kDoubles = set == InstructionSet::avx512 ? run_doubles_avx512
                               : set == InstructionSet::avx2 ? run_doubles_avx2
                                                             : run_doubles_sse2;
  constexpr RunMap* kIntervals = set == InstructionSet::avx512 ? run_intervals_avx512
                                 : set == InstructionSet::avx2 ? run_intervals_avx2
                                                               : run_intervals_sse2;
  const auto d = design<double>();
  MapOperands operands{{}, {0.01, -0.02, 0.0, kFrequency}, {d.q1, d.q2, d.r, d.epsilon}};
  for (int i = 0; i < 9; ++i) {
    operands.state[i] = locked()(i);
  }
  const auto run = [&] {
    benchmark::DoNotOptimize((over_intervals ? kIntervals : kDoubles)(operands, signal().size()));
  };
  if constexpr (over_intervals) {
    const veritrack::rigor::UpwardRounding upward;
    measure(state, run, kLanes);
  } else {
    measure(state, run, kLanes);
  }
}
BENCHMARK(map_in_lanes<InstructionSet::sse2, false>);
BENCHMARK(map_in_lanes<InstructionSet::avx2, false>);
BENCHMARK(map_in_lanes<InstructionSet::avx512, false>);
BENCHMARK(map_in_lanes<InstructionSet::sse2, true>);
BENCHMARK(map_in_lanes<InstructionSet::avx2, true>);
BENCHMARK(map_in_lanes<InstructionSet::avx512, true>);

void normal_deviate(benchmark::State& state) {
  RandomStream random(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(random.normal());
  }
}
BENCHMARK(normal_deviate);

}  // namespace

BENCHMARK_MAIN();

#include "trackers/quadrature/batch/quadrature_batch.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "tests/support/random.hpp"

using namespace veritrack::trackers;
using veritrack::test::Random;

namespace {

constexpr std::size_t kTrackers = 21;  // not a multiple of any number of lanes
constexpr std::size_t kSamples = 400;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Problem {
  std::vector<ToneModel<double>> designs;
  std::vector<QuadratureEstimate<double>> starts;
  std::vector<double> samples;  ///< a row for each
};

Problem random_problem() {
  Random random(77);
  Problem problem;
  for (std::size_t t = 0; t < kTrackers; ++t) {
    problem.designs.push_back({random.uniform(1e-5, 1e-2), random.uniform(1e-5, 1e-2),
                               random.uniform(1e-2, 1.0), t % 2 == 0 ? 0.0 : random.uniform(0.0, 0.02)});
    const double frequency = random.uniform(-3.0, 3.0);
    // Some start far away, where sines are those of the C library: in no other lane, though.
    const double off = t % 5 == 2 ? 100.0 : 0.05;
    problem.starts.push_back({1.0, 0.1, frequency + off, {0.1, 0.01, 0.2, 0.02, -0.01, 0.05}});
    for (std::size_t k = 1; k <= kSamples; ++k) {
      const bool missing = t == 3 && k > 50 && k < 60;
      const double phase = frequency * static_cast<double>(k);
      problem.samples.push_back(missing ? kNone : std::cos(phase) + random.uniform(-0.1, 0.1));
      problem.samples.push_back(std::sin(phase) + random.uniform(-0.1, 0.1));
    }
  }
  return problem;
}

struct Run {
  std::vector<double> state = std::vector<double>(3 * kTrackers * kSamples);
  std::vector<double> deviation = std::vector<double>(kTrackers * kSamples);
  std::vector<double> innovation = std::vector<double>(2 * kTrackers * kSamples);
  std::vector<double> nis = std::vector<double>(kTrackers * kSamples);
  [[nodiscard]] std::vector<std::uint64_t> bits() const {
    std::vector<std::uint64_t> all;
    for (const auto* part : {&state, &deviation, &innovation, &nis}) {
      for (const double number : *part) {
        all.push_back(std::bit_cast<std::uint64_t>(std::isnan(number) ? kNone : number));
      }
    }
    return all;
  }
};

Run run_with(InstructionSet set, const Problem& problem) {
  QuadratureBatch batch(problem.designs, problem.starts);
  Run run;
  batch.run({problem.samples.data(), 2 * kSamples, kSamples},
            {run.state.data(), run.deviation.data(), run.innovation.data(), run.nis.data()}, set);
  return run;
}

}  // namespace

TEST_CASE("every set of instructions that this processor has gives the same bits") {
  const Problem problem = random_problem();
  const Run first = run_with(InstructionSet::sse2, problem);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (has(set)) {
      CHECK(run_with(set, problem).bits() == first.bits());
    } else {
      CHECK_THROWS_AS(run_with(set, problem), std::invalid_argument);
    }
  }
}

TEST_CASE("a batch is its trackers, up to the rounding of sine and cosine") {
  const Problem problem = random_problem();
  const Run run = run_with(widest_instruction_set(), problem);
  double worst = 0.0;
  for (std::size_t t = 0; t < kTrackers; ++t) {
    QuadratureEkf<double> alone(problem.designs[t], problem.starts[t]);
    for (std::size_t k = 0; k < kSamples; ++k) {
      const std::size_t row = t * kSamples + k;
      const double* sample = problem.samples.data() + 2 * row;
      if (std::isnan(sample[0])) {
        alone.time_update();
        alone = QuadratureEkf<double>(alone.design(), alone.predicted());
        CHECK(std::isnan(run.innovation[2 * row + 1]));
        CHECK(std::isnan(run.nis[row]));
      } else {
        alone.step(sample[0], sample[1]);
        worst =
            std::max(worst, std::fabs(run.innovation[2 * row] - (sample[0] - alone.predicted().in_phase)));
      }
      worst = std::max(
          {worst, std::fabs(run.state[3 * row] - alone.filtered().in_phase),
           std::fabs(run.state[3 * row + 1] - alone.filtered().quadrature),
           std::fabs(run.state[3 * row + 2] - alone.filtered().frequency),
           std::fabs(run.deviation[row] - std::sqrt(alone.filtered().covariance.frequency_variance))});
    }
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("a recording in parts and trackers in parts are the whole") {
  const Problem problem = random_problem();
  QuadratureBatch whole(problem.designs, problem.starts);
  QuadratureBatch parts = whole;
  std::vector<double> shared(problem.samples.begin(), problem.samples.begin() + 2 * kSamples);
  whole.run({shared.data(), 0, kSamples}, {});
  for (const auto& [first, last] : {std::pair(8, 16), std::pair(0, 8), std::pair(16, 21)}) {
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(last);
    parts.run({shared.data(), 0, 100}, {}, from, to);
    parts.run({shared.data() + 200, 0, kSamples - 100}, {}, from, to);
  }
  for (std::size_t t = 0; t < kTrackers; ++t) {
    CHECK(whole.filtered(t).frequency == parts.filtered(t).frequency);
    CHECK(whole.filtered(t).covariance.frequency_variance == parts.filtered(t).covariance.frequency_variance);
  }
}

TEST_CASE("parts that would move their neighbours are refused") {
  const Problem problem = random_problem();
  QuadratureBatch batch(problem.designs, problem.starts);
  const BatchSamples samples{problem.samples.data(), 2 * kSamples, kSamples};
  CHECK_THROWS_AS(batch.run(samples, {}, 1, 8), std::invalid_argument);
  CHECK_THROWS_AS(batch.run(samples, {}, 0, 9), std::invalid_argument);
  CHECK_THROWS_AS(batch.run(samples, {}, 0, 24), std::invalid_argument);
  CHECK_THROWS_AS(QuadratureBatch(problem.designs, {}), std::invalid_argument);
}

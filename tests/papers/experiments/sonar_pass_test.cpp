#include "papers/experiments/sonar_pass.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace veritrack::experiments {
namespace {

TEST_CASE("the pass: 10 dB down at both ends, the Doppler shift that was asked for, phases that fit") {
  const auto pass = sonar_pass(1.5);
  REQUIRE(pass.size() == kSonarBlocks);
  CHECK(20.0 * std::log10(pass.front().amplitude) == doctest::Approx(-10.0).epsilon(0.01));
  CHECK(20.0 * std::log10(pass.back().amplitude) == doctest::Approx(-10.0).epsilon(0.01));
  CHECK(pass[kSonarBlocks / 2].amplitude == doctest::Approx(1.0).epsilon(1e-3));
  CHECK(pass.front().offset == doctest::Approx(1.5 * 3.0 / std::sqrt(10.0)).epsilon(0.01));
  CHECK(pass.back().offset == doctest::Approx(-1.5 * 3.0 / std::sqrt(10.0)).epsilon(0.01));
  for (std::size_t k = 1; k < pass.size(); ++k) {
    const double turns = (pass[k].phase - pass[k - 1].phase) / (2.0 * std::numbers::pi);
    CHECK(turns - kSonarCentre == doctest::Approx(pass[k - 1].offset));
  }
}

TEST_CASE("the bins are those of the model, but for what changes within a block") {
  const auto pass = sonar_pass(1.5);
  for (const std::size_t k : {std::size_t{0}, pass.size() / 3, pass.size() - 1}) {
    const SonarBlock& block = pass[k];
    for (int i = 0; i < kSonarBins; ++i) {
      const double d = kSonarHalfWidth - i + block.offset;
      const double x = std::numbers::pi * d;
      const double size = 0.5 * block.amplitude * (std::fabs(x) < 1e-9 ? 1.0 : std::sin(x) / x);
      const auto& bin = block.bins.at(static_cast<std::size_t>(i));
      CHECK(bin.real == doctest::Approx(size * std::cos(block.phase + x)).epsilon(0.02).scale(0.1));
      CHECK(bin.imaginary == doctest::Approx(size * std::sin(block.phase + x)).epsilon(0.02).scale(0.1));
    }
  }
}

TEST_CASE("without noise the initialisation is at the tone, and the filter stays there") {
  const auto pass = sonar_pass(1.0);
  const SonarDesign design{0.00005, 0.0010, 0.0025, 12.5};
  const SonarRun run = sonar_run(pass, 0.0, design, SonarStart::initialisation, 1);
  CHECK(std::fabs(run.start_error) < 0.01);
  const SonarScores scores = sonar_scores(pass, 0.0, design, SonarStart::truth, 2);
  CHECK(scores.offset.front() < 0.01);
  CHECK(scores.offset.front() == scores.offset.back());
  CHECK(std::all_of(scores.tracks.begin(), scores.tracks.end(), [](bool tracks) { return tracks; }));
}

TEST_CASE("samples without noise are the tone") {
  const auto samples = sonar_samples(1.5, kSonarBlocks / 2, 200, 0.0, 1);
  CHECK(*std::max_element(samples.begin(), samples.end()) == doctest::Approx(1.0).epsilon(0.01));
}

}  // namespace
}  // namespace veritrack::experiments

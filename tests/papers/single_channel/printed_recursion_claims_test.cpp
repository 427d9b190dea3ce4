#include "papers/single_channel/printed_recursion_claims.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("the recursion as printed: neither F(t) nor I3 is what the filter needs") {
  const rigor::UpwardRounding upward;
  const auto statements = single_channel::printed_recursion_claims();
  REQUIRE(statements.size() == 2);
  for (const theorems::Statement& statement : statements) {
    CAPTURE(statement.id);
    CHECK(statement.verdict == Verdict::refuted);
    CHECK_FALSE(statement.witness.empty());
  }
}

TEST_CASE("in lock, noise on the frequency alone starves the gain of the amplitude; noise on all does not") {
  const auto amplitude_gain = [](const trackers::FactoredCovariance<double>& noise, int samples) {
    trackers::SingleChannelEkf<double> tracker({noise, 0.01, 0.0},
                                               {1.0, 0.0, 0.5, trackers::identity_process_noise(1.0)});
    double phase = 0.0;
    for (int k = 0; k < samples; ++k) {
      phase += 0.5;
      tracker.step(std::cos(phase));
    }
    // Variance of the error along (x1, x2), over r.
    const auto p = tracker.filtered().covariance.matrix();
    const double c = std::cos(phase);
    const double s = std::sin(phase);
    return (c * c * p(0, 0) + 2.0 * c * s * p(0, 1) + s * s * p(1, 1)) / 0.01;
  };
  const auto printed = trackers::frequency_only_process_noise(0.005);
  CHECK(amplitude_gain(printed, 4000) < 0.3 * amplitude_gain(printed, 1000));
  const auto all = trackers::identity_process_noise(0.005);
  CHECK(amplitude_gain(all, 4000) > 0.5 * amplitude_gain(all, 1000));
}

// A constant amplitude that is known to be in a range: its words, its sets, and runs at such amplitudes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/step/point_tube.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_map.hpp"
#include "certificates/model/model_promise.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/certificates/model/model_certificates.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {
namespace constant_amplitude {  // helpers of other tests of the unit have the same names

using model::FrequencySlice;
using model::ProvedSet;

constexpr double kLow = 0.985;
constexpr double kHigh = 1.015;

/// The loop with a constant amplitude within 1.5 %.
std::string loop_text() {
  std::string text = test::kLoopText;
  const std::string one = "amplitude = 1\n";
  text.replace(text.find(one), one.size(), "amplitude = { constant = [0.985, 1.015] }\n");
  return text;
}

/// Certified once.
const Certificate& loop() {
  static const Certificate certificate =
      certify(test::loop_design(loop_text()), "loop.toml", loop_text(), {}, Extent::requirements);
  return certificate;
}

TEST_CASE("a loop is certified at every constant amplitude of a range, part by part") {
  const Certificate& certificate = loop();
  CHECK(certificate.verdict == rigor::Verdict::proved);
  REQUIRE_FALSE(certificate.claims.empty());
  CHECK(certificate.claims.front().statement.starts_with(
      "In exact arithmetic, on a tone of any constant amplitude in [0.985, 1.015] with any constant "
      "frequency in [0.3, 0.32] rad/sample"));
  const ModelSets& sets = model_sets(certificate);
  REQUIRE(sets.assumed.has_value());
  for (const ProvedSet* set : {&sets.starts, &*sets.assumed}) {
    CHECK(set->is_proved());
    const std::vector<model::AmplitudePart>& parts = set->tubes.amplitudes;
    REQUIRE(parts.size() >= 2);  // half the range is 0.3 of the noise that is tolerated
    CHECK(parts.front().low <= kLow);
    CHECK(parts.back().high >= kHigh);
    CHECK(parts.front().first == 0);
    CHECK(parts.back().end == set->tubes.tubes.size());
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
      CHECK(parts[k].high == parts[k + 1].low);
      CHECK(parts[k].end == parts[k + 1].first);
    }
  }
  // Evidence for each part, in order.
  const Json tubes = model_evidence_json(certificate).at("tubes");
  CHECK(tubes.size() == sets.starts.tubes.amplitudes.size() + sets.assumed->tubes.amplitudes.size());
  for (const Json& set : tubes) {
    CHECK(set.at("amplitude").size() == 2);
  }
  CHECK(model_design_json(certificate.design).at("assume").at("amplitude").at("constant").size() == 2);
  // Over all frequencies something is said of bias and ripple.
  REQUIRE_FALSE(sets.slices.empty());
  CHECK(sets.slices.front().low <= 0.3 + 1e-9);
  CHECK(sets.slices.back().high >= 0.32 - 1e-9);
  for (const FrequencySlice& cell : sets.slices) {
    CHECK(rigor::is_finite(cell.bias));
    CHECK(cell.bias.lower() >= sets.starts.bias.lower());
    CHECK(cell.bias.upper() <= sets.starts.bias.upper());
    CHECK(cell.ripple <= sets.starts.ripple);
    CHECK(cell.reach >= sets.starts.reach);
  }
}

TEST_CASE("no run at a constant amplitude, from a start in the tube of its part, exceeds what is proved") {
  const ModelSets& sets = model_sets(loop());
  const ProvedSet& set = sets.assumed.value();
  constexpr double kNoise = 0.02;
  constexpr double kWn = 0.02;
  constexpr double kZeta = 0.7071;
  const rigor::NearestRounding nearest;
  test::Random random(27);
  const std::vector<model::TubeSet> parts = model::sets_of_amplitudes(set.tubes);
  double largest = 0.0;
  for (int run = 0; run < 60; ++run) {
    const model::TubeSet& part = parts[random.below(parts.size())];
    const model::ProvedTube& proved = part.tubes[random.below(part.tubes.size())];
    const model::AmplitudePart& range = part.amplitudes.front();
    const std::size_t kind = random.below(3);
    const double amplitude = kind == 0   ? range.low
                             : kind == 1 ? range.high
                                         : random.uniform(range.low, range.high);
    const double omega = proved.tube.frequency + random.uniform(-1.0, 1.0) * proved.tube.half_width;
    double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    const model::PointTube tube(proved.tube, omega);
    model::PointFrame frame;
    tube.at(phase, frame);
    const Eigen::VectorXd start = frame.state(0.999 * proved.levels.front() *
                                              Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    double theta = start[0];
    double w = start[1];
    for (int k = 0; k < 3000; ++k) {
      REQUIRE(std::fabs(w - omega) <= set.frequency_error);
      largest = std::max(largest, std::fabs(w - omega));
      phase += omega;
      const double noise = random.below(2) == 0 ? kNoise : -kNoise;
      const double e = -2.0 * (amplitude * std::cos(phase) + noise) * std::sin(theta + w);
      const double next = w + kWn * kWn * e;
      theta = theta + w + 2.0 * kZeta * kWn * e;
      w = next;
    }
    REQUIRE(std::fabs(w - omega) <= set.settled_error);
  }
  CHECK(largest > 0.5 * set.frequency_error);
}

TEST_CASE("maps and control loops are for one amplitude") {
  const rigor::UpwardRounding upward;
  CHECK_THROWS_AS((void)map_model(test::loop_design(loop_text()), {}, {}), RequestError);
  CHECK(model_frequency_promise(loop()).objection ==
        "its amplitude is a range; allowed for a model here: one amplitude");
}

}  // namespace constant_amplitude
}  // namespace
}  // namespace veritrack::certificates

// A tracker that the program has built in, written down as a model: what is proved of the model against the
// built-in tracker's own code, and against what its own column proves.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "analysis/model/step/point_tube.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/invariant_curve.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::certificates {
namespace {

using model::ProvedSet;
using rigor::Interval;

constexpr double kProcessNoise = 0.005;
constexpr double kMeasurementNoise = 0.01;
constexpr double kLowestFrequency = 1.5;
constexpr double kHighestFrequency = 1.501;

std::string filter_with(const std::string& leak, const std::string& noise) {
  return "name = 'a'\ntracker = 'model'\n[model]\nsamples = 'y'\nparameters = { q = 0.005, r = 0.01, leak "
         "= " +
         leak +
         " }\nfrequency = 'w'\nstart = { x1 = 'A', x2 = 0, w = 'omega', 'P.x1.x1' = 0.01, 'P.x2.x2' = 0.01, "
         "'P.w.w' = 0.01 }\n[model.ekf]\nstates = ['x1', 'x2', 'w']\npredict = '''\n"
         "x1' = cos(w)*x1 - sin(w)*x2\nx2' = sin(w)*x1 + cos(w)*x2\nw' = (1 - leak)*w\n'''\nmeasure = 'x1'\n"
         "Q = [['q', 0, 0], [0, 'q', 0], [0, 0, 'q']]\nR = 'r'\n[assume]\nfrequency = [1.5, 1.501]\nnoise "
         "= " +
         noise + "\n";
}

/// A certified filter; what is proved refers to the model.
struct Certified {
  Design design;
  Model model;
  ModelSets sets;

  explicit Certified(const std::string& text) {
    const rigor::UpwardRounding upward;
    design = read_design(text, "design.toml");
    const ModelTables& tables = model_tables(design);
    model = make_model(tables.model, tables.assume.signal);
    sets = certify_sets(tables, Extent::requirements, {}, {});
  }
};

/// The built-in filter, begun at a state of the model: the estimate, then the upper triangle of the
/// covariance.
trackers::SingleChannelEkf<double> built_in(const Eigen::VectorXd& state, double leak) {
  Eigen::Matrix3d covariance;
  covariance << state[3], state[4], state[5], state[4], state[6], state[7], state[5], state[7], state[8];
  return trackers::SingleChannelEkf<double>(
      {.process_noise = trackers::identity_process_noise(kProcessNoise),
       .r = kMeasurementNoise,
       .epsilon = leak},
      {.in_phase = state[0],
       .quadrature = state[1],
       .frequency = state[2],
       .covariance = trackers::FactoredCovariance<double>::from_matrix(covariance)});
}

TEST_CASE("the built-in single-channel filter keeps the bounds that are proved of it as a model" *
          doctest::test_suite("nightly")) {
  const Certified filter(filter_with("0", "0.003"));
  REQUIRE(filter.sets.bounds_covariance);
  REQUIRE(filter.sets.assumed.value().is_proved());
  const ProvedSet& set = *filter.sets.assumed;
  const double settled = settled_error_of(filter.sets);
  CHECK(settled < set.frequency_error);
  const model::TrackerModel tracker = proved_model(filter.model, model_tables(filter.design).assume);
  test::Random random(81);
  double largest = 0.0;
  double last = 0.0;
  for (std::uint64_t run = 0; run < 60; ++run) {
    const model::ProvedTube& proved = set.tubes.tubes[random.below(set.tubes.tubes.size())];
    const double omega =
        std::clamp(proved.tube.frequency + random.uniform(-1.0, 1.0) * proved.tube.half_width,
                   kLowestFrequency, kHighestFrequency);
    double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    model::PointFrame frame;
    model::PointTube(proved.tube, omega).at(phase, frame);
    Eigen::Vector3d start(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    start *= proved.levels.front() / start.norm();
    model::PointTracker points(tracker);
    trackers::SingleChannelEkf<double> ekf = built_in(points.state(frame, start), 0.0);
    constexpr int kSamples = 3000;
    for (int k = 0; k < kSamples; ++k) {
      phase += omega;
      // For some time the same sign, then at random.
      const double noise = random.below(run % 20 + 1) == 0 ? 0.003 : -0.003;
      ekf.step(std::cos(phase) + noise);
      const double error = std::fabs(ekf.filtered().frequency - omega);
      largest = std::max(largest, error);
      last = k > kSamples - 300 ? std::max(last, error) : last;
    }
  }
  CHECK(largest <= set.frequency_error);
  CHECK(largest > 0.1 * set.frequency_error);
  CHECK(last <= settled);
  CHECK(last > 0.1 * settled);
}

TEST_CASE("the bias of the leaking filter: as a model, by its own column, and of the built-in filter") {
  constexpr double kLeak = 0.0005;
  const Certified filter(filter_with("0.0005", "0"));
  REQUIRE(filter.sets.starts.is_proved());
  const Interval as_model = filter.sets.starts.bias;
  REQUIRE(rigor::is_finite(as_model));
  const single_channel::SteadyStateBias own = [] {
    const rigor::UpwardRounding upward;
    return single_channel::steady_state_bias(
        {Interval(kProcessNoise), Interval(kProcessNoise), Interval(kMeasurementNoise), Interval(kLeak)},
        Interval::from_bounds(kLowestFrequency, kHighestFrequency));
  }();
  REQUIRE(own.verdict == rigor::Verdict::proved);
  CAPTURE(as_model.lower());
  CAPTURE(as_model.upper());
  CAPTURE(own.mean_bias.lower());
  CAPTURE(own.mean_bias.upper());
  // By structure the leak costs the model's set its lower levels, so that its bias is known roughly only.
  CHECK(as_model.lower() <= own.mean_bias.lower());
  CHECK(own.mean_bias.upper() <= as_model.upper());
  CHECK(own.mean_bias.upper() < 0.0);  // the leak pulls to lower frequencies
  // And in a simulation, at a frequency between.
  const double omega = 1.5005;
  trackers::SingleChannelEkf<double> ekf =
      built_in((Eigen::VectorXd(9) << 1.0, 0.0, omega, 0.01, 0.0, 0.0, 0.01, 0.0, 0.01).finished(), kLeak);
  double sum = 0.0;
  double least = INFINITY;
  double most = -INFINITY;
  constexpr int kSettling = 5000;
  constexpr int kSamples = 200000;
  for (int k = 1; k <= kSettling + kSamples; ++k) {
    ekf.step(std::cos(omega * k));
    if (k > kSettling) {
      const double error = ekf.filtered().frequency - omega;
      sum += error;
      least = std::min(least, error);
      most = std::max(most, error);
    }
  }
  const double room = 1e-6;  // of a mean over finitely many samples
  for (const Interval& bias : {as_model, own.mean_bias}) {
    CHECK(sum / kSamples >= bias.lower() - room);
    CHECK(sum / kSamples <= bias.upper() + room);
  }
  CHECK(most - least <= filter.sets.starts.ripple);
  CHECK(least >= own.min_error.lower());
  CHECK(most <= own.max_error.upper());
}

}  // namespace
}  // namespace veritrack::certificates

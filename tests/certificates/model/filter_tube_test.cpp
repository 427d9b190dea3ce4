// Filters by structure: their parts against the recursion, and what is proved of their tubes against random
// steps of the recursion.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "analysis/model/step/point_tube.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/model/tube/tube_verification.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using rigor::Verdict;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::string filter_text(const std::string& measure = "'x1'", const std::string& q12 = "0",
                        const std::string& more = "", const std::string& frequency = "w") {
  return "name = 'a'\ntracker = 'model'\n[model]\nsamples = 'y'\nparameters = { q = 0.005, r = 0.01 }\n"
         "frequency = '" +
         frequency +
         "'\nstart = { x1 = 'A', x2 = 0, w = 'omega', 'P.x1.x1' = 0.01, 'P.x2.x2' = 0.01, 'P.w.w' = 0.01 "
         "}\n" +
         "[model.ekf]\nstates = ['x1', 'x2', 'w']\npredict = '''\nx1' = cos(w)*x1 - sin(w)*x2\n"
         "x2' = sin(w)*x1 + cos(w)*x2\nw' = w\n'''\nmeasure = " +
         measure + "\nQ = [['q', " + q12 + ", 0], [0, 'q', 0], [0, 0, 'q']]\nR = 'r'\n" + more +
         "[assume]\nfrequency = [1.5, 1.501]\nnoise = 0.003\n";
}

/// A filter on a tone of amplitude 1. What is proved refers to it.
struct Filter {
  Design design;
  Model model;
  model::TrackerModel tracker;
  model::TrackedTone tone;

  explicit Filter(const std::string& text)
      : design(read(text)),
        model(made(design)),
        tracker(proved_model(model, model_tables(design).assume)),
        tone(proposed_tone(model, model_tables(design).assume)) {
    tone.filter = tracker.filter;
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  Filter(Filter&&) = delete;
  Filter& operator=(Filter&&) = delete;
  ~Filter() = default;

  [[nodiscard]] static Design read(const std::string& text) {
    const rigor::UpwardRounding upward;
    return read_design(text, "design.toml");
  }
  [[nodiscard]] static Model made(const Design& design) {
    const rigor::UpwardRounding upward;
    const ModelTables& tables = model_tables(design);
    return make_model(tables.model, tables.assume.signal);
  }
  [[nodiscard]] trackers::FilterValues<double> values(const VectorXd& estimate, double sample) const {
    std::vector<double> inputs = tone.step.constants();
    inputs.insert(inputs.end(), estimate.begin(), estimate.end());
    inputs.push_back(sample);
    return trackers::filter_values(*model.filter, inputs);
  }
  /// P - P H' (H P H' + R)^-1 H P.
  [[nodiscard]] MatrixXd updated(const MatrixXd& predicted) const {
    const auto parts = values(VectorXd::Ones(3), 0.0);
    const Eigen::RowVector3d h = Eigen::Map<const Eigen::RowVector3d>(parts.measured.data());
    const VectorXd cross = predicted * h.transpose();
    return predicted - cross * cross.transpose() / (h.dot(cross) + parts.noise[0]);
  }
};

VectorXd joined_state(const VectorXd& estimate, const MatrixXd& covariance) {
  VectorXd state(9);
  state << estimate, covariance(0, 0), covariance(0, 1), covariance(0, 2), covariance(1, 1), covariance(1, 2),
      covariance(2, 2);
  return state;
}

MatrixXd covariance_of(const VectorXd& state) {
  MatrixXd covariance(3, 3);
  covariance << state[3], state[4], state[5], state[4], state[6], state[7], state[5], state[7], state[8];
  return covariance;
}

VectorXd random_vector(test::Random& random, double length) {
  VectorXd x(3);
  do {
    x << random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0);
  } while (x.norm() > 1.0 || x.norm() < 0.05);
  return x * (length / x.norm());
}

/// Another F than the derivative of the prediction.
constexpr const char* kGivenJacobian =
    "jacobian = [['cos(w)', '-sin(w)', '-0.95*(sin(w)*x1 + cos(w)*x2)'], "
    "['sin(w)', 'cos(w)', '1.05*(cos(w)*x1 - sin(w)*x2)'], [0, 0, 1]]\n";

void check_parts(const Filter& filter) {
  REQUIRE(filter.model.filter);
  test::Random random(71);
  for (int i = 0; i < 200; ++i) {
    const VectorXd estimate = random_vector(random, random.uniform(0.1, 2.0));
    const MatrixXd root = MatrixXd::NullaryExpr(3, 3, [&] { return random.uniform(-0.3, 0.3); });
    const MatrixXd covariance = root * root.transpose();
    const VectorXd sample = VectorXd::Constant(1, random.uniform(-2.0, 2.0));
    const VectorXd next = filter.tone.step.next(joined_state(estimate, covariance), sample);
    const auto parts = filter.values(estimate, sample[0]);
    const MatrixXd f = Eigen::Map<const RowMajor>(parts.jacobian.data(), 3, 3);
    const MatrixXd q = Eigen::Map<const RowMajor>(parts.process.data(), 3, 3);
    const MatrixXd updated = filter.updated(f * covariance * f.transpose() + q);
    const VectorXd predicted = Eigen::Map<const VectorXd>(parts.predicted.data(), 3);
    const VectorXd h = Eigen::Map<const VectorXd>(parts.measured.data(), 3);
    CHECK((covariance_of(next) - updated).cwiseAbs().maxCoeff() < 1e-13);
    CHECK((next.head(3) - predicted - updated * h * parts.innovation[0] / parts.noise[0])
              .cwiseAbs()
              .maxCoeff() < 1e-12);
  }
}

TEST_CASE("the parts of a filter are those of its recursion") {
  check_parts(Filter(filter_text()));
}

TEST_CASE("a given Jacobian is part of a filter as the derivative is") {
  const Filter given(filter_text("'x1'", "0", kGivenJacobian));
  check_parts(given);
  CHECK(given.model.filter->has_given_jacobian);
  const Filter derived(filter_text());
  CHECK_FALSE(derived.model.filter->has_given_jacobian);
  // With three states the covariance is rather one of them.
  CHECK(bounds_covariance(derived.model, model_tables(derived.design)));
  CHECK_FALSE(bounds_covariance(given.model, model_tables(given.design)));
}

TEST_CASE("only linear measurements, symmetric noise and an estimated frequency are taken to parts") {
  CHECK(Filter(filter_text("'q*x1 + x2'")).model.filter.has_value());
  CHECK_FALSE(Filter(filter_text("'x1 + 0.1*x1*x2'")).model.filter.has_value());
  // Equal numbers that are written differently.
  CHECK_FALSE(Filter(filter_text("'x1'", "'0*q'")).model.filter.has_value());
  CHECK_FALSE(Filter(filter_text("'x1'", "0", "", "w + P.w.w")).model.filter.has_value());
}

model::TubeProposal propose_for_noise(const Filter& filter) {
  model::TubeSettings settings;
  settings.shape.objective = model::ShapeObjective::largest_noise;
  settings.shape.noise = 0.003;
  settings.shape.evaluations = 90;
  return model::propose_tube(filter.tone, 1.5005, 0.0005, settings);
}

/// A tube that is proposed once, for noise.
const model::TubeProposal& proposed(const Filter& filter) {
  static const model::TubeProposal proposal = propose_for_noise(filter);
  return proposal;
}

const Filter& example() {
  static const Filter filter(filter_text());
  return filter;
}

/// Verifies the tube for this noise, and attacks what is proved of it.
void check_tube(const Filter& filter, const model::TubeProposal& proposal, double least_radius,
                double noise_bound = 0.003) {
  REQUIRE(proposal.outcome == model::TubeOutcome::proposed);
  const model::Tube& tube = *proposal.tube;
  REQUIRE(tube.bounds_covariance());
  REQUIRE(tube.curve.size() == 3);
  const double radius = 0.7 * proposal.worth.level;
  CHECK(radius > least_radius);
  const double deviation = filter.tone.amplitude_deviation;
  constexpr double kShrinking = 0.995;
  constexpr double kLeast = 0.5;
  const model::LevelResult proved =
      model::verify_level(filter.tracker, tube, {radius, noise_bound, kLeast, kShrinking}, {32, 1, 2000, {}});
  REQUIRE(proved.verdict == Verdict::proved);
  const rigor::NearestRounding nearest;
  test::Random random(72);
  const auto matrices = [&](double phase, double frequency) {
    // The middle of the bounds, and the bounds, by a tube with one of them twice.
    std::vector<MatrixXd> bounds;
    for (const bool is_high : {false, true}) {
      model::Tube one = tube;
      (is_high ? one.covariance_low : one.covariance_high) =
          is_high ? tube.covariance_high : tube.covariance_low;
      model::PointFrame frame;
      model::PointTube(one, frequency).at(phase, frame);
      bounds.push_back(filter.updated(frame.covariance));
    }
    return bounds;
  };
  double largest = 0.0;
  for (std::int64_t i = 0; i < test::effort(4000); ++i) {
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double frequency = tube.frequency + tube.half_width * random.uniform(-1.0, 1.0);
    const std::vector<MatrixXd> here = matrices(phase, frequency);
    // Extreme covariances: D (I - 2 u u') D' about the middle, or one of the bounds.
    const MatrixXd root = oracle::cholesky_factor(0.5 * (here[1] - here[0]));
    const VectorXd u = random_vector(random, 1.0);
    const std::uint64_t kind = random.below(4);
    const MatrixXd y =
        kind == 0 ? MatrixXd(MatrixXd::Identity(3, 3))
        : kind == 1
            ? MatrixXd(-MatrixXd::Identity(3, 3))
            : MatrixXd((kind == 2 ? 1.0 : -1.0) * (MatrixXd::Identity(3, 3) - 2.0 * u * u.transpose()));
    const MatrixXd covariance = 0.5 * (here[0] + here[1]) + root * y * root.transpose();
    const double level = radius * random.uniform(kLeast, 1.0);
    model::PointFrame frame;
    const model::PointTube point(tube, frequency);
    point.at(phase, frame);
    const VectorXd estimate = frame.state(random_vector(random, level));
    const double noise = random.below(2) == 0 ? noise_bound : -noise_bound;
    const double amplitude = 1.0 + (random.below(2) == 0 ? deviation : -deviation);
    const VectorXd sample = VectorXd::Constant(1, amplitude * std::cos(phase + frequency) + noise);
    const VectorXd next = filter.tone.step.next(joined_state(estimate, covariance), sample);
    point.at(phase + frequency, frame);
    const double reached = frame.coordinates(next).norm();
    largest = std::max(largest, reached / level);
    const std::vector<MatrixXd> there = matrices(phase + frequency, frequency);
    CAPTURE(i);
    REQUIRE(reached <= kShrinking * level);
    REQUIRE(oracle::least_eigenvalue(covariance_of(next) - there[0]) > 0.0);
    REQUIRE(oracle::least_eigenvalue(there[1] - covariance_of(next)) > 0.0);
  }
  // Not far from what is proved.
  CHECK(largest > 0.8);
}

TEST_CASE("a proved tube of a filter keeps every estimate and covariance in its bounds") {
  check_tube(example(), proposed(example()), 0.025);
}

TEST_CASE("a proved tube of a filter with a given Jacobian does, too") {
  const Filter given(filter_text("'x1'", "0", kGivenJacobian));
  check_tube(given, propose_for_noise(given), 0.02);
}

TEST_CASE("a proved tube of a filter does at every amplitude of a range, too") {
  // The covariance does not depend on the samples, and the noise of the proposal is what amplitudes come to.
  const Filter varying(filter_text() + "amplitude = [0.998, 1.002]\n");
  CHECK(varying.tone.amplitude_deviation == doctest::Approx(0.002));
  CHECK(model::error_from_amplitude(varying.tone) == doctest::Approx(0.002).epsilon(1e-3));
  check_tube(varying, proposed(example()), 0.025, 0.001);
  const model::Tube& tube = *proposed(example()).tube;
  const double radius = 0.7 * proposed(example()).worth.level;
  const Filter far(filter_text() + "amplitude = [0.9, 1.1]\n");
  CHECK(model::verify_level(far.tracker, tube, {radius, 0.0}, {32, 1, 300, {}}).verdict ==
        Verdict::undecided);
}

TEST_CASE("wrong bounds of a covariance are not proved") {
  const Filter& filter = example();
  const model::TubeProposal& proposal = proposed(filter);
  REQUIRE(proposal.tube);
  const double radius = 0.7 * proposal.worth.level;
  const auto is_proved = [&](const model::Tube& tube, double tried, double slew = 0.0) {
    return model::verify_level(filter.tracker, tube, {tried, 0.0, 1.0, 1.0, slew}, {32, 1, 300, {}})
               .verdict == Verdict::proved;
  };
  CHECK(is_proved(*proposal.tube, radius));
  CHECK(is_proved(*proposal.tube, radius, 1e-7));
  CHECK_FALSE(is_proved(*proposal.tube, radius, 1e-2));
  CHECK_FALSE(is_proved(*proposal.tube, 2.0 * proposal.worth.level));
  const auto changed = [&](const auto& change) {
    model::Tube tube = *proposal.tube;
    change(tube);
    return tube;
  };
  CHECK_FALSE(is_proved(
      changed([](model::Tube& tube) { std::swap(tube.covariance_low, tube.covariance_high); }), radius));
  CHECK_FALSE(is_proved(changed([](model::Tube& tube) { tube.covariance_low = tube.covariance_high; }),
                        1e-6 * radius));
  for (const double factor : {0.5, 2.0}) {
    CHECK_FALSE(is_proved(changed([&](model::Tube& tube) {
                            auto& bound = factor < 1.0 ? tube.covariance_high : tube.covariance_low;
                            bound[5].coefficients[0][0] *= factor;
                          }),
                          radius));
  }
  model::Tube turning = *proposal.tube;
  turning.turns[0] = 1;
  CHECK_FALSE(is_proved(turning, radius));
  model::Tube shorter = *proposal.tube;
  shorter.covariance_low.pop_back();
  CHECK_THROWS_AS((void)is_proved(shorter, radius), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::certificates

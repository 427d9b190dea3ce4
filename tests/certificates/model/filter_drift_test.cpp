// Filters by structure in Gaussian noise: what is proved against integrals over the noise, and against runs.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/model/gaussian/gaussian_drift.hpp"
#include "analysis/model/gaussian/gaussian_set.hpp"
#include "analysis/model/step/point_tube.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/binomial.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using rigor::Verdict;

constexpr double kSamples = 1000.0;
constexpr double kProbability = 0.05;
constexpr double kStartShare = 0.5;

const char* const kFilterText = R"(name = 'a'
tracker = 'model'
[model]
samples = 'y'
parameters = { q = 0.005, r = 0.01 }
frequency = 'w'
start = { x1 = 'A', x2 = 0, w = 'omega', 'P.x1.x1' = 0.01, 'P.x2.x2' = 0.01, 'P.w.w' = 0.01 }
[model.ekf]
states = ['x1', 'x2', 'w']
predict = '''
x1' = cos(w)*x1 - sin(w)*x2
x2' = sin(w)*x1 + cos(w)*x2
w' = w
'''
measure = 'x1'
Q = [['q', 0, 0], [0, 'q', 0], [0, 0, 'q']]
R = 'r'
[assume]
frequency = [1.5, 1.501]
noise = 0.003
)";

/// The single-channel filter on a tone of amplitude 1, a tube of its estimate, and what is asked of it.
struct NoisyFilter {
  Design design;
  Model model;
  model::TrackerModel tracker;
  model::TrackedTone tone;
  model::TubeProposal proposal;
  model::GaussianTerms terms;
  model::DriftQuestion question;

  NoisyFilter()
      : design(read()),
        model(made(design)),
        tracker(proved_model(model, model_tables(design).assume)),
        tone(proposed_tone(model, model_tables(design).assume)) {
    tone.filter = tracker.filter;
    model::TubeSettings settings;
    settings.shape.objective = model::ShapeObjective::largest_deviation;
    settings.shape.exponent = std::log(kSamples / kProbability);
    settings.shape.evaluations = 90;
    proposal = model::propose_tube(tone, 1.5005, 0.0005, settings);
    terms.deviation = 0.75 * proposal.worth.noise;
    terms.most_noise = 8.0 * terms.deviation;
    terms.factor = 0.99;
    terms.constant = 5.0;
    terms.exponent = std::log(1.2 * kSamples * terms.constant / kProbability);
    question = {0.95 * proposal.worth.level,
                terms.deviation,
                terms.most_noise,
                terms.exponent,
                terms.factor,
                terms.constant};
  }
  NoisyFilter(const NoisyFilter&) = delete;
  NoisyFilter& operator=(const NoisyFilter&) = delete;
  NoisyFilter(NoisyFilter&&) = delete;
  NoisyFilter& operator=(NoisyFilter&&) = delete;
  ~NoisyFilter() = default;

  [[nodiscard]] static Design read() {
    const rigor::UpwardRounding upward;
    return read_design(kFilterText, "design.toml");
  }
  [[nodiscard]] static Model made(const Design& design) {
    const rigor::UpwardRounding upward;
    return make_model(model_tables(design).model, model_tables(design).assume.signal);
  }
  [[nodiscard]] model::DriftResult verified(const model::DriftQuestion& asked) const {
    return model::verify_drift(tracker, *proposal.tube, asked, {32, 1, 2000, {}});
  }
  /// P - P H' (H P H' + R)^-1 H P for H = (1, 0, 0).
  [[nodiscard]] static MatrixXd updated(const MatrixXd& predicted) {
    constexpr double kR = 0.01;
    const VectorXd cross = predicted.col(0);
    return predicted - cross * cross.transpose() / (predicted(0, 0) + kR);
  }
  /// The updated bounds at a phase.
  [[nodiscard]] std::array<MatrixXd, 2> bounds(double phase, double frequency) const {
    std::array<MatrixXd, 2> both;
    for (const bool is_high : {false, true}) {
      model::Tube one = *proposal.tube;
      (is_high ? one.covariance_low : one.covariance_high) =
          is_high ? one.covariance_high : one.covariance_low;
      model::PointFrame frame;
      model::PointTube(one, frequency).at(phase, frame);
      both.at(is_high ? 1 : 0) = updated(frame.covariance);
    }
    return both;
  }
  /// A state at this level, with one of the covariances between the bounds that are farthest from each other.
  [[nodiscard]] VectorXd state(double phase, double frequency, double level, test::Random& random) const {
    const auto [low, high] = bounds(phase, frequency);
    const MatrixXd root = oracle::cholesky_factor(0.5 * (high - low));
    const VectorXd u = direction(random);
    const MatrixXd y =
        (random.below(2) == 0 ? 1.0 : -1.0) *
        (MatrixXd::Identity(3, 3) - 2.0 * static_cast<double>(random.below(2)) * u * u.transpose());
    const MatrixXd covariance = 0.5 * (low + high) + root * y * root.transpose();
    model::PointFrame frame;
    model::PointTube(*proposal.tube, frequency).at(phase, frame);
    VectorXd joined(9);
    joined << frame.state(level * direction(random)), covariance(0, 0), covariance(0, 1), covariance(0, 2),
        covariance(1, 1), covariance(1, 2), covariance(2, 2);
    return joined;
  }
  [[nodiscard]] VectorXd next(const VectorXd& state, double phase, double noise) const {
    return tone.step.next(state, VectorXd::Constant(1, std::cos(phase) + noise));
  }
  [[nodiscard]] static VectorXd direction(test::Random& random) {
    VectorXd x(3);
    do {
      x << random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0);
    } while (x.norm() > 1.0 || x.norm() < 0.05);
    return x.normalized();
  }
};

const NoisyFilter& noisy_example() {
  static const NoisyFilter filter;
  return filter;
}

TEST_CASE("the drift that is proved of a filter is above the integral over the noise, for every covariance") {
  const NoisyFilter& filter = noisy_example();
  REQUIRE(filter.proposal.tube);
  REQUIRE(filter.proposal.tube->bounds_covariance());
  REQUIRE(filter.verified(filter.question).verdict == Verdict::proved);
  const model::DriftQuestion& asked = filter.question;
  const auto weight = [&](double level) {
    return std::exp(asked.exponent * level * level / asked.radius / asked.radius);
  };
  test::Random random(81);
  const rigor::NearestRounding nearest;
  double largest = 0.0;
  for (std::int64_t i = 0; i < test::effort(300); ++i) {
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double frequency = 1.5005 + 0.0005 * random.uniform(-1.0, 1.0);
    const double level = asked.radius * std::sqrt(random.uniform());
    const VectorXd state = filter.state(phase, frequency, level, random);
    model::PointFrame there;
    model::PointTube(*filter.proposal.tube, frequency).at(phase + frequency, there);
    // The covariance after the step is the same whatever the noise.
    const VectorXd quiet = filter.next(state, phase + frequency, 0.0);
    CHECK(filter.next(state, phase + frequency, 1e3).tail(6) == quiet.tail(6));
    double mean = 0.0;
    constexpr int kSteps = 240;
    constexpr double kLongest = 7.0;  // deviations
    for (int k = 0; k <= kSteps; ++k) {
      const double u = kLongest * (2.0 * k / kSteps - 1.0);
      const VectorXd next = filter.next(state, phase + frequency, asked.deviation * u);
      mean += std::exp(-0.5 * u * u) * weight(there.coordinates(next).norm());
    }
    mean *= 2.0 * kLongest / kSteps / std::sqrt(2.0 * std::numbers::pi);
    const double allowed = asked.factor * weight(level) + asked.constant;
    largest = std::max(largest, mean / allowed);
    CAPTURE(i);
    REQUIRE(mean <= allowed);
  }
  CHECK(largest > 0.3);
}

TEST_CASE("runs of a filter in as much noise as was proved lose lock no more often than is said") {
  const NoisyFilter& filter = noisy_example();
  REQUIRE(filter.verified(filter.question).verdict == Verdict::proved);
  double bound = 1.0;
  {
    const rigor::UpwardRounding upward;
    bound = model::leaving_probability(filter.terms, 1, rigor::Interval(kSamples), kStartShare);
  }
  CHECK(bound < 1.1 * kProbability);
  test::Random random(82);
  const rigor::NearestRounding nearest;
  const std::int64_t runs = test::effort(100);
  std::int64_t losses = 0;
  double largest = 0.0;
  for (std::int64_t run = 0; run < runs; ++run) {
    const double frequency = 1.5005 + 0.0005 * random.uniform(-1.0, 1.0);
    double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    VectorXd state = filter.state(phase, frequency, kStartShare * filter.question.radius, random);
    const model::PointTube tube(*filter.proposal.tube, frequency);
    model::PointFrame frame;
    bool is_in_lock = true;
    for (int k = 0; k < static_cast<int>(kSamples) && is_in_lock; ++k) {
      phase = std::remainder(phase + frequency, 2.0 * std::numbers::pi);
      const double normal = std::sqrt(-2.0 * std::log(1.0 - random.uniform())) *
                            std::cos(2.0 * std::numbers::pi * random.uniform());
      state = filter.next(state, phase, filter.question.deviation * normal);
      tube.at(phase, frame);
      const double share = frame.coordinates(state).norm() / filter.question.radius;
      largest = std::max(largest, share);
      is_in_lock = share <= 1.0;
    }
    losses += is_in_lock ? 0 : 1;
  }
  CHECK(test::clopper_pearson(losses, runs, 1e-6).lower <= bound);
  CHECK(largest > 0.4);  // the noise is felt
}

TEST_CASE("too much noise, a smaller probability or wrong bounds of the covariance are not proved") {
  const NoisyFilter& filter = noisy_example();
  const auto is_proved = [&](const model::Tube& tube, const model::DriftQuestion& asked) {
    return model::verify_drift(filter.tracker, tube, asked, {32, 1, 300, {}}).verdict == Verdict::proved;
  };
  const model::Tube& tube = *filter.proposal.tube;
  CHECK(is_proved(tube, filter.question));
  model::DriftQuestion noisier = filter.question;
  noisier.deviation *= 1.6;
  CHECK_FALSE(is_proved(tube, noisier));
  model::DriftQuestion rarer = filter.question;
  rarer.exponent *= 2.5;
  CHECK_FALSE(is_proved(tube, rarer));
  model::DriftQuestion wider = filter.question;
  wider.radius *= 2.0;
  CHECK_FALSE(is_proved(tube, wider));
  model::Tube swapped = tube;
  std::swap(swapped.covariance_low, swapped.covariance_high);
  CHECK_FALSE(is_proved(swapped, filter.question));
  model::Tube empty = tube;
  empty.covariance_low = empty.covariance_high;
  CHECK_FALSE(is_proved(empty, filter.question));
  for (const double factor : {0.5, 2.0}) {
    model::Tube changed = tube;
    (factor < 1.0 ? changed.covariance_high : changed.covariance_low)[5].coefficients[0][0] *= factor;
    CHECK_FALSE(is_proved(changed, filter.question));
  }
}

}  // namespace
}  // namespace veritrack::certificates

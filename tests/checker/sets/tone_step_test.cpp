// The checker's own sample of the single-channel tracker against the tracker that runs, and its derivatives
// against differences.
#include "checker/sets/tone_step.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "checker/numbers/gradient.hpp"
#include "checker/numbers/series.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::kToneStates;
using checker::ToneState;

struct Sample {
  trackers::ToneModel<double> design;
  ToneState<double> state;
  double frequency, phase;  ///< rad/sample; of the new sample, rad

  explicit Sample(test::Random& random) : design(test::random_design(random)) {
    const Eigen::Matrix3d p = test::random_covariance(random);
    state = {random.uniform(-0.5, 0.5),
             random.uniform(-0.5, 0.5),
             random.uniform(-1.0, 1.0),
             p(0, 0),
             p(1, 0),
             p(1, 1),
             p(2, 0),
             p(2, 1),
             p(2, 2)};
    frequency = random.uniform(0.0, 3.0);
    phase = random.uniform(-3.0, 3.0);
  }
  template <typename S>
  [[nodiscard]] checker::TrackerValues<S> values() const {
    return {S(design.q1), S(design.q2), S(design.r), S(design.epsilon)};
  }
  template <typename S>
  [[nodiscard]] ToneState<S> start() const {
    ToneState<S> x;
    for (std::size_t i = 0; i < kToneStates; ++i) {
      x[i] = S(state[i]);
    }
    return x;
  }
  [[nodiscard]] ToneState<Ball> next(const ToneState<Ball>& x) const {
    return checker::tone_step(x, Ball(frequency), Ball(phase), values<Ball>());
  }
};

}  // namespace

TEST_CASE("a sample moves the state as the tracker's own map does") {
  test::Random random(301);
  for (std::int64_t k = 0; k < test::effort(2000); ++k) {
    CAPTURE(k);
    const Sample sample(random);
    const ToneState<double>& x = sample.state;
    trackers::RotatingFrameState<double> state;
    state << x[0], x[1], x[2], x[3], x[4], x[6], x[5], x[7], x[8];
    const auto expected = trackers::single_channel_map<double>(
        state, {sample.phase, 0.0, 0.0, sample.frequency}, sample.design);
    const auto found = checker::tone_step(x, sample.frequency, sample.phase, sample.values<double>());
    const auto enclosed = sample.next(sample.start<Ball>());
    constexpr std::array<Eigen::Index, kToneStates> kPlaces{0, 1, 2, 3, 4, 6, 5, 7, 8};
    for (std::size_t i = 0; i < kToneStates; ++i) {
      const double size = 1e-9 * (1.0 + expected.cwiseAbs().maxCoeff());
      CHECK(std::fabs(found[i] - expected(kPlaces[i])) <= size);
      CHECK(std::fabs(enclosed[i].near() - expected(kPlaces[i])) <= size);
    }
  }
}

TEST_CASE("gradients are the limits of differences") {
  test::Random random(302);
  using Model = checker::Gradient<Ball, kToneStates>;
  const Ball step(0x1p-40);
  for (std::int64_t k = 0; k < test::effort(20); ++k) {
    CAPTURE(k);
    const Sample sample(random);
    ToneState<Model> x = sample.start<Model>();
    for (std::size_t i = 0; i < kToneStates; ++i) {
      x[i].along[i] = Ball(1.0);
    }
    const ToneState<Model> image =
        checker::tone_step(x, Model(sample.frequency), Model(sample.phase), sample.values<Model>());
    for (std::size_t i = 0; i < kToneStates; ++i) {
      ToneState<Ball> above = sample.start<Ball>();
      ToneState<Ball> below = above;
      above[i] += step;
      below[i] -= step;
      const ToneState<Ball> high = sample.next(above);
      const ToneState<Ball> low = sample.next(below);
      for (std::size_t j = 0; j < kToneStates; ++j) {
        const double difference = ((high[j] - low[j]) / (Ball(2.0) * step)).near();
        CHECK(std::fabs(image[j].along[i].near() - difference) <= 1e-12 * (1.0 + std::fabs(difference)));
      }
    }
  }
}

TEST_CASE("power series have the values of the function") {
  test::Random random(303);
  constexpr slong kTerms = 12;
  using Model = checker::Series<kTerms>;
  const Ball offset(0x1p-10);
  for (std::int64_t k = 0; k < test::effort(20); ++k) {
    CAPTURE(k);
    const Sample sample(random);
    const ToneState<Model> series =
        checker::tone_step(sample.start<Model>(), Model(sample.frequency),
                           Model::linear(Ball(sample.phase), Ball(1.0)), sample.values<Model>());
    const ToneState<Ball> there = checker::tone_step(sample.start<Ball>(), Ball(sample.frequency),
                                                     Ball(sample.phase) + offset, sample.values<Ball>());
    for (std::size_t i = 0; i < kToneStates; ++i) {
      Ball sum;
      for (slong power = kTerms - 1; power >= 0; --power) {
        sum = sum * offset + series[i][power];
      }
      CHECK(std::fabs((sum - there[i]).near()) <= 1e-20 * (1.0 + std::fabs(there[i].near())));
    }
  }
}

#include "analysis/model/capture/capture_set.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/capture/capture_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr long double kTurn = 2.0L * std::numbers::pi_v<long double>;

long double followed_value(const CaptureModel& model, double s, double x, double y) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < CaptureModel::kTerms; ++i) {
    const auto& exponents = CaptureModel::Monomials::kExponents[i];
    sum += static_cast<long double>(model.coefficients()[i]) *
           std::pow(static_cast<long double>(s), exponents[0]) *
           std::pow(static_cast<long double>(x), exponents[1]) *
           std::pow(static_cast<long double>(y), exponents[2]);
  }
  return sum;
}

/// Followed for so many samples; random starts and noises of it must be where the set says.
void check_following(const test::CaptureExample& example, const StartBox& box, const PhaseCell& phases,
                     std::size_t samples, std::uint64_t stream) {
  CaptureModel x;
  CaptureModel y;
  FollowedSet set;
  {
    const rigor::UpwardRounding upward;
    CaptureTrack track(example.problem, phases);
    Follower follower(example.problem);
    set = follower.start(track, box);
    for (std::size_t k = 0; k < samples; ++k) {
      set = follower.step(track, set).set;
    }
    x = CaptureModel::variable(box.x, of_x);
    y = CaptureModel::variable(box.y, of_y);
  }
  REQUIRE(std::isfinite(set.radius));
  REQUIRE(set.sample == samples);
  test::Random random(stream);
  const test::PointTube tube(example.proved.tube);
  double largest_share = 0.0;
  for (std::int64_t round = 0; round < test::effort(200); ++round) {
    const bool is_corner = round < 8;
    const double s = is_corner ? (round % 2 == 0 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
    const double place_x = is_corner ? (round / 2 % 2 == 0 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
    const double place_y = is_corner ? (round / 4 % 2 == 0 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
    const long double phase =
        kTurn * (static_cast<long double>(phases.turn) +
                 static_cast<long double>(phases.half_turn) * static_cast<long double>(s));
    const double dx = x.constant() + x.linear(of_x) * place_x;
    const double dy = y.constant() + y.linear(of_y) * place_y;
    test::CaptureExample::State state = example.start(static_cast<double>(phase), dy, dx);
    for (std::size_t k = 1; k <= samples; ++k) {
      const double noise = example.problem.noise * (random.below(3) == 0   ? random.uniform(-1.0, 1.0)
                                                    : random.below(2) == 0 ? 1.0
                                                                           : -1.0);
      state = example.next(state, phase + static_cast<long double>(k) * 0.35, noise);
    }
    const double here =
        static_cast<double>(std::remainder(phase + static_cast<long double>(samples) * 0.35, kTurn));
    const long double theta = followed_value(set.middle[1], s, place_x, place_y);
    const long double turns = std::round((state.theta - theta) / kTurn);
    const Eigen::Vector2d off(
        static_cast<double>(state.w - followed_value(set.middle[0], s, place_x, place_y)),
        static_cast<double>(state.theta - turns * kTurn - theta));
    const double length = tube.shape(here, 0.35).triangularView<Eigen::Lower>().solve(off).norm();
    CHECK(length <= set.radius * (1.0 + 1e-9) + 1e-12);
    largest_share = std::max(largest_share, length / set.radius);
  }
  MESSAGE("errors reach " << largest_share << " of the radius " << set.radius);
  CHECK(largest_share > 1e-4);
}

TEST_CASE("random starts are where the followed set says") {
  const test::CaptureExample example;
  const auto around = [](double middle, double half) {
    return Interval::from_bounds(middle - half, middle + half);
  };
  check_following(example, {1, 0, around(0.5, 0.2), around(0.02, 0.01)}, {0.28125, 0.015625}, 1, 2200);
  check_following(example, {1, 0, around(0.5, 0.2), around(0.02, 0.01)}, {0.28125, 0.015625}, 60, 2201);
  check_following(example, {1, 0, around(-1.0, 0.1), around(-0.01, 0.005)}, {0.75, 0.03125}, 120, 2202);
}

TEST_CASE("and with noise") {
  const test::CaptureExample example(0.02);
  check_following(example, {1, 0, Interval::from_bounds(0.3, 0.4), Interval::from_bounds(0.0, 0.005)},
                  {0.40625, 0.015625}, 40, 2203);
}

TEST_CASE("parts of a box are the same set") {
  const rigor::UpwardRounding upward;
  const test::CaptureExample example;
  const PhaseCell phases{0.5, 0.015625};
  CaptureTrack track(example.problem, phases);
  Follower follower(example.problem);
  const StartBox outer{1, 0, Interval::from_bounds(0.2, 0.6), Interval::from_bounds(-0.01, 0.01)};
  const StartBox inner{1, 0, Interval::from_bounds(0.3, 0.4), Interval::from_bounds(0.005, 0.01)};
  FollowedSet whole = follower.start(track, outer);
  for (int k = 0; k < 20; ++k) {
    whole = follower.step(track, whole).set;
  }
  const FollowedSet part = part_of(whole, track.target(whole.sample), sub_box(outer, inner));
  CHECK(part.radius >= whole.radius);
  CHECK(part.radius < whole.radius + 1e-9);
  CHECK(part.sample == whole.sample);
  for (const double place : {-1.0, 0.3, 1.0}) {
    // x = 0.35 + 0.05 place of the inner box is 0.4 + 0.2 (-0.25 + 0.25 place) of the outer one.
    const long double inside = followed_value(part.middle[1], 0.5, place, -place);
    const long double outside =
        followed_value(whole.middle[1], 0.5, -0.25 + 0.25 * place, 0.75 - 0.25 * place);
    CHECK(std::fabs(inside - outside) < 1e-12L);
  }
  const CaptureModel level = follower.squared_level(track, whole);
  const CaptureModel of_part = substituted(level, sub_box(outer, inner));
  CHECK(level_bound(of_part.range(), part.radius) <= level_bound(level.range(), whole.radius) * (1.0 + 1e-9));
  CHECK(std::isnan(level_bound(Interval::empty(), 0.0)));
  CHECK(std::isnan(level_bound(Interval(1.0), NAN)));
}

TEST_CASE("what leaves the domain of the step is not known") {
  // At s = 0 the notch filter's gain divides by s1^2 + r/(p + q): a start with a negative variance may divide
  // by zero.
  const test::Example filter(test::notch_filter());
  const TubeSet set = prove_set(test::tone_of(filter.tracker), filter.model, 0.5999, 0.6001,
                                {.name = "starts", .deviations = {}});
  REQUIRE(set.is_complete);
  const CaptureProblem problem{&filter.model, &set.tubes.front().tube, set.tubes.front().levels.front(),
                               Interval(0.6), 0.0};
  const rigor::UpwardRounding upward;
  CaptureTrack track(problem, {0.5, 0.015625});
  Follower follower(problem);
  const FollowedSet start =
      follower.start(track, {0, 3, Interval::from_bounds(-0.1, 0.1), Interval::from_bounds(-1.0, 1.0)});
  CHECK_FALSE(std::isfinite(follower.step(track, start).set.radius));
  FollowedSet unknown = follower.start(track, {0, 3, Interval(0.0), Interval(0.0)});
  CHECK(std::isfinite(follower.step(track, unknown).set.radius));
  unknown.radius = NAN;
  CHECK_FALSE(std::isfinite(follower.step(track, unknown).set.radius));
}

}  // namespace
}  // namespace veritrack::model

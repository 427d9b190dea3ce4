// The bounds on the errors of the estimates of five and more filters, against the observer that runs.
#include "checker/kkl_observer/projected_cells.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::ProjectedCells;

constexpr double kToneFrequency = 3.0;
constexpr double kToneAmplitude = 2.0;
constexpr double kSettled = 14.0;

template <int M>
using Rates = Eigen::Matrix<double, M, 1>;

template <int M>
checker::KklDesign design_of() {
  checker::KklDesign design;
  for (const double rate : Rates<M>::LinSpaced(1.0, M).eval()) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = design.frequency_high = Ball(kToneFrequency);
  design.amplitude_low = design.amplitude_high = Ball(kToneAmplitude);
  return design;
}

/// What goes wrong with the estimates of M filters.
template <int M>
struct ErrorsOf {
  Rates<M> lambda = Rates<M>::LinSpaced(1.0, M);
  double frequency = 0.0, amplitude = 0.0, least_square = HUGE_VAL, least_ratio = HUGE_VAL;

  /// Filters at the signal's steady state plus `moves`.
  void look(double phase, const Rates<M>& moves) {
    constexpr double kSmallestEll = 1e-9;
    const auto x = trackers::oscillator_state(kToneAmplitude, phase, kToneFrequency);
    const Rates<M> xi = trackers::kkl_transform<double, M>(x, lambda) + moves;
    const auto found = trackers::kkl_inverse<double, M>(xi, {lambda, kSmallestEll});
    const auto estimate = trackers::in_engineering_units(found);
    frequency = std::max(frequency, std::fabs(estimate.frequency - kToneFrequency));
    amplitude = std::max(amplitude, std::fabs(estimate.amplitude - kToneAmplitude));
    least_square = std::min(least_square, found(2) / x(2));
    least_ratio =
        std::min(least_ratio, 2.0 * trackers::kkl_excitation<double, M>(xi, lambda) / xi.squaredNorm());
  }

  /// What is left of the signal's start.
  Rates<M> rest(test::Random& random) const {
    Rates<M> rest;
    for (int i = 0; i < M; ++i) {
      rest(i) = random.uniform(-1.0, 1.0) * std::exp(-lambda(i) * kSettled) * kToneAmplitude /
                std::hypot(lambda(i), kToneFrequency);
    }
    return rest;
  }
};

/// All bounds are proved with room to spare, and none that was seen broken.
template <int M>
void check_bounds(const checker::KklDesign& design, const ErrorsOf<M>& seen, double room, double more) {
  const ProjectedCells cells(design, Ball(kSettled));
  const auto is_proved = [&](auto statement, double bound) {
    return cells.always(
        [&](const checker::ProjectedCell& cell) { return (cells.*statement)(cell, Ball(bound)); });
  };
  const auto amplitude_is_proved = [&](double bound) {
    return cells.always([&](const checker::ProjectedCell& cell) {
      return cells.amplitude_error_at_most(cell, Ball(bound), Ball(room * seen.frequency));
    });
  };
  CHECK(is_proved(&ProjectedCells::frequency_error_at_most, room * seen.frequency));
  CHECK(amplitude_is_proved(more * seen.amplitude));
  CHECK(is_proved(&ProjectedCells::relative_square_at_least, 1.0 - room * (1.0 - seen.least_square)));
  CHECK(is_proved(&ProjectedCells::ratio_at_least, seen.least_ratio / more));
  CHECK(!is_proved(&ProjectedCells::frequency_error_at_most, 0.95 * seen.frequency));
  CHECK(!amplitude_is_proved(0.95 * seen.amplitude));
  CHECK(!is_proved(&ProjectedCells::relative_square_at_least, 1.0 - 0.95 * (1.0 - seen.least_square)));
  CHECK(!is_proved(&ProjectedCells::ratio_at_least, seen.least_ratio / 0.95));
}

template <int M>
void check_sinusoid(double lowest, double room, double more) {
  CAPTURE(M);
  test::Random random(151);
  constexpr double kDisturbing = 0.2;
  ErrorsOf<M> seen;
  for (std::int64_t i = 0; i < test::effort(40'000); ++i) {
    const auto other = trackers::oscillator_state(kDisturbing, random.uniform(0.0, 6.3),
                                                  lowest * (1.0 + 0.1 * std::pow(random.uniform(), 4.0)));
    seen.look(random.uniform(0.0, 6.3),
              trackers::kkl_transform<double, M>(other, seen.lambda) + seen.rest(random));
  }
  checker::KklDesign disturbed = design_of<M>();
  disturbed.disturbance_amplitude = Ball(kDisturbing);
  disturbed.disturbance_frequency = Ball(lowest);
  check_bounds<M>(disturbed, seen, room, more);
}

template <int M>
void check_bounded(double bound, double room, double more) {
  CAPTURE(M);
  test::Random random(152);
  constexpr double kStep = 0.02;
  ErrorsOf<M> seen;
  for (std::int64_t i = 0; i < test::effort(3'000); ++i) {
    // The worst on-off input for a function of the filters that sees the frequency, to first order.
    const double phase = random.uniform(0.0, 6.3);
    const auto x = trackers::oscillator_state(1.0, phase, kToneFrequency);
    const Rates<M> transformed = trackers::kkl_transform<double, M>(x, seen.lambda);
    Eigen::Matrix<double, M, 2> plane;
    plane << seen.lambda, Rates<M>::Ones();
    const Rates<M> across =
        transformed - plane * (plane.transpose() * plane).inverse() * (plane.transpose() * transformed);
    const Rates<M> driven = across.array() * (seen.lambda.array().square() + kToneFrequency * kToneFrequency);
    Rates<M> moves = Rates<M>::Zero();
    for (double t = 0.5 * kStep; t < 12.0; t += kStep) {
      const Rates<M> kernel = (-seen.lambda * t).array().exp();
      moves += (driven.dot(kernel) > 0.0 ? bound : -bound) * kStep * kernel;
    }
    for (const double sign : {1.0, -1.0}) {
      seen.look(phase, sign * moves + seen.rest(random));
    }
    for (int k = 0; k < 5; ++k) {
      seen.look(random.uniform(0.0, 6.3), moves + seen.rest(random));
    }
  }
  checker::KklDesign disturbed = design_of<M>();
  disturbed.bound = Ball(bound);
  check_bounds<M>(disturbed, seen, room, more);
}

}  // namespace

TEST_CASE("more than four filters: a sinusoid of any phase, from its lowest frequency up") {
  check_sinusoid<5>(100.0, 1.1, 1.4);
  check_sinusoid<8>(50.0, 1.15, 1.7);
  // What is not linear in the disturbance is a part of the errors here.
  check_sinusoid<5>(10.0, 1.2, 1.8);
}

TEST_CASE("more than four filters: a disturbance of which only a bound is known") {
  check_bounded<5>(0.002, 1.15, 1.6);
  check_bounded<6>(0.01, 1.6, 2.2);
}

TEST_CASE("more than four filters: where y may vanish, nothing is proved") {
  checker::KklDesign disturbed = design_of<5>();
  disturbed.bound = Ball(0.3);
  const ProjectedCells cells(disturbed, Ball(kSettled));
  int looked_at = 0;
  const auto is_proved = [&](const auto& statement) {
    return cells.always([&](const checker::ProjectedCell& cell) {
      // What is not true of a point is not true of a smaller cell.
      return ++looked_at < 200 && statement(cell);
    });
  };
  CHECK(!is_proved([&](const auto& cell) { return cells.frequency_error_at_most(cell, Ball(3.0)); }));
  CHECK(!is_proved([&](const auto& cell) { return cells.ratio_at_least(cell, Ball(1e-9)); }));
  CHECK(!is_proved([&](const auto& cell) { return cells.relative_square_at_least(cell, Ball(1e-9)); }));
  CHECK(!is_proved(
      [&](const auto& cell) { return cells.amplitude_error_at_most(cell, Ball(9.0), Ball(2.0)); }));
}

TEST_CASE("the direction of y and the projection are those of the filters") {
  // NN'T is what [lambda 1]^+ leaves of T; its length is what the statement on the ratio is about.
  const ProjectedCells cells(design_of<6>(), Ball(kSettled));
  int looked_at = 0;
  const bool all = cells.always([&](const checker::ProjectedCell& cell) {
    ++looked_at;
    const double phase = 0.5 * std::acos(-1.0);
    const Rates<6> lambda = Rates<6>::LinSpaced(1.0, 6);
    const Rates<6> transformed =
        trackers::kkl_transform<double, 6>(trackers::oscillator_state(1.0, phase, kToneFrequency), lambda);
    Eigen::Matrix<double, 6, 2> plane;
    plane << lambda, Rates<6>::Ones();
    const Rates<6> across =
        transformed - plane * (plane.transpose() * plane).inverse() * (plane.transpose() * transformed);
    for (int i = 0; i < 6; ++i) {
      const auto k = static_cast<std::size_t>(i);
      CHECK(cell.middle.transformed[k].near() == doctest::Approx(transformed(i)).epsilon(1e-9));
      CHECK(cell.middle.across[k].near() == doctest::Approx(across(i)).epsilon(1e-6).scale(1e-6));
    }
    CHECK(cell.middle.squared_norm.near() == doctest::Approx(across.squaredNorm()).epsilon(1e-6));
    return true;  // of the whole range, whose middle is a quarter of a turn
  });
  CHECK(all);
  CHECK(looked_at == 1);
}

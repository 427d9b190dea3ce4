#include "analysis/model/capture/capture_track.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kTone = 0.3125;

/// A tube around 0.3 rad/sample that nothing has proposed.
Tube tube_on_track() {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.03125;
  tube.turns = {0, 1};
  tube.curve = {{{{0.3, 0.03125}, {}, {{0.0, -0.01}}}}, {{{0.01, 0.002}, {}, {0.03, {0.0, 0.01}}}}};
  tube.shape = {
      {{{0.5, 0.0625}, {}, {0.0625}}}, {{{0.25}, {{0.0, 0.0625}}}}, {{{1.5}, {}, {{0.125, 0.0625}}}}};
  return tube;
}

/// What is off at a place of the phase in its cell, beyond the remainder of the model; x and y are not there.
template <typename Model>
double beyond(const Model& model, double s, double value) {
  double sum = 0.0;
  for (std::size_t i = 0; i < Model::kTerms; ++i) {
    const auto& exponents = Model::Monomials::kExponents[i];
    if (exponents[of_x] != 0 || exponents[of_y] != 0) {
      REQUIRE(model.coefficients()[i] == 0.0);
    } else {
      sum += model.coefficients()[i] * std::pow(s, exponents[of_phase]);
    }
  }
  return std::fabs(value - sum) - model.remainder();
}

/// 2 pi (turn + s half_turn) + k omega.
double phase_at(const PhaseCell& cell, double s, std::size_t k) {
  return 2.0 * std::numbers::pi * (cell.turn + s * cell.half_turn) + static_cast<double>(k) * kTone;
}

TEST_CASE("samples and tube on the track are those of each phase in the cell, up to the remainders") {
  const test::Example loop(test::phase_locked_loop());
  const Tube tube = tube_on_track();
  const CaptureProblem problem{&loop.model, &tube, 0.01, Interval(kTone), 0.02};
  const test::PointTube points(tube);
  test::Random random(67);
  const rigor::UpwardRounding upward;
  constexpr double kRounding = 1e-13;  // of the sums here
  for (const PhaseCell& cell : {PhaseCell{0.28125, 0.03125}, PhaseCell{0.984375, 0.015625}}) {
    CaptureTrack track(problem, cell);
    for (const std::size_t k : {std::size_t{7}, std::size_t{0}, std::size_t{40}}) {
      const CaptureTarget& target = track.target(k);
      CHECK(track.sample_errors(k) == 0.02);
      CHECK(track.samples(k).front().remainder() < 1e-4);
      const double phase_of_middle = phase_at(cell, 0.0, k);
      const double turns = std::round((target.curve[1].constant() - points.curve(phase_of_middle, kTone)[1]) /
                                      (2.0 * std::numbers::pi));
      CHECK(std::fabs(target.middle.curve[0] - points.curve(phase_of_middle, kTone)[0]) < kRounding);
      for (int trial = 0; trial < 20; ++trial) {
        const double s = random.uniform(-1.0, 1.0);
        const double phase = phase_at(cell, s, k);
        CHECK(beyond(track.samples(k).front(), s, std::cos(phase)) <= kRounding);
        const Eigen::VectorXd curve = points.curve(phase, kTone);
        CHECK(beyond(target.curve[0], s, curve[0]) <= kRounding);
        CHECK(beyond(target.curve[1], s, curve[1] + 2.0 * std::numbers::pi * turns) <= kRounding);
        const Eigen::MatrixXd shape = points.shape(phase, kTone);
        const Eigen::MatrixXd inverse = oracle::inverse(shape);
        for (std::size_t i = 0, number = 0; i < 2; ++i) {
          const auto row = static_cast<Eigen::Index>(i);
          for (std::size_t j = 0; j <= i; ++j, ++number) {
            const auto column = static_cast<Eigen::Index>(j);
            CHECK(beyond(target.shape[number], s, shape(row, column)) <= kRounding);
            CHECK(beyond(target.shape_slopes(i, j), s, shape(row, column)) <= kRounding);
            CHECK(beyond(target.inverse_slopes(i, j), s, inverse(row, column)) <= kRounding);
          }
          CHECK(beyond(target.reciprocal[i], s, 1.0 / shape(row, row)) <= kRounding);
          CHECK(target.row_length[i] >= shape.row(row).norm() - kRounding);
          CHECK(target.row_length[i] <= 1.1 * shape.row(row).norm());
        }
      }
    }
  }
}

TEST_CASE("an amplitude that varies is an error of the samples, beside the noise") {
  test::Example loop(test::phase_locked_loop());
  loop.model.amplitude = Interval::from_bounds(0.75, 1.25);
  loop.model.amplitude_varies = true;
  const Tube tube = tube_on_track();
  const CaptureProblem problem{&loop.model, &tube, 0.01, Interval(kTone), 0.0625};
  const rigor::UpwardRounding upward;
  const PhaseCell cell{0.0, 0.0078125};
  CaptureTrack track(problem, cell);
  // At phase 0 the samples are between 0.75 and 1.25.
  CHECK(track.sample_errors(0) >= 0.0625 + 0.25);
  CHECK(track.sample_errors(0) <= 0.0625 + 0.251);
  CHECK(track.samples(0).front().remainder() < 1e-9);
  CHECK(std::fabs(track.samples(0).front().constant() - 1.0) < 1e-3);
}

TEST_CASE("a track is for trackers of at most four states, whose tube fits") {
  const test::Example filter(test::kalman_filter(1, 0.0023, 0.05));
  Tube tube = tube_on_track();
  const rigor::UpwardRounding upward;
  const CaptureProblem other{&filter.model, &tube, 0.01, Interval(kTone), 0.0};
  CHECK_THROWS_AS(CaptureTrack(other, {}), std::invalid_argument);
  tube.turns.assign(9, 0);
  tube.curve.assign(9, PhaseSeries{{{0.5}}});
  tube.shape.assign(45, PhaseSeries{{{0.5}}});
  CHECK_THROWS_AS(CaptureTrack(other, {}), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model

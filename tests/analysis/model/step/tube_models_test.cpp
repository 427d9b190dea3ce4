#include "analysis/model/step/tube_models.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;

PhaseSeries random_series(test::Random& random, double constant) {
  PhaseSeries series;
  for (std::size_t h = 0; h < 4; ++h) {
    series.coefficients.emplace_back();
    for (std::size_t d = 0; d < 5 - h; ++d) {
      const double size = std::pow(0.3, static_cast<double>(h + d));
      series.coefficients.back().emplace_back(size * random.uniform(-1.0, 1.0),
                                              size * random.uniform(-1.0, 1.0));
    }
  }
  series.coefficients[0][0] = constant;
  return series;
}

Tube random_tube(test::Random& random, double frequency) {
  Tube tube;
  tube.frequency = frequency;
  tube.half_width = 0.05;
  tube.turns = {0, 1};
  tube.curve = {random_series(random, 0.3), random_series(random, 0.1)};
  tube.shape = {random_series(random, 3.0), random_series(random, 0.0), random_series(random, 4.0)};
  return tube;
}

/// Everything near this phase and this z.
struct Near {
  BallModel phase, z;
  Near(double at_phase, double at_z)
      : phase(BallModel(at_phase) + BallModel(0.05) * BallModel::s()),
        z(BallModel(at_z) + BallModel(0.02) * BallModel::z()) {}
};

TEST_CASE("curves, shapes and their differences contain the values nearby") {
  test::Random random(31);
  const rigor::BallModelScope scope(2, 0);
  for (int trial = 0; trial < 20; ++trial) {
    const Tube tube = random_tube(random, 0.3);
    const Tube other = random_tube(random, 0.4);
    const double phase = random.uniform(0.0, 2.0 * M_PI);
    const double z = random.uniform(-1.0, 1.0);
    const Near near(phase, z);
    const TubeHere here = tube_at(tube, near.phase, near.z);
    const TubeHere difference = tube_difference(tube, near.z, other, near.z - BallModel(2.0), near.phase);
    const TubeHere none = tube_difference(tube, near.z, tube, near.z, near.phase);
    for (int sample = 0; sample < 20; ++sample) {
      const double at = phase + 0.05 * random.uniform(-1.0, 1.0);
      const double frequency = 0.3 + 0.05 * (z + 0.02 * random.uniform(-1.0, 1.0));
      const test::PointTube point(tube);
      const test::PointTube point_of_other(other);
      const Eigen::VectorXd curve = point.curve(at, frequency);
      const Eigen::MatrixXd shape = point.shape(at, frequency);
      const Eigen::VectorXd change = curve - point_of_other.curve(at, frequency);
      const Eigen::MatrixXd change_of_shape = shape - point_of_other.shape(at, frequency);
      const auto contains = [](const BallModel& model, double value) {
        return model.range().lower() - 1e-9 <= value && value <= model.range().upper() + 1e-9;
      };
      for (std::size_t i = 0; i < 2; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        CHECK(contains(here.curve[i], curve[row]));
        CHECK(contains(difference.curve[i], change[row]));
        CHECK(none.curve[i].range().upper() < 1e-12);
        for (std::size_t j = 0; j <= i; ++j) {
          const auto column = static_cast<Eigen::Index>(j);
          CHECK(contains(here.shape[i * (i + 1) / 2 + j], shape(row, column)));
          CHECK(contains(difference.shape[i * (i + 1) / 2 + j], change_of_shape(row, column)));
        }
      }
    }
  }
}

TEST_CASE("U^-1 U x is x, and a shape that can vanish has no inverse") {
  test::Random random(37);
  const rigor::BallModelScope scope(2, 0);
  const Tube tube = random_tube(random, 0.3);
  const Near near(1.0, 0.2);
  TubeHere here = tube_at(tube, near.phase, near.z);
  std::vector<BallModel> change = state_in(here, 1.0);
  for (std::size_t i = 0; i < 2; ++i) {
    change[i] = change[i] - here.curve[i];
  }
  const std::vector<BallModel> back = in_units_of(here, change);
  for (std::size_t i = 0; i < 2; ++i) {
    const BallModel rest = back[i] - BallModel::ball(static_cast<int>(i));
    CHECK(rest.range().upper() < 1e-3);
  }
  here.shape[2] = here.shape[2] - BallModel(here.shape[2].constant());
  CHECK_FALSE(std::isfinite(in_units_of(here, here.curve)[1].error()));
}

}  // namespace
}  // namespace veritrack::model

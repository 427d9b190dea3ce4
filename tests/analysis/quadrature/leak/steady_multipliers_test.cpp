// Rates of a cell against steps that are found by climbing.
#include "analysis/quadrature/leak/steady_multipliers.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

TEST_CASE("no step of a cell is longer than the rate of its multipliers, and that is not much longer") {
  test::Random random(92);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size),
                           random.uniform(-size, size));
  };
  for (std::int64_t trial = 0; trial < test::effort(40); ++trial) {
    CAPTURE(trial);
    const Eigen::Vector3d hidden = vector(0.3);
    const Eigen::Vector3d image = vector(0.3);
    Eigen::Matrix3d spread;
    spread << vector(0.1), vector(0.1), vector(0.1);
    Eigen::Matrix<double, 3, 2> noise;
    noise << vector(0.1), vector(0.1);
    SteadyCellReach cell;
    cell.slopes << vector(0.4), vector(0.4);
    cell.middle << random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6);
    const double size = std::exp(random.uniform(-4.0, 0.0));
    const double eta = random.uniform(0.1, 1.0);
    const double v = random.uniform(0.1, 1.0);
    cell.size_squared = size * size;
    cell.reach.image = {image[0], image[1], image[2]};
    cell.reach.hidden = {hidden[0], hidden[1], hidden[2]};
    cell.reach.gram = Symmetric<double>::from_matrix(spread * spread.transpose());
    cell.reach.noise = Symmetric<double>::from_matrix(noise * noise.transpose());
    cell.reach.eta_squared = eta * eta;
    cell.reach.noise_squared = v * v;
    const SteadyRate found = propose_cell_rate(cell, 0.0);
    double longest = 0.0;
    for (int start = 0; start < 200; ++start) {
      // A place in the cell and in the disc, and from there the sum as its own direction.
      const double angle = random.uniform(-4.0, 4.0);
      const double away = size * std::sqrt(random.uniform(0.0, 1.0));
      const Eigen::Vector2d way(away * std::cos(angle), away * std::sin(angle));
      const double room = 1.0 - (cell.middle + way).squaredNorm();
      if (room < 0.0) {
        continue;
      }
      const Eigen::Vector3d base = image + cell.slopes * way;
      Eigen::Vector3d d = base;
      for (int i = 0; i < 30; ++i) {
        d.normalize();
        const Eigen::Vector3d along_spread = spread.transpose() * d;
        const Eigen::Vector2d along_noise = noise.transpose() * d;
        const double sign = hidden.dot(d) < 0.0 ? -1.0 : 1.0;
        d = base + sign * std::sqrt(room) * hidden + eta * (spread * along_spread.normalized()) +
            v * (noise * along_noise.normalized());
        longest = std::max(longest, d.squaredNorm());
      }
    }
    CHECK(found.rate_squared >= longest * (1.0 - 1e-9));
    CHECK(found.rate_squared <= 1.6 * longest);
    const SteadyMultipliers& m = found.multipliers;
    CHECK(std::min({m.hidden, m.spread, m.noise, m.cell}) > 0.0);
  }
}

}  // namespace
}  // namespace veritrack::quadrature

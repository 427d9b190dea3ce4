// A part of a loop's frequencies, attacked: what one sample does to random errors, at random phases and
// frequencies and with random noise, is within its matrix, columns, remainders and residual. Curves and
// bases are no steady states.
#include "analysis/model/gain/phase_part.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "tests/analysis/model/floquet_points.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

struct PartCase {
  const test::ExampleTracker* tracker;
  const TrackerModel* model;
  TrackedTone tone;
  double low, high, errors;
  double disturbance;  ///< of the cell
};

FloquetCell random_cell(const PartCase& of, test::Random& random) {
  const auto cell = propose_floquet_cell(of.tone, FloquetGauge::by_mode, of.low, of.high);
  REQUIRE(cell);
  return test::disturbed(*cell, of.disturbance, random);
}

/// One sample at a constant frequency.
double attack_part(const PartCase& of, std::uint64_t stream) {
  test::Random random(stream);
  const FloquetCell cell = random_cell(of, random);
  const rigor::UpwardRounding upward;
  const auto part = phase_part(*of.model, cell,
                               of.disturbance > 0.0 ? PhaseGridding{32, 0, 4} : PhaseGridding{128, 0, 64}, 2);
  REQUIRE(part);
  const test::FloquetPoints points(*of.tracker, cell);
  const auto n = static_cast<Eigen::Index>(part->states);
  std::int64_t bounded = 0;
  double reached = 0.0;
  const std::int64_t trials = test::effort(100);
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const test::PartPlace at(*part, random);
    const double size = of.errors * std::pow(10.0, random.uniform(-2.0, 0.0));
    const Eigen::VectorXd eta = test::random_vector(random, n, size);
    const Eigen::VectorXd noise = test::random_vector(random, of.tracker->recursion.samples, 0.2 * size);
    const Eigen::MatrixXd slopes = points.slopes(at.phase, at.frequency);
    const Eigen::MatrixXd inverse = points.basis(at.phase + at.frequency, at.frequency).inverse();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd residual =
        points.after(at.phase, at.frequency, at.frequency, none, Eigen::VectorXd::Zero(noise.size()));
    const Eigen::VectorXd next = points.after(at.phase, at.frequency, at.frequency, eta, noise);
    const Eigen::VectorXd state = points.curve(at.phase, at.frequency);
    constexpr double kRoom = 1e-8;  // of differences
    CHECK(rigor::contains(part->cells[at.cell].bias + rigor::Interval::from_bounds(-1e-12, 1e-12),
                          points.frequency_of(state) - at.frequency));
    const std::vector<double> sizes = test::part_sizes(*part, at, eta, noise);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto row = static_cast<std::size_t>(i);
      for (Eigen::Index j = 0; j < n; ++j) {
        const std::size_t entry = row * part->states + static_cast<std::size_t>(j);
        const double line = part->middle[entry] + at.t * part->lean[entry];
        REQUIRE(std::fabs(slopes(i, j) - line) <= part->off[entry] + kRoom);
        REQUIRE(slopes(i, j) >= part->matrix[entry].lower() - kRoom);
        REQUIRE(slopes(i, j) <= part->matrix[entry].upper() + kRoom);
        REQUIRE(std::fabs(inverse(i, j)) <= part->inverse[entry] * (1.0 + 1e-9));
      }
      for (Eigen::Index c = 0; c < noise.size(); ++c) {
        const GridFunction& column = part->noise[static_cast<std::size_t>(c)];
        REQUIRE(std::fabs(slopes(i, n + c) - at.line(column, row)) <= column.error[row] + kRoom);
      }
      REQUIRE(std::fabs(residual(i)) <= part->residual[row] + 1e-12);
      double room = part->residual[row];
      for (const auto& [input, column] : part->columns) {
        room +=
            (std::fabs(at.line(column, row)) + column.error[row]) * sizes[static_cast<std::size_t>(input)];
      }
      const double linear = slopes.row(i).head(n).dot(eta) + slopes.row(i).tail(noise.size()).dot(noise);
      if (room < INFINITY) {
        ++bounded;
        reached = std::max(reached, std::fabs(next(i) - linear) / room);
        REQUIRE(std::fabs(next(i) - linear) <= room + kRoom * size + 1e-12);
      }
    }
  }
  CHECK(bounded > trials);
  return reached;
}

/// What the widened part says of the errors after a sample: a line, and how far they may be from it.
std::pair<Eigen::VectorXd, Eigen::VectorXd> slewed_line(const PhasePart& part, const test::PartPlace& at,
                                                        const Eigen::VectorXd& eta,
                                                        const Eigen::VectorXd& noise, double moved) {
  const std::vector<double> sizes = test::part_sizes(part, at, eta, noise);
  const Eigen::Index n = eta.size();
  Eigen::VectorXd line = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd room = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    line(i) = at.line(part.noise[0], row) * noise(0) + at.line(part.slew, row) * moved;
    room(i) = part.residual[row] + part.noise[0].error[row] * std::fabs(noise(0)) +
              part.slew.error[row] * std::fabs(moved);
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::size_t entry = row * part.states + static_cast<std::size_t>(j);
      line(i) += part.middle[entry] * eta(j);
      room(i) += part.off[entry] * std::fabs(eta(j));
    }
    for (const auto& [input, column] : part.columns) {
      room(i) +=
          (std::fabs(at.line(column, row)) + column.error[row]) * sizes[static_cast<std::size_t>(input)];
    }
  }
  return {line, room};
}

/// A curve that bends over the frequency.
FloquetCell bent_curve(FloquetCell cell) {
  std::vector<std::complex<double>>& mean = cell.curve.curve[0].coefficients[0];
  mean.resize(std::max<std::size_t>(mean.size(), 3));
  mean[2] += 0.01;
  return cell;
}

/// A basis that bends over the frequency, where what a step does to errors does not change: it is multiplied
/// by 1 + 0.2 z + 2 z^2.
FloquetCell bent_basis(FloquetCell cell) {
  for (PhaseSeries& each : cell.basis) {
    for (auto& of_harmonic : each.coefficients) {
      of_harmonic.resize(of_harmonic.size() + 2);
      for (std::size_t d = of_harmonic.size(); d-- > 1;) {
        of_harmonic[d] += 0.2 * of_harmonic[d - 1] + (d > 1 ? 2.0 * of_harmonic[d - 2] : 0.0);
      }
    }
  }
  return cell;
}

}  // namespace

TEST_CASE("one sample of a loop is within the matrix, the columns and the remainders of its part") {
  const test::Example one(test::phase_locked_loop(0.02));
  const test::Example integrator(test::integrator_loop());
  const test::TwoChannelExample two(test::angle_loop());
  for (const double share : {0.0, 0.002}) {
    CHECK(attack_part({&one.tracker, &one.model, test::tone_of(one.tracker), 0.29, 0.31, 0.3, share}, 301) >
          0.7);
    CHECK(attack_part({&integrator.tracker, &integrator.model, test::tone_of(integrator.tracker), 0.03, 0.032,
                       1.0, share},
                      302) > 0.3);
    CHECK(attack_part({&two.tracker, &two.model, two.tone, 0.29, 0.31, 0.3, share}, 303) > 0.1);
  }
}

TEST_CASE("a frequency that moves after the sample is within what a slew adds") {
  const test::Example loop(test::phase_locked_loop(0.02));
  constexpr double kSlew = 1e-3;
  test::Random random(304);
  const PartCase of{&loop.tracker, &loop.model, test::tone_of(loop.tracker), 0.29, 0.31, 0.3, 0.0};
  const FloquetCell plain = random_cell(of, random);
  const rigor::UpwardRounding upward;
  for (const FloquetCell& cell : {bent_curve(plain), bent_basis(plain)}) {
    auto still = phase_part(loop.model, cell, {128, 0, 256}, 128);
    REQUIRE(still);
    const auto part = with_slew(*std::move(still), kSlew);
    REQUIRE(part);
    const test::FloquetPoints points(loop.tracker, cell);
    double reached = 0.0;
    for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
      const test::PartPlace at(*part, random);
      // One of them alone shows more.
      const auto size = [&](double most) {
        return random.below(2) == 0 ? 0.0 : most * std::pow(10.0, random.uniform(-2.0, 0.0));
      };
      const Eigen::VectorXd eta = test::random_vector(random, 2, size(0.1));
      const Eigen::VectorXd noise = test::random_vector(random, 1, size(0.1));
      const double moved = random.below(2) == 0 ? kSlew : random.uniform(-kSlew, kSlew);
      const Eigen::VectorXd next = points.after(at.phase, at.frequency, at.frequency + moved, eta, noise);
      const auto [line, room] = slewed_line(*part, at, eta, noise, moved);
      const Eigen::VectorXd far = (next - line).cwiseAbs();
      for (const Eigen::Index i : {0, 1}) {
        REQUIRE(far(i) <= room(i) * (1.0 + 1e-9) + 1e-12);
        reached = std::max(reached, far(i) / room(i));
      }
    }
    CHECK(reached > 0.5);
    CHECK_FALSE(with_slew(*part, 1.0));  // as large as the frequencies over which the basis changes
  }
}

}  // namespace veritrack::model

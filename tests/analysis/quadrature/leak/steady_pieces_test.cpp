// Sets for pieces of a band: they cover it, verify again, and the textbook filter stays in them.
#include "analysis/quadrature/leak/steady_pieces.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/leak/steady_verification.hpp"
#include "tests/analysis/quadrature/polar_simulation.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;
using test::Polar;
using test::Simulation;

sets::ContractionQuestion question_in_pieces() {
  sets::ContractionQuestion question;
  question.design = {Interval(0.0023), Interval(0.0023), Interval(0.05), Interval(0.01)};
  question.noise = Interval(0.001);
  question.search_evaluations = 25;
  return question;
}

sets::LockBranch branch_of_pieces(double from, double to) {
  return sets::verify_lock_branch(question_in_pieces().design, Interval::from_bounds(from, to),
                                  {.largest = 0.05});
}

TEST_CASE("the pieces cover the band without gaps, and each is verified again") {
  const sets::ContractionQuestion question = question_in_pieces();
  const sets::LockBranch branch = branch_of_pieces(2.7, 2.9);
  REQUIRE(branch.verdict == Verdict::proved);
  double SteadyRequest::*size = nullptr;
  SUBCASE("noise") {
    size = &SteadyRequest::noise;
  }
  SUBCASE("radius") {
    size = &SteadyRequest::radius;
  }
  const std::vector<SteadyPiece> pieces = search_steady_pieces(question, branch, size, 0.0);
  REQUIRE(pieces.size() > 1);
  CHECK(pieces.front().from <= 2.7);
  CHECK(pieces.back().to >= 2.9);
  test::Random random(94);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const SteadyPiece& piece = pieces[k];
    CAPTURE(piece.from);
    CHECK(piece.from < piece.to);
    CHECK((k == 0 || piece.from == pieces[k - 1].to));
    CHECK(piece.set.slew == 0.0);
    CHECK(piece.set.noise >= 0.001);
    const sets::LockBranch part = branch_of_pieces(piece.from, piece.to);
    CHECK(verify_steady_set(question.design, part.cells, piece.set).verdict == Verdict::proved);

    const rigor::NearestRounding nearest;
    for (std::int64_t run = 0; run < test::effort(4); ++run) {
      Simulation simulation(question.design, Polar::Zero(), random.uniform(piece.from, piece.to));
      const Eigen::Vector3d direction(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                      random.uniform(-1.0, 1.0));
      const Polar steady = test::steady_state(simulation, part.cells, question.design);
      Polar start = steady;
      start.head<3>() += piece.set.metric.inverse() * direction.normalized();
      simulation = Simulation(question.design, start, simulation.frequency);
      for (int sample = 0; sample < 40; ++sample) {
        const double angle = random.uniform(0.0, 6.28);
        simulation.step(piece.set.noise * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.0);
        const Polar deviation = simulation.state() - steady;
        CHECK((piece.set.metric * deviation.head<3>()).norm() <= 1.0 + 1e-9);
      }
    }
  }
}

TEST_CASE("a band below zero has its hard end first") {
  const sets::LockBranch branch = branch_of_pieces(-2.9, -2.8);
  REQUIRE(branch.verdict == Verdict::proved);
  const auto pieces = search_steady_pieces(question_in_pieces(), branch, &SteadyRequest::noise, 0.0);
  REQUIRE_FALSE(pieces.empty());
  CHECK(pieces.front().from <= -2.9);
  CHECK(pieces.back().to >= -2.8);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    CHECK(pieces[k].from == pieces[k - 1].to);
  }
}

TEST_CASE("nothing is found that is not larger than what is known, nor without a branch") {
  CHECK(search_steady_pieces(question_in_pieces(), branch_of_pieces(2.8, 2.9), &SteadyRequest::noise, 1.0)
            .empty());
  CHECK(search_steady_pieces(question_in_pieces(), {}, &SteadyRequest::noise, 0.0).empty());
}

}  // namespace
}  // namespace veritrack::quadrature

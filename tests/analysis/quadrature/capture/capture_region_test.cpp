#include "analysis/quadrature/capture/capture_region.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <limits>
#include <stdexcept>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "tests/analysis/quadrature/capture/capture_support.hpp"

namespace {

using namespace veritrack;
using quadrature::CertifiedSetTarget;
using quadrature::Region;
using quadrature::RegionCell;
using quadrature::RegionOptions;
using rigor::Verdict;
using test::Interval;
using test::StartBox;

bool is_in(const StartBox& box, double amplitude, double phase, double frequency) {
  return contains(box.amplitude_error, amplitude) && contains(box.phase_error, phase) &&
         contains(box.frequency_error, frequency);
}

double length(const Interval& range) {
  return range.upper() - range.lower();
}

Region prove(std::size_t example, const StartBox& starts, const RegionOptions& options) {
  const auto& design = test::capture_examples()[example];
  return prove_region(test::capture_problem(design), CertifiedSetTarget(test::target_set(design), true),
                      starts, options);
}

TEST_CASE("the cells tile the starts, and members of proved cells lock in simulation") {
  const StartBox starts{Interval(0.0), test::around(0.0, 1.5), Interval::from_bounds(-0.2, 1.2)};
  RegionOptions options;
  options.first_cells = {3, 4, 5};
  options.most_halvings = 5;  // too few for all of it: undecided cells remain
  const Region region = prove(0, starts, options);
  double area = 0.0;
  double proved = 0.0;
  test::Random random(31);
  const auto problem = test::capture_problem(test::capture_examples()[0]);
  const auto set = test::target_set(test::capture_examples()[0]);
  for (const RegionCell& cell : region.cells) {
    const double cell_area = length(cell.starts.phase_error) * length(cell.starts.frequency_error);
    area += cell_area;
    CHECK(cell.verdict != Verdict::refuted);
    if (cell.verdict == Verdict::proved) {
      proved += cell_area;
      test::TrackedRun run(problem, 0.3, 0.0, test::member(cell.starts.phase_error, random),
                           test::member(cell.starts.frequency_error, random));
      for (int k = 0; k < cell.result.samples; ++k) {
        run.step();
      }
      CHECK(run.is_in(set));
    }
  }
  const double whole = length(starts.phase_error) * length(starts.frequency_error);
  CHECK(area == doctest::Approx(whole).epsilon(1e-12));
  CHECK(proved > 0.2 * whole);
  CHECK(proved < whole);
  CHECK(verdict(region) == Verdict::undecided);
  for (int n = 0; n < 2000; ++n) {
    const double phase = test::member(starts.phase_error, random);
    const double frequency = test::member(starts.frequency_error, random);
    int cells = 0;
    for (const RegionCell& cell : region.cells) {
      cells += is_in(cell.starts, 0.0, phase, frequency) ? 1 : 0;
    }
    CHECK(cells >= 1);
  }
}

TEST_CASE("a box of amplitudes, phases and frequencies is proved whole") {
  const StartBox starts{test::around(0.0, 0.2), test::around(0.0, 0.4), test::around(0.0, 0.4)};
  const Region region = prove(1, starts, {});
  CHECK(verdict(region) == Verdict::proved);
  double volume = 0.0;
  for (const RegionCell& cell : region.cells) {
    volume += length(cell.starts.amplitude_error) * length(cell.starts.phase_error) *
              length(cell.starts.frequency_error);
  }
  CHECK(volume == doctest::Approx(0.4 * 0.8 * 0.8).epsilon(1e-12));
}

TEST_CASE("the result is the same for any number of threads") {
  const StartBox starts{Interval(0.0), test::around(0.0, 1.5), Interval::from_bounds(0.4, 1.4)};
  RegionOptions options;
  options.most_halvings = 7;
  options.most_cells = 700;
  options.generation_size = 37;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return prove(1, starts, options);
  };
  const Region one = with_threads(1);
  for (const std::size_t threads : {std::size_t{2}, std::size_t{4}}) {
    const Region other = with_threads(threads);
    REQUIRE(other.cells.size() == one.cells.size());
    CHECK(other.propagations == one.propagations);
    CHECK(other.samples == one.samples);
    for (std::size_t i = 0; i < one.cells.size(); ++i) {
      CHECK(identical(other.cells[i].starts.phase_error, one.cells[i].starts.phase_error));
      CHECK(identical(other.cells[i].starts.frequency_error, one.cells[i].starts.frequency_error));
      CHECK(other.cells[i].verdict == one.cells[i].verdict);
      CHECK(other.cells[i].result.samples == one.cells[i].result.samples);
    }
  }
}

TEST_CASE("stopped or out of cells: the rest is undecided, and still there") {
  const auto& design = test::capture_examples()[1];
  const StartBox starts{Interval(0.0), test::around(0.0, 1.5), test::around(0.0, 1.0)};
  RegionOptions options;
  options.generation_size = 16;
  int calls = 0;
  const Region stopped = prove_region(
      test::capture_problem(design), CertifiedSetTarget(test::target_set(design), true), starts, options,
      [&](const quadrature::RegionProgress& progress) {
        CHECK(progress.proved_share + progress.refuted_share + progress.undecided_share <= 1.0 + 1e-12);
        return ++calls < 3;
      });
  CHECK(calls == 3);
  CHECK(stopped.propagations == 48);
  options.most_cells = 20;
  const Region short_of_cells = prove(1, starts, options);
  CHECK(short_of_cells.propagations == 20);
  for (const Region& region : {stopped, short_of_cells}) {
    double area = 0.0;
    for (const RegionCell& cell : region.cells) {
      area += length(cell.starts.phase_error) * length(cell.starts.frequency_error);
    }
    CHECK(area == doctest::Approx(6.0).epsilon(1e-12));
    CHECK(verdict(region) == Verdict::undecided);
  }
}

TEST_CASE("starts near another lock are refuted, and refute the whole") {
  // At nu = 2 pi the tracker is locked as well as at 0, and nothing brings it back.
  const StartBox starts{Interval(0.0), test::around(0.0, 0.1), test::around(6.283185307179586, 0.05)};
  RegionOptions options;
  options.first_cells = {1, 1, 1};
  const Region region = prove(1, starts, options);
  REQUIRE(region.cells.size() == 1);
  CHECK(region.cells[0].verdict == Verdict::refuted);
  CHECK(region.cells[0].whole);
  CHECK(region.cells[0].result.turns == 1);
  CHECK(verdict(region) == Verdict::refuted);

  // A box with both kinds, not to be halved: its middle alone refutes that all are captured.
  options.most_halvings = 0;
  const Region wide =
      prove(1, {Interval(0.0), test::around(0.0, 1.5), test::around(6.283185307179586, 3.2)}, options);
  REQUIRE(wide.cells.size() == 1);
  CHECK(wide.cells[0].verdict == Verdict::refuted);
  CHECK_FALSE(wide.cells[0].whole);
}

TEST_CASE("nonsense is refused") {
  const StartBox good{Interval(0.0), test::around(0.0, 0.1), test::around(0.0, 0.1)};
  CHECK_THROWS_AS(prove(0, {Interval(0.0), Interval::empty(), Interval(0.0)}, {}), std::invalid_argument);
  CHECK_THROWS_AS(prove(0, {Interval(0.0), Interval::entire(), Interval(0.0)}, {}), std::invalid_argument);
  RegionOptions options;
  options.first_cells = {1, 0, 1};
  CHECK_THROWS_AS(prove(0, good, options), std::invalid_argument);
  CHECK(verdict(Region{}) == Verdict::undecided);
  const auto problem = test::capture_problem(test::capture_examples()[0]);
  CHECK_THROWS_AS(simulate_basin(problem, good, 0, 3, 100), std::invalid_argument);
}

TEST_CASE("the simulated basin, and the proved share of it") {
  const auto& design = test::capture_examples()[2];
  const auto problem = test::capture_problem(design);
  const StartBox starts{Interval(0.0), test::around(0.0, 1.5), Interval::from_bounds(2.0, 7.0)};
  const auto basin = simulate_basin(problem, starts, 6, 20, 400);
  std::size_t locks = 0;
  for (int i = 0; i < basin.phases; ++i) {
    for (int j = 0; j < basin.frequencies; ++j) {
      test::TrackedRun run(problem, 0.0, 0.0, basin.phase(i), basin.frequency(j));
      for (int k = 0; k < 400; ++k) {
        run.step();
      }
      CHECK(basin.locks_at(i, j) == (std::fabs(run.error()[2]) < 1e-3));
      locks += basin.locks_at(i, j) ? 1U : 0U;
    }
  }
  CHECK(locks > 10);
  CHECK(locks < 100);

  Region region;
  RegionCell cell;
  cell.starts = starts;
  cell.verdict = Verdict::proved;
  region.cells = {cell};
  CHECK(shares_of_basin(region, basin).proved == 1.0);
  CHECK(shares_of_basin(region, basin).points == locks);
  // Another cell on top that is undecided takes its part away.
  cell.starts.phase_error = Interval::from_bounds(0.0, 1.5);
  cell.verdict = Verdict::undecided;
  region.cells.push_back(cell);
  const auto shares = shares_of_basin(region, basin);
  CHECK(shares.proved > 0.2);
  CHECK(shares.proved + shares.undecided == doctest::Approx(1.0));
  // No cell at all: nothing is proved.
  CHECK(shares_of_basin(Region{}, basin).proved == 0.0);
}

}  // namespace

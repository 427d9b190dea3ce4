#include "analysis/quadrature/gaussian/drift_inequality.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/analysis/quadrature/gaussian/textbook_filter.hpp"

namespace veritrack::quadrature {
namespace {

using namespace test_sets;

}  // namespace

TEST_CASE("where a cell is proved, the Gaussian integral of the textbook filter keeps the inequality") {
  test::Random random(4310);
  for (std::size_t design = 0; design < 3; ++design) {
    for (const double walk : {0.0, 0.002}) {
      const bool leaks = design == 2;
      LockSet set = leaks ? test_sets::leaking_set() : test_sets::lock_set(design, 21.0);
      set.frequency_walk = walk;
      const trackers::ToneModel<double> model =
          leaks ? test_sets::kLeakingDesign : test_sets::kDesigns[design];
      const TextbookFilter oracle{model, set};
      int proved = 0;
      double closest = -1e9;
      for (int k = 0; k < 60; ++k) {
        const Place place = somewhere(set, 0.06, random);
        CellDrift found;
        {
          const rigor::UpwardRounding upward;
          found = DriftInequality(enclosed(model), set).check(place.cell);
        }
        proved += found.holds ? 1 : 0;
        for (int l = 0; found.holds && l < 20; ++l) {
          std::array<double, 4> x{};
          for (std::size_t i = 0; i < 4; ++i) {
            x[i] = random.uniform(place.cell.low[i], place.cell.high[i]);
          }
          const std::array<double, 3> e = errors_of(set.metric, std::array<double, 3>{x[0], x[1], x[2]});
          const Matrix p = covariance_of_level(set, x[3], random);
          const double level = 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set.weight * x[3] * x[3]);
          if (level > set.level || oracle.level_of(p) < place.cell.low[3]) {
            continue;  // nothing is said of it
          }
          const double excess = oracle.excess({e[0], e[1], e[2]}, p,
                                              random.uniform(set.lowest_frequency, set.highest_frequency));
          CHECK(excess <= 0.0);
          closest = std::max(closest, excess);
        }
      }
      MESSAGE("design " << design << ", walk " << walk << ": " << proved << " of 60 cells proved, closest "
                        << closest);
      CHECK(proved > 20);
    }
  }
}

TEST_CASE("a cell with a point where the integral grows is not proved") {
  test::Random random(4311);
  // Far too much noise: 6 dB.
  const LockSet set = test_sets::lock_set(0, 6.0);
  const TextbookFilter oracle{test_sets::kDesigns[0], set};
  int looked = 0;
  const rigor::UpwardRounding upward;
  const DriftInequality inequality(enclosed(test_sets::kDesigns[0]), set);
  for (int k = 0; k < 300; ++k) {
    const Place place = somewhere(set, 1e-3, random);
    const std::array<double, 3> e =
        errors_of(set.metric, std::array<double, 3>{place.x[0], place.x[1], place.x[2]});
    const Matrix p = covariance_of_level(set, place.x[3], random);
    const double level = oracle.level_of(p);
    if (level < place.cell.low[3] || level > place.cell.high[3] || is_outside(set, place.cell)) {
      continue;
    }
    const double excess = oracle.excess({e[0], e[1], e[2]}, p);
    if (!(excess <= 1e-3)) {
      ++looked;
      CHECK_FALSE(inequality.check(place.cell).holds);
    }
  }
  CHECK(looked > 20);
}

}  // namespace veritrack::quadrature

#include "analysis/quadrature/gaussian/mean_square_verification.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/quadrature/gaussian/mean_square_search.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/analysis/quadrature/gaussian/textbook_filter.hpp"

namespace veritrack::quadrature {
namespace {

using namespace test_sets;
using rigor::Interval;
using rigor::Verdict;

/// A level makes the set small.
LockSet small_set() {
  LockSet set = lock_set(0, 18.0);
  set.level = 2.0;
  return set;
}

}  // namespace

TEST_CASE("a form is proved with room, and numbers out of range never") {
  const LockSet set = small_set();
  const auto design = enclosed(kDesigns[0]);
  LockMeanSquare form;
  {
    const rigor::UpwardRounding upward;
    form = propose_mean_square(kDesigns[0], set).value();
  }
  form.bound *= 3.0;
  const LockVerification found = verify_mean_square(design, set, form);
  CHECK(found.verdict == Verdict::proved);
  CHECK(found.cells > 100);
  CHECK(expects_cells(design, set, form, 1, found.cells));
  CHECK_FALSE(expects_cells(design, set, form, 1, found.cells / 2));
  CHECK(verify_mean_square(design, set, form, 1).verdict == Verdict::undecided);
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const auto refuses = [&](auto spoil) {
    LockMeanSquare other = form;
    spoil(other);
    CHECK(verify_mean_square(design, set, other, 2000).verdict == Verdict::undecided);
  };
  refuses([](LockMeanSquare& x) { x.bound *= 0.1; });
  for (const double value : {kNothing, kEndless, -1.0, 0.0}) {
    refuses([&](LockMeanSquare& x) { x.bound = value == kEndless ? 0.0 : value; });
    refuses([&](LockMeanSquare& x) { x.rate = value; });
    refuses([&](LockMeanSquare& x) { x.weight = value; });
    refuses([&](LockMeanSquare& x) { x.metric.frequency = value; });
    refuses([&](LockMeanSquare& x) { x.metric.amplitude = value; });
    refuses([&](LockMeanSquare& x) { x.metric.phase = value; });
  }
  refuses([&](LockMeanSquare& x) { x.share = kNothing; });
  refuses([&](LockMeanSquare& x) { x.share = -1e-3; });
  refuses([&](LockMeanSquare& x) { x.metric.coupling = kNothing; });
  // Not convex, however large the bound.
  refuses([](LockMeanSquare& x) {
    x.bound *= 1e3;
    x.rate = 1.1 * x.metric.frequency * x.metric.frequency;
  });
}

TEST_CASE("the expected form is no less than the form of any state with that weight") {
  const LockSet set = small_set();
  LockMeanSquare form{{3.0, 4.0, -2.0, 5.0}, 0.7, 1e-3, 20.0, 1e-3};
  test::Random random(4430);
  const rigor::UpwardRounding upward;
  for (int k = 0; k < 200; ++k) {
    const Place place = somewhere(set, 0.0, random);
    const auto& [u1, u2, u3, s] = place.x;
    const double level = 0.5 * (u1 * u1 + u2 * u2 + u3 * u3 + set.weight * s * s);
    const std::array<double, 3> e = errors_of(set.metric, std::array<double, 3>{u1, u2, u3});
    const BlockMetric<double>& r = form.metric;
    form.offset = k % 2 == 0 ? std::array<double, 3>{} : std::array<double, 3>{0.1, -0.2, 0.15};
    const Eigen::Vector3d y(e[0] - form.offset[0], e[1] - form.offset[1], e[2] - form.offset[2]);
    const Eigen::Vector3d image(r.amplitude * y[0], r.phase * y[1] + r.coupling * y[2], r.frequency * y[2]);
    const double u = image.squaredNorm() + form.weight * s * s + form.share * std::exp(level);
    CHECK(u <= expected_form(set, form, rigor::exp(Interval(level))).upper() * (1.0 + 1e-9));
  }
}

}  // namespace veritrack::quadrature

#include "analysis/linear/mode_damping.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;
using rigor::Verdict;

/// With the eigenvalues r e^(+-i angle), in coordinates that are not their own.
std::vector<Row> pair_of(double r, double angle) {
  const double real = r * std::cos(angle), imaginary = r * std::sin(angle);
  // [[real, -imaginary], [imaginary, real]] sheared by 0.7.
  const double shear = 0.7;
  return {{Interval(real + shear * imaginary), Interval(-imaginary - shear * shear * imaginary)},
          {Interval(imaginary), Interval(real - shear * imaginary)}};
}

double damping_of(double r, double angle) {
  return -std::log(r) / std::hypot(std::log(r), angle);
}

}  // namespace

TEST_CASE("the damping of a pair is that of the textbook") {
  const rigor::UpwardRounding upward;
  test::Random random(37021);
  for (std::int64_t i = 0; i < test::effort(200); ++i) {
    const double r = random.uniform(0.3, 0.999);
    const double angle = random.uniform(0.001, 2.5);
    const double damping = damping_of(r, angle);
    CHECK(has_damping(pair_of(r, angle), Interval(damping * (1.0 - 1e-6))) == Verdict::proved);
    if (damping < 0.99) {
      CHECK(has_damping(pair_of(r, angle), Interval(damping * (1.0 + 1e-6))) == Verdict::refuted);
    }
  }
}

TEST_CASE("what is unstable, unknown or wide is not damped") {
  const rigor::UpwardRounding upward;
  CHECK(has_damping(pair_of(1.01, 0.2), Interval(0.1)) != Verdict::proved);
  CHECK(has_damping(pair_of(1.5, 0.2), Interval(0.1)) != Verdict::proved);
  // About the required damping, on either side.
  std::vector<Row> wide = pair_of(0.6, 0.5);
  wide[0][0] += Interval::from_bounds(-0.02, 0.02);
  CHECK(has_damping(wide, Interval(damping_of(0.6, 0.5))) == Verdict::undecided);
  CHECK(has_damping({{Interval::from_bounds(-1.5, 1.5)}}, Interval(0.1)) == Verdict::undecided);
  CHECK(has_damping({{Interval(NAN)}}, Interval(0.1)) == Verdict::undecided);
  // -0.5: ln z = -0.69 + pi i.
  CHECK(has_damping({{Interval(-0.5)}}, Interval(0.21)) == Verdict::proved);
  CHECK(has_damping({{Interval(-0.5)}}, Interval(0.22)) == Verdict::refuted);
}

}  // namespace veritrack::linear

#include "analysis/quadrature/rounding/step_rounding.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/quadrature/rounding/rounding_twin.hpp"
#include "tests/trackers/random_tracker.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using namespace veritrack::test;
using rigor::Interval;

namespace {

trackers::ToneModel<Interval> exact(const trackers::ToneModel<double>& d) {
  return {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)};
}

/// The largest shares of the bounds that random states of a random box reach, and whether the bounds are
/// finite.
struct Trial {
  StateDifference share;
  bool bounded = false;
};
Trial trial(Random& random, double spread, double amplitude) {
  trackers::ToneModel<double> design = random_design(random);
  const Eigen::Matrix3d low = random_covariance(random);
  const Eigen::Matrix3d high = (1.0 + spread) * low;
  const double least = random.uniform(0.6, 1.2);
  const double measurement = 1.5;
  const double frequency = 3.5;
  const StateDifference bound = [&] {
    const rigor::UpwardRounding upward;
    return step_rounding(
        {exact(design), Interval(amplitude), measurement, frequency},
        {Interval::from_bounds(least, least * (1.0 + spread)), Interval(0.0),
         rigor::to_interval(rigor::Matrix<3>(low)), rigor::to_interval(rigor::Matrix<3>(high))});
  }();
  Trial result;
  result.bounded = is_finite(bound);
  // The program in its own unit of length.
  design.q1 *= amplitude * amplitude;
  design.r *= amplitude * amplitude;
  const Eigen::DiagonalMatrix<double, 3> unit(amplitude, amplitude, 1.0);
  for (int i = 0; i < 20 && result.bounded; ++i) {
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    const double z = least * (1.0 + spread * random.uniform(0.01, 0.99));
    const Eigen::Matrix3d p = unit * plane_turn(angle) *
                              between(random, (1.0 + 1e-9) * low, (1.0 - 1e-9) * high) * plane_turn(-angle) *
                              unit;
    const trackers::QuadratureEstimate<double> start{
        amplitude * z * std::cos(angle), amplitude * z * std::sin(angle),
        random.uniform(-frequency, frequency), trackers::FactoredCovariance<double>::from_matrix(p)};
    StateDifference found =
        difference_of(twin_steps(design, start, amplitude * random.uniform(-measurement, measurement),
                                 amplitude * random.uniform(-measurement, measurement)));
    found.z /= amplitude;
    found.p_zz /= amplitude * amplitude;
    found.p_z3 /= amplitude;
    result.share = larger(result.share, shares(found, bound));
  }
  return result;
}

}  // namespace

TEST_CASE("no step in double differs from its long double twin by more than the bound") {
  Random random(7110);
  for (const double amplitude : {1.0, 0x1p-30, 3e7}) {
    for (const double spread : {1e-6, 0.1, 1.0}) {
      StateDifference largest;
      std::int64_t bounded = 0;
      const std::int64_t trials =
          std::max<std::int64_t>(12, effort(12));  // fewer are no measure of sharpness
      for (std::int64_t i = 0; i < trials; ++i) {
        const Trial one = trial(random, spread, amplitude);
        bounded += one.bounded ? 1 : 0;
        largest = larger(largest, one.share);
      }
      MESSAGE("spread " << spread << ", amplitude " << amplitude << ": shares z " << largest.z
                        << ", frequency " << largest.frequency << ", P_zz " << largest.p_zz << ", P_z3 "
                        << largest.p_z3 << ", P_33 " << largest.p_33);
      CHECK(bounded == trials);
      for (const double share : {largest.z, largest.frequency, largest.p_zz, largest.p_z3, largest.p_33}) {
        CHECK(share <= 1.0);
        // A bound much larger than what happens would hide that an operation has been left out.
        CHECK(share >= (spread < 0.01 ? 0.01 : 1e-4));
      }
    }
  }
}

TEST_CASE("nothing is bounded where something is unknown, or beyond the units of length that are admitted") {
  const rigor::UpwardRounding upward;
  const rigor::IntervalMatrix<3> p = rigor::to_interval(rigor::Matrix<3>(rigor::Matrix<3>::Identity()));
  const trackers::ToneModel<Interval> design = exact({0.01, 0.01, 0.1, 0.0});
  const HeldStates box{Interval(1.0), Interval(0.0), p, p};
  CHECK(is_finite(step_rounding({design, Interval(1.0), 1.0, 3.0}, box)));
  CHECK_FALSE(is_finite(step_rounding({design, Interval(0x1p-61), 1.0, 3.0}, box)));
  CHECK_FALSE(is_finite(step_rounding({design, Interval(0x1p61), 1.0, 3.0}, box)));
  CHECK_FALSE(is_finite(step_rounding({design, Interval(1.0), 1.0, std::nan("")}, box)));
  CHECK_FALSE(is_finite(step_rounding({design, Interval(1.0), std::nan(""), 3.0}, box)));
  HeldStates unknown = box;
  unknown.z2 = Interval::empty();
  CHECK_FALSE(is_finite(step_rounding({design, Interval(1.0), 1.0, 3.0}, unknown)));
  unknown = box;
  unknown.lower(2, 2) = Interval::from_bounds(-1.0, 1.0);
  CHECK_FALSE(is_finite(step_rounding({design, Interval(1.0), 1.0, 3.0}, unknown)));
  trackers::ToneModel<Interval> noiseless = design;
  noiseless.r = Interval(0.0);
  CHECK_FALSE(is_finite(
      step_rounding({noiseless, Interval(1.0), 1.0, 3.0},
                    {Interval(1.0), Interval(0.0), rigor::IntervalMatrix<3>(Interval(1e-9) * p), p})));
}

#include "analysis/sets/fixed_point.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "analysis/sets/fixed_point_branch.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack::sets;
using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// x+ = x^2 / 2 + p: the fixed points 1 -+ sqrt(1 - 2p) meet at p = 1/2.
struct Fold {
  static constexpr int kStates = 1;
  static constexpr int kNoises = 0;
  template <typename Scalar>
  Column<Scalar, 1> operator()(const Column<Scalar, 1>& x, const Scalar& p,
                               const Column<Scalar, 1>& d) const {
    return Column<Scalar, 1>(Scalar(0.5) * x[0] * x[0] + p + d[0]);
  }
};

/// X+ = A X + p b, with the fixed point p (I - A)^-1 b.
struct Linear {
  static constexpr int kStates = 3;
  static constexpr int kNoises = 0;
  Eigen::Matrix3d a;
  Eigen::Vector3d b;
  template <typename Scalar>
  Column<Scalar, 3> operator()(const Column<Scalar, 3>& x, const Scalar& p, const Column<Scalar, 1>&) const {
    Column<Scalar, 3> next;
    for (Eigen::Index i = 0; i < 3; ++i) {
      next[i] = Scalar(b[i]) * p;
      for (Eigen::Index j = 0; j < 3; ++j) {
        next[i] = next[i] + Scalar(a(i, j)) * x[j];
      }
    }
    return next;
  }
};

/// x+ = p / x, undefined at 0, with the fixed points -+sqrt(p).
struct Reciprocal {
  static constexpr int kStates = 1;
  static constexpr int kNoises = 0;
  template <typename Scalar>
  Column<Scalar, 1> operator()(const Column<Scalar, 1>& x, const Scalar& p, const Column<Scalar, 1>&) const {
    return Column<Scalar, 1>(p / x[0]);
  }
};

double lower_fold(double p) {
  return 2.0 * p / (1.0 + std::sqrt(1.0 - 2.0 * p));
}

}  // namespace

TEST_CASE("fixed points of linear loops, for all parameters of an interval at once") {
  Random random(900);
  for (std::int64_t round = 0; round < effort(200); ++round) {
    Linear loop;
    for (Eigen::Index i = 0; i < 9; ++i) {
      loop.a(i) = random.uniform(-1.0, 1.0);
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      loop.b[i] = random.uniform(-1.0, 1.0);
    }
    const Eigen::Matrix3d system = Eigen::Matrix3d::Identity() - loop.a;
    if (std::fabs(system.determinant()) < 1e-3) {
      continue;
    }
    const Eigen::Vector3d exact_slope = veritrack::oracle::solution(system, loop.b);
    const double low = random.uniform(-2.0, 2.0);
    const UpwardRounding upward;
    const Interval parameter = Interval::from_bounds(low, low + random.uniform());
    const auto tube = verify_fixed_point(loop, Vector<3>(Vector<3>::Zero()), parameter);
    REQUIRE(tube.has_value());
    const auto slope = enclose_slope(loop, *tube);
    REQUIRE(slope.has_value());
    for (int sample = 0; sample <= 4; ++sample) {
      const double p = std::min(low + 0.25 * sample * (parameter.upper() - low), parameter.upper());
      const IntervalVector<3> enclosure = tube->at(Interval(p));
      for (Eigen::Index i = 0; i < 3; ++i) {
        CHECK(enclosure[i].lower() <= p * exact_slope[i] + 1e-11);
        CHECK(enclosure[i].upper() >= p * exact_slope[i] - 1e-11);
        CHECK(width(enclosure[i]) <= 1e-9);
        CHECK((*slope)[i].lower() <= exact_slope[i] + 1e-11);
        CHECK((*slope)[i].upper() >= exact_slope[i] - 1e-11);
      }
    }
  }
}

TEST_CASE("the fixed point of a quadratic map is enclosed, and unique in its box") {
  const Fold loop;
  const UpwardRounding upward;
  for (const double p : {-3.0, -0.5, 0.0, 0.25, 0.375, 0.49}) {
    const auto tube = verify_fixed_point(loop, Vector<1>(lower_fold(p)), Interval(p));
    REQUIRE(tube.has_value());
    const Interval box = tube->box()[0];
    CHECK(box.lower() <= lower_fold(p) + 1e-13);
    CHECK(box.upper() >= lower_fold(p) - 1e-13);
    CHECK(width(box) <= 1e-12);
    const Interval unique = Interval(tube->center[0]) + tube->uniqueness[0];
    CHECK_FALSE(contains(unique, 1.0 + std::sqrt(1.0 - 2.0 * p)));
  }
  // A wide cell: the curve p -> x stays inside, point by point.
  const auto tube = verify_fixed_point(loop, Vector<1>(lower_fold(0.2)), Interval::from_bounds(0.15, 0.25));
  REQUIRE(tube.has_value());
  for (double p = 0.15; p <= 0.25; p += 0.001) {
    CHECK(contains(tube->at(Interval(p))[0], lower_fold(p)));
  }
}

TEST_CASE("where there is no fixed point, two in the box, or no number, nothing is verified") {
  const Fold loop;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const UpwardRounding upward;
  CHECK_FALSE(verify_fixed_point(loop, Vector<1>(1.0), Interval(0.51)).has_value());
  CHECK_FALSE(
      verify_fixed_point(loop, FixedPointProposal<1>{Vector<1>(1.0), Vector<1>(0.0)}, Interval(0.51)));
  // At the fold the fixed point is double.
  CHECK_FALSE(verify_fixed_point(loop, FixedPointProposal<1>{Vector<1>(1.0), Vector<1>(0.0)}, Interval(0.5)));
  CHECK_FALSE(verify_fixed_point(loop, Vector<1>(1.0), Interval::from_bounds(0.4, 0.6)).has_value());
  CHECK_FALSE(verify_fixed_point(loop, Vector<1>(nan), Interval(0.25)).has_value());
  CHECK_FALSE(verify_fixed_point(loop, Vector<1>(0.3), Interval::empty()).has_value());
  CHECK_FALSE(verify_fixed_point(loop, Vector<1>(0.3), Interval::entire()).has_value());
  CHECK_FALSE(
      verify_fixed_point(loop, FixedPointProposal<1>{Vector<1>(0.3), Vector<1>(infinity)}, Interval(0.25)));
  // A proposal that is no fixed point.
  CHECK_FALSE(verify_fixed_point(loop, FixedPointProposal<1>{Vector<1>(0.9), Vector<1>(0.0)}, Interval(0.0)));

  const IntervalVector<1> both(Interval::from_bounds(-0.1, 2.1));
  CHECK_FALSE(holds_one_fixed_point(loop, both, Interval(0.0)));
  const IntervalVector<1> one(Interval::from_bounds(-0.2, 0.2));
  CHECK(holds_one_fixed_point(loop, one, Interval(0.0)));
  const IntervalVector<1> none(Interval::from_bounds(0.8, 0.9));
  CHECK_FALSE(holds_one_fixed_point(loop, none, Interval(0.0)));
  CHECK_FALSE(holds_one_fixed_point(loop, IntervalVector<1>(Interval::empty()), Interval(0.0)));

  // A box across a pole.
  const IntervalVector<1> across(Interval::from_bounds(-1.5, 1.5));
  CHECK_FALSE(holds_one_fixed_point(Reciprocal{}, across, Interval(1.0)));
}

TEST_CASE("a branch is followed up to its fold and not past it") {
  const Fold loop;
  const UpwardRounding upward;
  const IntervalVector<1> origin(Interval(0.0));
  const auto branch = follow_branch(loop, origin, 0.0, 1.0);
  CHECK_FALSE(branch.complete);
  CHECK(branch.reached < 0.5);
  CHECK(branch.reached > 0.499);
  double joined = 0.0;
  for (const auto& cell : branch.cells) {
    CHECK(cell.parameter.lower() == joined);
    joined = cell.parameter.upper();
    for (int i = 0; i <= 8; ++i) {
      const double p = std::min(cell.parameter.lower() + 0.125 * i * width(cell.parameter), joined);
      const Interval x = cell.at(Interval(p))[0];
      CHECK(x.lower() <= lower_fold(p) + 1e-12);
      CHECK(x.upper() >= lower_fold(p) - 1e-12);
      CHECK(x.upper() < 1.0);
    }
  }
  CHECK(joined == branch.reached);

  const auto downward = follow_branch(loop, origin, 0.0, -1.0);
  CHECK(downward.complete);
  CHECK(downward.reached == -1.0);
  CHECK(downward.cells.back().at(Interval(-1.0))[0].lower() <= 1.0 - std::sqrt(3.0) + 1e-12);
  CHECK(downward.cells.back().at(Interval(-1.0))[0].upper() >= 1.0 - std::sqrt(3.0) - 1e-12);

  CHECK(follow_branch(loop, origin, 0.0, 0.0).complete);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(follow_branch(loop, origin, 0.0, nan).complete);
  CHECK_FALSE(follow_branch(loop, origin, 0.0, std::numeric_limits<double>::infinity()).complete);
}

TEST_CASE("a start on the other branch is followed on the other branch") {
  const Fold loop;
  const UpwardRounding upward;
  const auto branch = follow_branch(loop, IntervalVector<1>(Interval(2.0)), 0.0, 0.25);
  REQUIRE(branch.complete);
  CHECK(contains(branch.cells.back().at(Interval(0.25))[0], 1.0 + std::sqrt(0.5)));
  // A start that holds no fixed point, or both, is followed nowhere.
  CHECK(follow_branch(loop, IntervalVector<1>(Interval(0.7)), 0.0, 0.25).cells.empty());
  CHECK(follow_branch(loop, IntervalVector<1>(Interval::from_bounds(-0.5, 2.5)), 0.0, 0.25).cells.empty());
}

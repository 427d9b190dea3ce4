#include "analysis/rigor/piecewise.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/taylor_model.hpp"
#include "tests/analysis/rigor/ball_points.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::BallModel;
using rigor::Interval;
using Taylor = rigor::TaylorModel<2, 3>;

namespace {

/// A smooth function of s and z of about this size, about a constant.
template <typename Scalar>
Scalar curve(const Scalar& s, const Scalar& z, double constant, double size, int kind) {
  const Scalar bent = kind == 0 ? s : kind == 1 ? s * z : s * s - z;
  return Scalar(constant) + Scalar(size) * bent;
}

TEST_CASE("functions with kinks contain all values of ball models, on either side of a kink and across it") {
  const rigor::BallModelScope scope(1, 1);
  test::Random random(37006);
  int across = 0;
  for (std::int64_t round = test::effort(3000); round > 0; --round) {
    const double constant = random.uniform(-1.0, 1.0);
    const double size = random.uniform() < 0.3 ? 0.05 : random.uniform(0.0, 2.0);
    const double low = random.uniform(-1.0, 0.3);
    const double high = low + random.uniform(0.0, 1.0);
    const auto kind = static_cast<int>(random.below(3));
    const test::BallPoint point = test::random_point(random, 1, 1);
    const BallModel x = curve(BallModel::s() + BallModel::ball(0), BallModel::z(), constant, size, kind);
    const auto value =
        static_cast<double>(curve<long double>(point.s + point.x[0], point.z, constant, size, kind));
    const BallModel y = curve(BallModel::z(), BallModel::s(), 0.1, 0.4, 1);
    const auto other = static_cast<double>(curve<long double>(point.z, point.s, 0.1, 0.4, 1));
    const auto check = [&](const BallModel& model, double expected) {
      const long double polynomial = test::polynomial_at(model, point);
      CHECK(std::fabs(static_cast<double>(polynomial) - expected) <= model.error() + 1e-12);
      CHECK(rigor::is_finite(model.range()));
    };
    check(maximum(x, y), std::max(value, other));
    check(minimum(x, y), std::min(value, other));
    check(absolute(x), std::fabs(value));
    check(clamped(x, BallModel(low), BallModel(high)), std::clamp(value, low, high));
    check(clamped(x, y - BallModel(1.0), y), std::clamp(value, other - 1.0, other));
    const bool is_across = x.range().lower() < 0.0 && x.range().upper() > 0.0;
    across += is_across ? 1 : 0;
    CHECK(rigor::is_empty(sign_of(x).range()) == is_across);
    CHECK(rigor::is_empty(chosen(x, y, x).range()) == is_across);
    if (!is_across) {
      check(sign_of(x), value > 0.0 ? 1.0 : -1.0);
      check(chosen(x, y, x), value > 0.0 ? other : value);
    }
  }
  CHECK(across > test::effort(500));
}

TEST_CASE("nothing is known of limits that change places, or of what is not known") {
  const rigor::BallModelScope scope(1, 1);
  const BallModel unknown(std::numeric_limits<double>::quiet_NaN());
  const BallModel infinite(Interval::entire());
  const BallModel one(1.0);
  const auto is_unknown = [](const auto& model) { return !rigor::is_finite(model.range()); };
  CHECK(is_unknown(clamped(BallModel::s(), one, -one)));
  CHECK(is_unknown(clamped(BallModel::s(), BallModel::z(), BallModel::z() * BallModel(0.5))));
  for (const BallModel& bad : {unknown, infinite}) {
    CHECK(is_unknown(maximum(bad, one)));
    CHECK(is_unknown(minimum(one, bad)));
    CHECK(is_unknown(absolute(bad)));
    CHECK(is_unknown(clamped(bad, -one, one)));
    CHECK(is_unknown(clamped(one, bad, one)));
    CHECK(is_unknown(chosen(bad, one, one)));
    CHECK(is_unknown(sign_of(bad)));
  }
  CHECK_FALSE(is_unknown(chosen(one, one, unknown)));
  CHECK(is_unknown(chosen(-one, one, unknown)));
  for (const Interval& bad : {Interval::empty(), Interval::entire()}) {
    CHECK(!rigor::is_finite(maximum(bad, Interval(1.0))));
    CHECK(!rigor::is_finite(absolute(bad)));
    CHECK(!rigor::is_finite(sign_of(bad)));
    CHECK(!rigor::is_finite(clamped(bad, Interval(0.0), Interval(1.0))));
    CHECK(!rigor::is_finite(chosen(bad, Interval(0.0), Interval(1.0))));
  }
  CHECK(!rigor::is_finite(clamped(Interval(0.0), Interval::from_bounds(0.0, 0.2), Interval(0.1))));
}

TEST_CASE("Taylor models and dual numbers: derivatives are those of a certain branch, or unknown") {
  const rigor::UpwardRounding upward;
  const Taylor s = Taylor::variable(Interval::from_bounds(-0.5, 1.0), 0);
  const Interval range = absolute(s).range();
  CHECK(range.upper() >= 1.0);
  CHECK(range.upper() < 1.4);
  using Dual = rigor::Dual<Interval, 1>;
  const auto at = [](double low, double high) {
    return Dual(Interval::from_bounds(low, high), {Interval(1.0)});
  };
  CHECK(absolute(at(-2.0, -1.0)).derivative(0).upper() == -1.0);
  CHECK(absolute(at(1.0, 2.0)).derivative(0).lower() == 1.0);
  for (const auto& [from, to] : {std::pair(-1.0, 1.0), std::pair(0.0, 1.0), std::pair(-1.0, 0.0)}) {
    const double low = from;  // clang captures no structured bindings
    const double high = to;
    CAPTURE(low);
    CHECK(!rigor::is_finite(absolute(at(low, high)).derivative(0)));
    CHECK(!rigor::is_finite(maximum(at(low, high), Dual(0.0)).derivative(0)));
    CHECK(!rigor::is_finite(clamped(at(low, high), Dual(0.0), Dual(3.0)).derivative(0)));
    CHECK(!rigor::is_finite(sign_of(at(low, high)).value()));
  }
  CHECK(clamped(at(4.0, 5.0), Dual(0.0), Dual(3.0)).value().upper() == 3.0);
  CHECK(clamped(at(4.0, 5.0), Dual(0.0), Dual(3.0)).derivative(0).upper() == 0.0);
}

}  // namespace

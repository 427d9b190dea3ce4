#include "trackers/packed_pair.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

using veritrack::trackers::Packed;
using veritrack::trackers::PackedPair;
using veritrack::trackers::detail::needs_care;

TEST_CASE_TEMPLATE("each lane of a pair computes alone", Scalar, double, float) {
  constexpr int kLanes = 16 / sizeof(Scalar);
  using Pair = PackedPair<Scalar, kLanes>;
  veritrack::test::Random random(5);
  for (int round = 0; round < 100; ++round) {
    Scalar a[Pair::kLanes];  // NOLINT: plain
    Scalar b[Pair::kLanes];  // NOLINT
    for (int i = 0; i < Pair::kLanes; ++i) {
      a[i] = static_cast<Scalar>(random.uniform(0.1, round % 2 == 0 ? 3.0 : 90.0));
      b[i] = static_cast<Scalar>(random.uniform(-3.0, 3.0));
    }
    const Pair x = Pair::of([&](int i) { return a[i]; });
    const Pair y = Pair::of([&](int i) { return b[i]; });
    const auto [sine, cosine] = sin_cos(x);
    const auto chosen = select(
        is_nan(Pair::of([&](int i) { return i % 3 == 0 ? std::numeric_limits<Scalar>::quiet_NaN() : b[i]; })),
        x, y);
    for (int i = 0; i < Pair::kLanes; ++i) {
      CHECK((x + y).lane(i) == a[i] + b[i]);
      CHECK((x - y).lane(i) == a[i] - b[i]);
      CHECK((x * y).lane(i) == a[i] * b[i]);
      CHECK((x / y).lane(i) == a[i] / b[i]);
      CHECK((-x).lane(i) == -a[i]);
      CHECK(sqrt(x).lane(i) == std::sqrt(a[i]));
      CHECK(chosen.lane(i) == (i % 3 == 0 ? a[i] : b[i]));
      const auto [one_sine, one_cosine] = sin_cos(Packed<Scalar, kLanes>(a[i]));
      CHECK(sine.lane(i) == one_sine.lane(0));
      CHECK(cosine.lane(i) == one_cosine.lane(0));
    }
  }
}

TEST_CASE_TEMPLATE("one lane that needs care is seen, wherever it is", Scalar, double, float) {
  using Pair = PackedPair<Scalar, 16 / sizeof(Scalar)>;
  const auto with = [](int lane, double value) {
    return Pair::of([&](int i) { return static_cast<Scalar>(i == lane ? value : -1.5); });
  };
  const Pair one(static_cast<Scalar>(1.0));
  const double infinity = std::numeric_limits<double>::infinity();
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(needs_care(one, one));
  CHECK_FALSE(needs_care(with(0, 3.2), with(1, 1e30)));
  for (int lane = 0; lane < Pair::kLanes; ++lane) {
    CHECK(needs_care(with(lane, 64.1), one));
    CHECK(needs_care(with(lane, -64.1), one));
    CHECK(needs_care(with(lane, infinity), one));
    CHECK(needs_care(one, with(lane, none)));
  }
}

// Sets for Gaussian noise that break one hypothesis of the theorem and no other: each guard of
// check_lock_set alone stands between them and a proof.
#include "checker/quadrature/lock_set.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::WrittenSet;

namespace {

Design the_design() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball::hull(Ball(0.0013), Ball(0.0013000000000000002));
  design.r = Ball::hull(Ball(0.01), Ball(0.010000000000000002));
  design.epsilon = zero;
  design.slew = zero;
  design.largest_frequency = Ball(3.0);
  return design;
}

GaussianNoise the_noise() {
  return {Ball(0.056), Ball(0.0036), Ball(1e6)};
}

/// Why the set is not verified; empty when it is.
std::string refusal(const WrittenSet& written, const Design& design = the_design(),
                    const GaussianNoise& noise = the_noise()) {
  std::int64_t cells = 0;
  Objections objections;
  const Tree tree = written.tree();
  check_lock_set(tree, design, noise, cells, objections);
  CHECK(objections.size() <= 1);
  CHECK(tree.unread(1).empty());
  return objections.empty() ? std::string() : objections.front();
}
std::string refusal_with(const std::string& name, const std::string& number) {
  WrittenSet written;
  written.numbers.at(name) = number;
  return refusal(written);
}
std::string refusal_with(const std::string& name, std::size_t i, std::size_t j, const std::string& number) {
  WrittenSet written;
  written.matrices.at(name)[i][j] = number;
  if (name != "metric") {
    written.matrices.at(name)[j][i] = number;
  }
  return refusal(written);
}

bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

constexpr const char* kForm = "required form";
constexpr const char* kDefinite = "not positive definite";
constexpr const char* kRange = "out of range";
constexpr const char* kDrift = "not proved to rise";
constexpr const char* kRounding = "rounding";
constexpr const char* kLess = "for less noise";

}  // namespace

TEST_CASE("the set is verified as it stands, in cells, the same ones each time") {
  std::array<std::int64_t, 2> cells{};
  std::array<std::int64_t, 2> spent{};
  for (std::size_t k = 0; k < 2; ++k) {
    set_budget(kDefaultBudget);
    Objections objections;
    check_lock_set(WrittenSet().tree(), the_design(), the_noise(), cells[k], objections);
    CHECK(objections.empty());
    spent[k] = operations_spent();
  }
  MESSAGE(cells[0] << " cells, " << spent[0] << " operations");
  CHECK(cells[0] > 200);
  CHECK(cells[0] == cells[1]);
  CHECK(spent[0] == spent[1]);
  CHECK(spent[0] > 1000 * cells[0]);
}

TEST_CASE("a set for which the expected value of W rises too far is refused") {
  CHECK(mentions(refusal_with("drift", "0x0p+0"), kDrift));
  CHECK(mentions(refusal_with("drift", "0x1p-4"), kDrift));
  CHECK(mentions(refusal_with("noise_deviation", "0x1p-3"), kDrift));
  CHECK(mentions(refusal_with("frequency_walk", "0x1p-5"), kDrift));
  CHECK(mentions(refusal_with("level", "0x1p+6"), kDrift));
  CHECK(mentions(refusal_with("weight", "0x1p+6"), kDrift));
  CHECK(mentions(refusal_with("weight", "0x1p-6"), kDrift));
  CHECK(mentions(refusal_with("metric", 2, 2, "0x1.79de63862c32ap+6"), kDrift));
  CHECK(mentions(refusal_with("metric", 1, 2, "0x1.cf59f82b18cb9p+3"), kDrift));
  CHECK(mentions(refusal_with("spread_above", 0, 0, "0x1.0a5be83dfb60ep-13"), kDrift));
  CHECK(mentions(refusal_with("spread_below", 2, 2, "0x1.cd9cdf1c2647fp+4"), kDrift));
  CHECK(mentions(refusal_with("centre", 0, 0, "0x1.8b0216205dfc8p-7"), kDrift));
}

TEST_CASE("a filter other than the one that the set is for is refused") {
  Design design = the_design();
  SUBCASE("q1") {
    design.q1 = Ball(0.01);
  }
  SUBCASE("q2") {
    design.q2 = Ball(0.01);
  }
  SUBCASE("r") {
    design.r = Ball(0.003);
  }
  CHECK(mentions(refusal({}, design), kDrift));
}

TEST_CASE("a leak and a slew are refused") {
  Design design = the_design();
  SUBCASE("a leak") {
    design.epsilon = Ball(1e-9);
  }
  SUBCASE("a slew") {
    design.slew = Ball(1e-9);
  }
  SUBCASE("no process noise of the frequency") {
    design.q2 = zero;
  }
  SUBCASE("no measurement noise") {
    design.r = zero;
  }
  SUBCASE("negative process noise") {
    design.q1 = Ball(-1e-9);
  }
  CHECK(mentions(refusal({}, design), "epsilon = 0"));
}

TEST_CASE("more noise in the design than the set is for is refused") {
  const Ball deviation = from_hexadecimal(WrittenSet().numbers.at("noise_deviation"));
  const Ball walk = from_hexadecimal(WrittenSet().numbers.at("frequency_walk"));
  CHECK(refusal({}, the_design(), {deviation, walk, one}).empty());
  CHECK(mentions(refusal({}, the_design(), {deviation + Ball(1e-12), walk, one}), kLess));
  CHECK(mentions(refusal({}, the_design(), {deviation, walk + Ball(1e-12), one}), kLess));
  CHECK(mentions(refusal({}, the_design(), {Ball::everything(), walk, one}), kLess));
}

TEST_CASE("numbers have their sign") {
  CHECK(mentions(refusal_with("weight", "-0x1.15e35e3d9af1bp+1"), kRange));
  CHECK(mentions(refusal_with("weight", "0x0p+0"), kRange));
  CHECK(mentions(refusal_with("level", "-0x1p+2"), kRange));
  CHECK(mentions(refusal_with("level", "0x0p+0"), kRange));
  CHECK(mentions(refusal_with("drift", "-0x1p-20"), kRange));
  CHECK(mentions(refusal_with("noise_deviation", "-0x1.cc1fc5972b38ap-5"), kRange));
  CHECK(mentions(refusal_with("noise_deviation", "0x0p+0"), kRange));
  CHECK(mentions(refusal_with("frequency_walk", "-0x1.d7dbf487fcb92p-9"), kRange));
  for (const std::size_t i : {0U, 1U, 2U}) {
    CHECK(mentions(refusal_with("metric", i, i, "-0x1p+3"), "metric"));
    CHECK(mentions(refusal_with("metric", i, i, "0x0p+0"), "metric"));
  }
}

TEST_CASE("covariances that are not positive definite are refused") {
  for (const char* name : {"centre", "spread_above", "spread_below"}) {
    CAPTURE(name);
    CHECK(mentions(refusal_with(name, 0, 0, "-0x1p-10"), kDefinite));
    CHECK(mentions(refusal_with(name, 1, 1, "0x0p+0"), kDefinite));
    CHECK(mentions(refusal_with(name, 2, 2, "-0x1p-10"), kDefinite));
    CHECK(mentions(refusal_with(name, 1, 2, "0x1p+9"), kDefinite));
  }
}

TEST_CASE("an entry that the form does not have is refused, however small") {
  for (const char* name : {"metric", "centre", "spread_above", "spread_below"}) {
    for (const auto& [i, j] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 0U}, {2U, 0U}, {2U, 1U}}) {
      CAPTURE(name);
      CAPTURE(i);
      CAPTURE(j);
      WrittenSet written;
      written.matrices.at(name)[i][j] = "0x1p-60";
      CHECK(mentions(refusal(written), kForm));
    }
  }
  // Symmetric, but not apart.
  CHECK(mentions(refusal_with("centre", 0, 2, "0x1p-60"), kForm));
}

TEST_CASE("numbers that are no doubles, or huge, or tiny, end in a refusal") {
  for (const char* name : {"weight", "level", "drift", "noise_deviation", "frequency_walk"}) {
    for (const char* number : {"0x1p+1023", "0x1p+9999", "0x1p-9999"}) {
      CAPTURE(name);
      CAPTURE(number);
      const bool is_level = std::string(name) == "level";
      const bool is_walk = std::string(name) == "frequency_walk";
      const bool is_noise = std::string(name) == "noise_deviation";
      const std::string found = refusal_with(name, number);
      // A small set or a large drift says little; and a set for less noise is not this one.
      if ((is_level && number[4] == '-') || (std::string(name) == "drift" && number[4] == '+')) {
        continue;
      }
      CHECK_FALSE(found.empty());
      if ((is_walk || is_noise) && number[4] == '-') {
        CHECK(mentions(found, kLess));
      }
    }
  }
  for (const char* name : {"metric", "centre", "spread_above", "spread_below"}) {
    for (const std::size_t i : {0U, 1U, 2U}) {
      CHECK_FALSE(refusal_with(name, i, i, "0x1p+1023").empty());
      CHECK_FALSE(refusal_with(name, i, i, "0x1p+9999").empty());
    }
  }
  CHECK_THROWS(refusal_with("level", "nan"));
  CHECK_THROWS(refusal_with("level", "inf"));
  CHECK_THROWS(refusal_with("level", "5"));
}

TEST_CASE("rounding has to stay within its room") {
  // Metric and spreads so small a part of the covariance that rounding is a large part of them.
  const LockSet set = WrittenSet().set();
  CHECK(has_room_for_rounding(set, the_design(), Ball(1e6)));
  LockSet other = set;
  SUBCASE("of the error") {
    other.metric.frequency = Ball(1e8);
  }
  SUBCASE("of the covariance, above") {
    other.above = Ball(1e-7) * set.above;
  }
  SUBCASE("of the covariance, below") {
    other.below = Ball(1e-7) * set.below;
  }
  SUBCASE("with a large noise") {
    other.deviation = Ball(1e8);
  }
  SUBCASE("with a large walk") {
    other.walk = Ball(1e6);
  }
  CHECK_FALSE(has_room_for_rounding(other, the_design(), Ball(1e6)));
}

TEST_CASE("the rounding is refused in the set as well") {
  Design design = the_design();
  design.amplitude = Ball(0x1p70);
  CHECK(mentions(refusal({}, design), kRounding));
}

// Sets for Gaussian noise that break one hypothesis of the theorem and no other: each guard of
// check_lock_set alone stands between them and a proof.
#include "checker/quadrature/lock_set.hpp"

#include <doctest/doctest.h>

#include "checker/quadrature/certified_set.hpp"
#include "checker/quadrature/lock_cover.hpp"
#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::WrittenSet;

namespace {

Design lock_design() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball::hull(Ball(0.0013), Ball(0.0013000000000000002));
  design.r = Ball::hull(Ball(0.01), Ball(0.010000000000000002));
  design.epsilon = zero;
  design.slew = zero;
  design.largest_frequency = Ball(3.0);
  return design;
}

GaussianNoise lock_noise() {
  return {Ball(0.056), Ball(0.0036), Ball(1e6)};
}

/// Why the set is not verified; empty when it is.
std::string lock_refusal(const WrittenSet& written, const Design& design = lock_design(),
                         const GaussianNoise& noise = lock_noise()) {
  std::int64_t cells = 0;
  Objections objections;
  const Tree tree = written.tree();
  check_lock_set(tree, design, noise, cells, objections);
  CHECK(objections.size() <= 1);
  CHECK(tree.unread(1).empty());
  return objections.empty() ? std::string() : objections.front();
}
std::string lock_refusal_with(const std::string& name, const std::string& number) {
  WrittenSet written;
  written.numbers.at(name) = number;
  return lock_refusal(written);
}
std::string lock_refusal_with(const std::string& name, std::size_t i, std::size_t j,
                              const std::string& number) {
  WrittenSet written;
  written.matrices.at(name)[i][j] = number;
  if (name != "metric") {
    written.matrices.at(name)[j][i] = number;
  }
  return lock_refusal(written);
}

void check_words(const std::string& text, const std::string& words) {
  CAPTURE(text);
  CHECK(text.find(words) != std::string::npos);
}

constexpr const char* kLockForm = "required form";
constexpr const char* kDefinite = "not positive definite";
constexpr const char* kLockRange = "out of range";
constexpr const char* kDrift = "not proved to shrink";
constexpr const char* kRounding = "rounding";
constexpr const char* kLess = "for less noise";

}  // namespace

TEST_CASE("the set is verified as it stands, in cells, the same ones each time") {
  std::array<std::int64_t, 2> cells{};
  std::array<std::int64_t, 2> spent{};
  for (std::size_t k = 0; k < 2; ++k) {
    set_budget(kDefaultBudget);
    Objections objections;
    check_lock_set(WrittenSet().tree(), lock_design(), lock_noise(), cells[k], objections);
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
  check_words(lock_refusal_with("drift", "0x0p+0"), kDrift);
  check_words(lock_refusal_with("drift", "0x1p-4"), kDrift);
  check_words(lock_refusal_with("noise_deviation", "0x1p-3"), kDrift);
  check_words(lock_refusal_with("frequency_walk", "0x1p-5"), kDrift);
  check_words(lock_refusal_with("level", "0x1p+8"), kRounding);
  check_words(lock_refusal_with("weight", "0x1p+6"), kDrift);
  check_words(lock_refusal_with("metric", 2, 2, "0x1.79de63862c32ap+6"), kDrift);
  check_words(lock_refusal_with("metric", 1, 2, "0x1.cf59f82b18cb9p+3"), kDrift);
  check_words(lock_refusal_with("spread_above", 0, 0, "0x1.0a5be83dfb60ep-13"), kDrift);
  check_words(lock_refusal_with("spread_below", 2, 2, "0x1.cd9cdf1c2647fp+4"), kDrift);
  check_words(lock_refusal_with("centre", 0, 0, "0x1.8b0216205dfc8p-12"), kDrift);
}

TEST_CASE("of sets that are accepted, whatever is changed in them, the textbook filter thinks the same") {
  test::Random random(5330);
  int accepted = 0;
  int refused = 0;
  double closest = -1e9;
  const std::int64_t sets = std::max<std::int64_t>(16, test::effort(16));  // fewer may all be refused
  for (std::int64_t k = 0; k < sets; ++k) {
    CAPTURE(k);
    LockSet set = WrittenSet().set();
    lock_test::Variances variances;
    const auto change = [&](Ball& number) {
      number = Ball(number.near() * std::exp(random.uniform(-0.4, 0.4)));
    };
    for (Ball* number :
         {&set.metric.amplitude, &set.metric.phase, &set.metric.coupling, &set.metric.frequency,
          &set.centre.p11, &set.centre.p22, &set.above.p11, &set.above.p22, &set.above.p33, &set.below.p11,
          &set.below.p22, &set.below.p33, &set.weight, &set.drift, &set.deviation, &set.walk}) {
      if (random.uniform() < 0.4) {
        change(*number);
      }
    }
    variances.r *= std::exp(random.uniform(-0.4, 0.4));
    std::int64_t cells = 0;
    if (!definite(whole(set.centre)) || !drifts_slowly(variances.filter(), set, cells)) {
      ++refused;
      continue;
    }
    ++accepted;
    const lock_test::Textbook book{variances, set};
    for (int l = 0; l < 2000; ++l) {
      const std::array<double, 4> x = lock_test::somewhere(set, random);
      const double excess = book.excess(book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]),
                                        book.covariance_of_level(x[3], random), x[3]);
      CHECK(excess <= 0.0);
      closest = std::max(closest, excess);
    }
  }
  MESSAGE(accepted << " accepted, " << refused << " refused, closest " << closest);
  CHECK(accepted > 1);
  CHECK(refused > 1);
}

TEST_CASE("a filter other than the one that the set is for is refused") {
  Design design = lock_design();
  SUBCASE("q1") {
    design.q1 = Ball(0.01);
  }
  SUBCASE("q2") {
    design.q2 = Ball(0.1);
  }
  SUBCASE("r") {
    design.r = Ball(0.003);
  }
  check_words(lock_refusal({}, design), kDrift);
}

TEST_CASE("a slew is refused, and a design that is none") {
  Design design = lock_design();
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
  check_words(lock_refusal({}, design), "epsilon < 1");
}

TEST_CASE("more noise in the design than the set is for is refused") {
  const Ball deviation = from_hexadecimal(WrittenSet().numbers.at("noise_deviation"));
  const Ball walk = from_hexadecimal(WrittenSet().numbers.at("frequency_walk"));
  CHECK(lock_refusal({}, lock_design(), {deviation, walk, one}).empty());
  check_words(lock_refusal({}, lock_design(), {deviation + Ball(1e-12), walk, one}), kLess);
  check_words(lock_refusal({}, lock_design(), {deviation, walk + Ball(1e-12), one}), kLess);
  check_words(lock_refusal({}, lock_design(), {Ball::everything(), walk, one}), kLess);
}

TEST_CASE("numbers have their sign") {
  check_words(lock_refusal_with("weight", "-0x1.15e35e3d9af1bp+1"), kLockRange);
  check_words(lock_refusal_with("weight", "0x0p+0"), kLockRange);
  check_words(lock_refusal_with("level", "-0x1p+2"), kLockRange);
  check_words(lock_refusal_with("level", "0x0p+0"), kLockRange);
  check_words(lock_refusal_with("drift", "-0x1p-20"), kLockRange);
  check_words(lock_refusal_with("noise_deviation", "-0x1.cc1fc5972b38ap-5"), kLockRange);
  check_words(lock_refusal_with("noise_deviation", "0x0p+0"), kLockRange);
  check_words(lock_refusal_with("frequency_walk", "-0x1.d7dbf487fcb92p-9"), kLockRange);
  for (const std::size_t i : {0U, 1U, 2U}) {
    check_words(lock_refusal_with("metric", i, i, "-0x1p+3"), "metric");
    check_words(lock_refusal_with("metric", i, i, "0x0p+0"), "metric");
  }
}

TEST_CASE("covariances that are not positive definite are refused") {
  for (const char* name : {"centre", "spread_above", "spread_below"}) {
    CAPTURE(name);
    check_words(lock_refusal_with(name, 0, 0, "-0x1p-10"), kDefinite);
    check_words(lock_refusal_with(name, 1, 1, "0x0p+0"), kDefinite);
    check_words(lock_refusal_with(name, 2, 2, "-0x1p-10"), kDefinite);
    check_words(lock_refusal_with(name, 1, 2, "0x1p+9"), kDefinite);
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
      check_words(lock_refusal(written), kLockForm);
    }
  }
  // Symmetric, but not apart.
  check_words(lock_refusal_with("centre", 0, 2, "0x1p-60"), kLockForm);
}

TEST_CASE("numbers that are no doubles, or huge, or tiny, end in a refusal") {
  for (const char* name : {"weight", "level", "drift", "noise_deviation", "frequency_walk"}) {
    for (const char* number : {"0x1p+1023", "0x1p+9999", "0x1p-9999"}) {
      CAPTURE(name);
      CAPTURE(number);
      const bool is_level = std::string(name) == "level";
      const bool is_walk = std::string(name) == "frequency_walk";
      const bool is_noise = std::string(name) == "noise_deviation";
      const std::string found = lock_refusal_with(name, number);
      // A small set or a large drift says little; and a set for less noise is not this one.
      if ((is_level && number[4] == '-') || (std::string(name) == "drift" && number[4] == '+')) {
        continue;
      }
      CHECK_FALSE(found.empty());
      if ((is_walk || is_noise) && number[4] == '-') {
        check_words(found, kLess);
      }
    }
  }
  for (const char* name : {"metric", "centre", "spread_above", "spread_below"}) {
    for (const std::size_t i : {0U, 1U, 2U}) {
      CHECK_FALSE(lock_refusal_with(name, i, i, "0x1p+1023").empty());
      CHECK_FALSE(lock_refusal_with(name, i, i, "0x1p+9999").empty());
    }
  }
  CHECK_THROWS(lock_refusal_with("level", "nan"));
  CHECK_THROWS(lock_refusal_with("level", "inf"));
  CHECK_THROWS(lock_refusal_with("level", "5"));
}

TEST_CASE("rounding has to stay within its room") {
  // Metric and spreads so small a part of the covariance that rounding is a large part of them.
  const LockSet set = WrittenSet().set();
  CHECK(has_room_for_rounding(set, lock_design(), Ball(1e6)));
  LockSet other = set;
  SUBCASE("of the error") {
    other.metric.frequency = Ball(1e12);
  }
  SUBCASE("of the covariance, above") {
    other.above = Ball(1e-10) * set.above;
  }
  SUBCASE("of the covariance, below") {
    other.below = Ball(1e-10) * set.below;
  }
  SUBCASE("with a large noise") {
    other.deviation = Ball(1e13);
  }
  SUBCASE("with a large walk") {
    other.walk = Ball(1e12);
  }
  CHECK_FALSE(has_room_for_rounding(other, lock_design(), Ball(1e6)));
}

TEST_CASE("the rounding is refused in the set as well") {
  Design design = lock_design();
  design.amplitude = Ball(0x1p70);
  check_words(lock_refusal({}, design), kRounding);
}

TEST_CASE("with a leak a set has its bias and its frequencies, and the frequency is constant") {
  Design design = lock_design();
  design.epsilon = Ball(lock_test::kLeak);
  const GaussianNoise noise{Ball(0.056), zero, Ball(1e6)};
  const auto refusal = [&](const std::string& walk, const std::string& more) {
    WrittenSet written;
    written.numbers.at("frequency_walk") = walk;
    std::string text = written.text();
    text.pop_back();
    const Tree tree = read_json(text + more + "}");
    std::int64_t cells = 0;
    Objections objections;
    const LockSet set = check_lock_set(tree, design, noise, cells, objections);
    return objections.empty() ? std::string() : objections.front();
  };
  const std::string good =
      R"(, "bias": ["0x1p-9", "-0x1.b2p-6", "-0x1.47p-5"], "frequencies": ["0x1.6p+0", "0x1.9p+0"])";
  CHECK(refusal("0x0p+0", good).empty());
  check_words(refusal("0x1p-20", good), "constant");
  check_words(refusal("0x0p+0", R"(, "bias": ["0x0p+0", "0x0p+0"], "frequencies": ["0x1p+0", "0x1p+0"])"),
              kLockForm);
  check_words(refusal("0x0p+0", R"(, "bias": ["0x0p+0", "0x0p+0", "0x0p+0"], "frequencies": ["0x1p+0"])"),
              kLockForm);
  check_words(refusal("0x0p+0",
                      R"(, "bias": ["0x0p+0", "0x0p+0", "0x0p+0"], "frequencies": ["0x1.9p+0", "0x1.6p+0"])"),
              "range");
  check_words(refusal("0x0p+0", ""), kLockForm);
  for (const double epsilon : {-0.01, 1.0}) {
    design.epsilon = Ball(epsilon);
    check_words(refusal("0x0p+0", good), "epsilon < 1");
  }
  design.epsilon = Ball(lock_test::kLeak);
  check_words(refusal("0x0p+0", R"(, "bias": ["0x0p+0", "0x0p+0", "0x0p+0"])"), kLockForm);
}

TEST_CASE("sets cover a band when each begins where the one before ends, and no sooner") {
  Design design = lock_design();
  design.lowest_frequency = Ball(0.5);
  design.highest_frequency = Ball(2.0);
  LockSet first;
  first.lowest_frequency = Ball(0.5);
  first.highest_frequency = Ball(1.0);
  LockSet second;
  second.lowest_frequency = Ball(1.0);
  second.highest_frequency = Ball(2.0);
  CHECK(cover_the_band({first, second}, design));
  CHECK_FALSE(cover_the_band({}, design));
  CHECK_FALSE(cover_the_band({first}, design));
  CHECK_FALSE(cover_the_band({second}, design));
  CHECK_FALSE(cover_the_band({second, first}, design));
  LockSet later = second;
  later.lowest_frequency = Ball(0x1.0000000000001p+0);
  CHECK_FALSE(cover_the_band({first, later}, design));
  design.highest_frequency = Ball(2.0) + Ball::within(Ball(1e-15));
  CHECK_FALSE(cover_the_band({first, second}, design));
}

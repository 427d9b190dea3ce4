// Formulas as a program that rounds, against the same expressions in single precision and in double.
#include "checker/code/written_formulas.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "checker/model/formula.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

using Json = nlohmann::json;

Json model(const std::string& step, const std::vector<std::string>& angles = {}) {
  return {{"samples", {"a", "b"}},
          {"parameters", Json::array({{{"name", "k"}, {"formula", "0.1/3"}}})},
          {"states", {"t", "w"}},
          {"angles", angles},
          {"step", step},
          {"frequency", "w"},
          {"arithmetic", "binary32"}};
}

WrittenFormulas written(const Json& json, int bits = 32) {
  return written_formulas(read_json(json.dump()), ListedFormat{true, bits});
}

/// Of t and w, in units of 2^-24, for |t - 0.35| <= 0.15 and the same of w, |a| <= 1 and |b| <= 1; none where
/// no bound is known.
std::vector<double> bounds(const WrittenFormulas& formulas) {
  const Ball state = Ball::hull(Ball(0.2), Ball(0.5));
  const auto found = listing_rounding(formulas.listing, formulas.known, {state, state}, Ball::within(one));
  std::vector<double> units;
  for (std::size_t i = 0; found && i < 2; ++i) {
    units.push_back((*found)[i].upper_double() * 0x1p24);
  }
  return units;
}

std::vector<double> bounds_of(const std::string& step, const std::vector<std::string>& angles = {}) {
  return bounds(written(model(step, angles)));
}

}  // namespace

TEST_CASE("steps in single precision stay within the bound, numbers and parameters in single precision too") {
  const std::vector<double> bound =
      bounds_of("e = a - w^3*2.1\nt' = t + k*e\nw' = clamp(w - 0.3*k*e/(2 + b^2), 0.1, 0.7)");
  REQUIRE(bound.size() == 2);
  test::Random random;
  double worst_t = 0.0;
  double worst_w = 0.0;
  for (std::int64_t i = test::effort(100'000); i > 0; --i) {
    const auto t = static_cast<float>(random.uniform(0.2, 0.5));
    const auto w = static_cast<float>(random.uniform(0.2, 0.5));
    const auto a = static_cast<float>(random.uniform(-1.0, 1.0));
    const auto b = static_cast<float>(random.uniform(-1.0, 1.0));
    const float k = 0.1F / 3.0F;
    const float e = a - w * w * w * 2.1F;
    const auto twice = [](float x) { return static_cast<double>(x); };
    const double exact_e = twice(a) - twice(w) * twice(w) * twice(w) * 2.1;
    const double exact_k = 0.1 / 3.0;
    worst_t = std::max(worst_t, std::fabs(twice(t + k * e) - (twice(t) + exact_k * exact_e)));
    const float next = std::fmin(std::fmax(w - 0.3F * k * e / (2.0F + b * b), 0.1F), 0.7F);
    const double exact =
        std::clamp(twice(w) - 0.3 * exact_k * exact_e / (2.0 + twice(b) * twice(b)), 0.1, 0.7);
    worst_w = std::max(worst_w, std::fabs(twice(next) - exact));
  }
  CHECK(worst_t * 0x1p24 <= bound[0]);
  CHECK(worst_t * 0x1p24 >= 0.3 * bound[0]);
  CHECK(worst_w * 0x1p24 <= bound[1]);
  CHECK(worst_w * 0x1p24 >= 0.3 * bound[1]);
}

TEST_CASE("a wrap of an angle costs what its turn and its operations are off") {
  // 0.5 of a sum of at most 3.1417 + 0.5, and then 3 of the same, and a turn that is off by 2.9e-8 or less.
  const std::vector<double> bound = bounds_of("t' = wrap(t + w)\nw' = w", {"t"});
  REQUIRE(bound.size() == 2);
  CHECK(bound[0] >= 3.6417 + 3.0 * 3.6417);
  CHECK(bound[0] <= 3.6417 + 3.0 * 3.6417 + 2.0 * 6.3);
  CHECK(bounds_of("t' = t + 40*w\nw' = w", {"t"}).empty());  // more than three turns
}

TEST_CASE("what jumps or is not limited has no bound") {
  CHECK(bounds_of("t' = t\nw' = if(a > 0, w, w + 0.1)").empty());
  CHECK(bounds_of("t' = t\nw' = if(w > 0.1, w, w + 0.1)").size() == 2);
  CHECK(bounds_of("t' = t\nw' = sign(a)").empty());
  CHECK(bounds_of("t' = t\nw' = sign(w)").size() == 2);
  CHECK(bounds_of("t' = t\nw' = clamp(a, b, 2)").size() == 2);
  CHECK(bounds_of("t' = t\nw' = clamp(a, b, 0.5)").empty());  // the limits may change places
  CHECK(bounds_of("t' = t\nw' = clamp(a, 2, 1)").empty());
  CHECK(bounds_of("t' = t\nw' = 1/a").empty());
  CHECK(bounds_of("x = stays_within(a, 0.1, 2)\nt' = t\nw' = 1/a").size() == 2);
  CHECK(bounds_of("x = stays_within(a, -0.1, 2)\nt' = t\nw' = 1/a").empty());
  CHECK(bounds_of("x = stays_within(a, w, 2)\nt' = t\nw' = 1/a").empty());
  CHECK(bounds_of("x = stays_within(a, 0.1, 2)\nt' = t\nw' = 1/b").empty());
}

TEST_CASE("two samples that are turned back need a limit below half a turn and a length") {
  const auto bound = [](const std::string& arc, const std::string& limit, double least) {
    WrittenFormulas formulas = written(
        model("e = " + arc + "\nx = stays_within(e, -" + limit + ", " + limit + ")\nt' = t + k*e\nw' = w"));
    formulas.known.least_sample = Ball(least);
    return bounds(formulas);
  };
  const std::string turned = "atan2(b*cos(t) - a*sin(t), a*cos(t) + b*sin(t))";
  REQUIRE(bound(turned, "3.14", 1e-3).size() == 2);
  CHECK(bound(turned, "3.14", 1e-3)[0] < 5.0);
  CHECK(bound(turned, "3.1415", 1e-3).empty());
  CHECK(bound(turned, "3.14", 0.0).empty());
  CHECK(bound("atan2(b*cos(t) - a*sin(w), a*cos(t) + b*sin(t))", "3.14", 1e-3).empty());
  CHECK(bound("atan2(b*cos(t) + a*sin(t), a*cos(t) + b*sin(t))", "3.14", 1e-3).empty());
  CHECK(bound("atan2(a*cos(t) + b*sin(t), b*cos(t) - a*sin(t))", "3.14", 1e-3).empty());
  CHECK(bound("atan2(a*cos(t) - a*sin(t), a*cos(t) + a*sin(t))", "3.14", 1e-3).empty());
}

TEST_CASE("the format is exact, binary32 or binary64, and bounds are those of the format") {
  const auto format = [](const Json& arithmetic) {
    Json json = model("t' = t\nw' = w");
    json["arithmetic"] = arithmetic;
    const auto found = written_format(read_json(json.dump()));
    return found ? found->bits : 0;
  };
  CHECK(format("exact") == 0);
  CHECK(format("binary32") == 32);
  CHECK(format("binary64") == 64);
  CHECK_THROWS_AS((void)format("binary16"), const Malformed&);
  const Json sum = model("t' = t\nw' = w + a");
  CHECK(bounds(written(sum, 64))[1] <= 1.01 * 0x1p-29 * bounds(written(sum))[1]);
  CHECK_THROWS_AS((void)written(model("t' = t\nw' = floor(a)")), const FormulaError&);
}

}  // namespace veritrack::checker

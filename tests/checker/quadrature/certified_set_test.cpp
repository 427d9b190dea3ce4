// Certified sets that break one hypothesis of the theorem and no other: each guard of check_set alone stands
// between them and VERIFIED.
#include "checker/quadrature/certified_set.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "checker/quadrature/contraction.hpp"
#include "tests/checker/quadrature/set_support.hpp"

using namespace veritrack::checker;
using set_test::json_of;
using set_test::mentions;
using set_test::Rows;

namespace {

/// Of the design of La Scala's Figure 3.5 without its leak.
struct WrittenCertifiedSet {
  Rows metric{{{"0x1.dd7f420252bdap+0", "0x0p+0", "0x0p+0"},
               {"0x0p+0", "0x1.94a22f42e4696p+2", "-0x1.02075762a01aap+2"},
               {"0x0p+0", "0x0p+0", "0x1.5c78cd65fb9f1p+4"}}};
  Rows lower{{{"0x1.2e4c5a0945dbfp-7", "0x0p+0", "0x0p+0"},
              {"0x0p+0", "0x1.832337e95f5c9p-6", "0x1.cf96fd9ebfcdbp-8"},
              {"0x0p+0", "0x1.cf96fd9ebfcdbp-8", "0x1.d54edb3a42124p-8"}}};
  Rows upper{{{"0x1.49e1fbad57c06p-7", "0x0p+0", "0x0p+0"},
              {"0x0p+0", "0x1.b0b68f440f5c1p-6", "0x1.099c6fba71f43p-7"},
              {"0x0p+0", "0x1.099c6fba71f43p-7", "0x1.080dcafbd5d4ap-7"}}};
  std::map<std::string, std::string> numbers{
      {"radius", "0x1.efdab44e59523p-4"}, {"noise", "0x1.0624dd2f1a9fcp-10"},     {"slew", "0x0p+0"},
      {"rate", "0x1.fb4e515d8926ep-1"},   {"noise_gain", "0x1.fb2a00562bb92p+3"}, {"slew_gain", "0x0p+0"}};
};

Design figure_3_5_design() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball::hull(Ball(0x1.2d77318fc5048p-9), Ball(0x1.2d77318fc5049p-9));
  design.r = Ball::hull(Ball(0x1.9999999999999p-5), Ball(0x1.999999999999ap-5));
  design.epsilon = zero;
  design.noise = Ball(0.001);
  design.slew = zero;
  design.amplitude_error = design.phase_error = design.frequency_error = Ball(0.005);
  return design;
}

/// Why the set is not verified; empty when it is.
std::string certified_set_refusal(const WrittenCertifiedSet& set,
                                  const Design& design = figure_3_5_design()) {
  std::string text = R"({"purpose": "settling", "metric": )" + json_of(set.metric) +
                     R"(, "covariance_lower": )" + json_of(set.lower) + R"(, "covariance_upper": )" +
                     json_of(set.upper);
  for (const auto& [name, number] : set.numbers) {
    text += ", \"" + name + "\": \"" + number + "\"";
  }
  std::int64_t cells = 0;
  Objections objections;
  const CertifiedSet checked = check_set(read_json(text + "}"), design, cells, objections);
  CHECK(checked.verified == objections.empty());
  return objections.empty() ? std::string() : objections.front();
}

std::string certified_set_refusal_with(const std::string& name, const std::string& number) {
  WrittenCertifiedSet set;
  set.numbers.at(name) = number;
  return certified_set_refusal(set);
}

constexpr const char* kRange = "out of range";
constexpr const char* kRequiredForm = "required form";

}  // namespace

TEST_CASE("the set is verified as it stands") {
  CHECK(certified_set_refusal({}).empty());
}

TEST_CASE("a set of a design with large corrections, as tight as the program proves it" *
          doctest::test_suite("nightly")) {
  // q1 = q2 = r = 0.1, noise 0.02, slew 0.0005: secants that are not the same from both ends lose it.
  WrittenCertifiedSet set;
  set.metric = {{{"0x1.336bf14a7ef5ep+1", "0x0p+0", "0x0p+0"},
                 {"0x0p+0", "0x1.be7e341a25e8ap+1", "-0x1.7cecb947b70fep+1"},
                 {"0x0p+0", "0x0p+0", "0x1.f8983cf69999cp+1"}}};
  set.lower = {{{"0x1.e9eb83b56446ep-5", "0x0p+0", "0x0p+0"},
                {"0x0p+0", "0x1.4808f225f032ap-4", "0x1.406421518bca7p-5"},
                {"0x0p+0", "0x1.406421518bca7p-5", "0x1.7dc20e87ec3c1p-3"}}};
  set.upper = {{{"0x1.065716d782d36p-4", "0x0p+0", "0x0p+0"},
                {"0x0p+0", "0x1.5958336e3cf4ep-4", "0x1.73359c99a451cp-5"},
                {"0x0p+0", "0x1.73359c99a451cp-5", "0x1.a0a93a7c21acfp-3"}}};
  set.numbers = {{"radius", "0x1.9723d7d783074p-4"},    {"noise", "0x1.47ae147ae1491p-6"},
                 {"slew", "0x1.0624dd2f1aa0ep-11"},     {"rate", "0x1.95662b0d86ebbp-1"},
                 {"noise_gain", "0x1.3de818f78f85p+1"}, {"slew_gain", "0x1.7acdaf78725b9p+4"}};
  Design design = figure_3_5_design();
  design.q1 = design.q2 = design.r = Ball::hull(Ball(0x1.9999999999999p-4), Ball(0x1.999999999999ap-4));
  design.noise = Ball(0.02);
  design.slew = Ball(0.0005);
  CHECK(certified_set_refusal(set, design).empty());
  set.numbers.at("rate") = "0x1.8p-1";
  CHECK(mentions(certified_set_refusal(set, design), "step inequality"));
}

TEST_CASE("numbers of a set have their sign, though the theorem's inequality knows only their squares") {
  CHECK(mentions(certified_set_refusal_with("radius", "-0x1.efdab44e59523p-4"), kRange));
  CHECK(mentions(certified_set_refusal_with("noise", "-0x1.0624dd2f1a9fcp-10"), kRange));
  CHECK(mentions(certified_set_refusal_with("rate", "-0x1.fb4e515d8926ep-1"), kRange));
  CHECK(mentions(certified_set_refusal_with("noise_gain", "-0x1.fb2a00562bb92p+3"), kRange));
  CHECK(mentions(certified_set_refusal_with("slew_gain", "-0x1p-2"), kRange));
  WrittenCertifiedSet set;
  set.numbers.at("slew_gain") = "0x1p+10";
  set.numbers.at("slew") = "0x1p-30";
  CHECK(certified_set_refusal(set).empty());
  set.numbers.at("slew") = "-0x1p-30";
  CHECK(mentions(certified_set_refusal(set), kRange));
}

TEST_CASE("a set whose errors do not shrink is refused, with noise and without") {
  WrittenCertifiedSet set;
  set.numbers.at("noise") = "0x0p+0";
  set.numbers.at("rate") = "0x1p+0";
  CHECK(mentions(certified_set_refusal(set), kRange));
}

TEST_CASE("noise that pushes the errors out of the set is refused") {
  WrittenCertifiedSet set;
  set.numbers.at("noise") = "0x1p-8";
  CHECK(mentions(certified_set_refusal(set), "(c)"));
}

TEST_CASE("gains that noise and slew exceed are refused, and are not left unread") {
  CHECK(mentions(certified_set_refusal_with("noise_gain", "0x1p+1"), "(a)"));
  WrittenCertifiedSet set;
  set.numbers.at("slew") = "0x1p-30";
  set.numbers.at("slew_gain") = "0x1p+1";
  CHECK(mentions(certified_set_refusal(set), "(a)"));
}

TEST_CASE("a covariance bound below zero is refused") {
  WrittenCertifiedSet set;
  set.numbers.at("noise") = "0x0p+0";
  set.numbers.at("radius") = "0x1p-20";
  CHECK(certified_set_refusal(set).empty());
  SUBCASE("in the amplitude") {
    set.lower[0][0] = "-0x1p-10";
  }
  SUBCASE("in the phase and the frequency") {
    set.lower[1][2] = set.lower[2][1] = "0x1.c8p-7";
  }
  SUBCASE("in the phase and in the frequency") {
    set.lower[1] = {"0x0p+0", "-0x1p-10", "0x0p+0"};
    set.lower[2] = {"0x0p+0", "0x0p+0", "-0x1p-12"};
  }
  CHECK(mentions(certified_set_refusal(set), "positive definite"));
}

TEST_CASE("covariance bounds out of order and amplitudes near zero are refused for what they are") {
  WrittenCertifiedSet set;
  set.upper = set.lower;
  CHECK(mentions(certified_set_refusal(set), "in order"));
  CHECK(mentions(certified_set_refusal_with("radius", "0x1p+1"), kRange));
}

TEST_CASE("an entry that the theorem's form does not have is refused, however small") {
  for (const auto& [i, j] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 0U}, {2U, 0U}, {2U, 1U}}) {
    CAPTURE(i);
    CAPTURE(j);
    WrittenCertifiedSet set;
    set.metric[i][j] = "0x1p-60";
    CHECK(mentions(certified_set_refusal(set), kRequiredForm));
  }
  for (const auto& [i, j] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 0U}, {2U, 0U}, {2U, 1U}}) {
    CAPTURE(i);
    CAPTURE(j);
    for (Rows WrittenCertifiedSet::*bound : {&WrittenCertifiedSet::lower, &WrittenCertifiedSet::upper}) {
      WrittenCertifiedSet set;
      (set.*bound)[i][j] = i == 2 && j == 1 ? "0x1.dp-8" : "0x1p-60";
      CHECK(mentions(certified_set_refusal(set), kRequiredForm));
    }
  }
  for (const std::size_t i : {0U, 1U, 2U}) {
    CAPTURE(i);
    WrittenCertifiedSet set;
    set.metric[i][i] = "-" + set.metric[i][i];
    set.metric[1][2] = i > 0 ? set.metric[1][2].substr(1) : set.metric[1][2];
    CHECK(mentions(certified_set_refusal(set), kRequiredForm));
  }
}

TEST_CASE("designs that the theorem is not about") {
  Design leaking = figure_3_5_design();
  leaking.epsilon = Ball(0x1p-60);
  CHECK(mentions(certified_set_refusal({}, leaking), "epsilon = 0"));
}

namespace {

Setting nested_setting() {
  Setting s;
  s.metric = {Ball(2.0), Ball(6.0), Ball(-4.0), Ball(20.0)};
  s.lower = {Ball(0.25), Ball(0.25), zero, Ball(0.25)};
  s.upper = {Ball(0.5), Ball(0.5), zero, Ball(0.5)};
  s.radius = Ball(0.125);
  s.noise = Ball(0.001);
  s.slew = Ball(0.0005);
  s.rate = Ball(0.5);
  s.noise_gain = Ball(16.0);
  s.slew_gain = Ball(16.0);
  return s;
}

/// The ultimate frequency error that two verified sets promise, of which the smaller one is reached only if
/// it contains where the larger one leads. A set around them that starts are in, and the one to be reached.
double ultimate_error(const Setting& outer, const Setting& inner, const Design& design) {
  const Tree nothing = read_json(R"({"conditions": [], "quantities": {}})");
  Objections objections;
  const Promises promises =
      check_contraction(nothing, design, {{"outer", outer, true}, {"inner", inner, true}}, objections);
  REQUIRE(promises.ultimate.has_value());
  return promises.ultimate->near();
}

}  // namespace

TEST_CASE("a set is reached only when errors and covariances that the other set ends with lie in it") {
  Design design = figure_3_5_design();
  design.covariance = std::array<std::array<Ball, 3>, 3>{
      {{Ball(0.4), zero, zero}, {zero, Ball(0.4), zero}, {zero, zero, Ball(0.4)}}};
  const Setting outer = nested_setting();
  Setting inner = outer;
  inner.noise_gain = Ball(4.0);
  inner.radius = Ball(0.0625);
  inner.lower = {Ball(0.125), Ball(0.125), zero, Ball(0.125)};
  inner.upper = {Ball(0.75), Ball(0.75), zero, Ball(0.75)};
  // Starts are in the outer set only.
  design.frequency_error = Ball(0.005);
  design.amplitude_error = design.phase_error = Ball(0.001);
  const double of_outer = ultimate_error(outer, outer, design);
  REQUIRE(ultimate_error(outer, inner, design) < 0.5 * of_outer);
  SUBCASE("errors") {
    inner.radius = Ball(0x1p-6);
  }
  SUBCASE("errors that the outer set only nearly leaves") {
    const Ball level = ultimate_level(outer, design);
    const std::array<Ball, 3> rows = inverse_rows(outer.metric);
    inner.radius = Ball(0.9) * largest_level(inner.metric, level * rows[0], level * rows[1], level * rows[2]);
  }
  SUBCASE("a lower bound on the covariance that is higher") {
    inner.lower.p33 = Ball(0.375);
  }
  SUBCASE("an upper bound on the covariance that is lower") {
    inner.upper.p22 = Ball(0.375);
  }
  SUBCASE("a set for less noise") {
    inner.noise = Ball(0.0009);
  }
  SUBCASE("a set for less slew") {
    inner.slew = Ball(-0.0001);
  }
  CHECK(ultimate_error(outer, inner, design) == of_outer);
}

TEST_CASE("settling counts from where the errors begin, and never below what noise leaves") {
  const Setting set = nested_setting();
  const Design design = figure_3_5_design();
  const double ultimate = ultimate_level(set, design).near();
  const Ball twice(2.0 * ultimate / 20.0);
  const Ball start(100.0 * ultimate);
  CHECK(settled(set, design, start, twice, Ball(6.0)));
  CHECK(!settled(set, design, start, twice, Ball(5.0)));
  CHECK(settled(set, design, Ball(1.9 * ultimate), twice, zero));
  CHECK(!settled(set, design, Ball(2.1 * ultimate), twice, zero));
  CHECK(!settled(set, design, start, Ball(-1.0), Ball(6.0)));
  const Ball less(0.9 * ultimate / 20.0);
  CHECK(!settled(set, design, Ball(0.5 * ultimate), less, zero));
  CHECK(!settled(set, design, start, less, Ball(1e6)));
}

TEST_CASE("a covariance is between bounds only when it is on both sides") {
  const Setting set = nested_setting();
  const auto at = [](double x) { return diagonal(Ball(x), Ball(x), Ball(x)); };
  CHECK(between(at(0.4), set.lower, set.upper));
  CHECK(!between(at(0.2), set.lower, set.upper));
  CHECK(!between(at(0.6), set.lower, set.upper));
}

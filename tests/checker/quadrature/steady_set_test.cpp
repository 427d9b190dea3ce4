// Sets around the steady state that break one hypothesis and no other: each guard of check_steady_set alone
// stands between them and VERIFIED.
#include "checker/quadrature/steady_set.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "checker/quadrature/steady_contraction.hpp"
#include "checker/quadrature/steady_level.hpp"
#include "tests/checker/quadrature/set_support.hpp"

using namespace veritrack::checker;
using set_test::json_of;
using set_test::mentions;
using set_test::Rows;

namespace {

struct WrittenSteadySet {
  Rows metric{{{"0x1.26f60fcf42f99p+3", "-0x1.4474904eb833fp-4", "0x1.314e15e4258c8p-2"},
               {"0x0p+0", "0x1.72f8404d79878p+2", "-0x1.35c7f87585c5fp+1"},
               {"0x0p+0", "0x0p+0", "0x1.fe07e5b01d99p+2"}}};
  Rows below{{{"0x1.9e5f9a46e91c6p-11", "0x1.5934cff3bf5cp-16", "0x1.43903c3d3673dp-15"},
              {"0x1.5934cff3bf5cp-16", "0x1.ae4bd437c40e4p-10", "0x1.b7eed69dfaae3p-11"},
              {"0x1.43903c3d3673dp-15", "0x1.b7eed69dfaae3p-11", "0x1.568f2161610c5p-11"}}};
  Rows above{{{"0x1.22704c0998bcbp-10", "-0x1.14551f14672a8p-17", "0x1.385cb246b75d6p-15"},
              {"-0x1.14551f14672a8p-17", "0x1.832e438f0261cp-10", "0x1.f8e67a0592e88p-11"},
              {"0x1.385cb246b75d6p-15", "0x1.f8e67a0592e88p-11", "0x1.d6dbdf05b0d92p-11"}}};
  std::vector<std::string> levels{"0x1p+0", "0x1.d244f73243c0ap-1"};
  std::string noise = "0x1.0624dd2f1a9fcp-10";
  std::string slew = "0x0p+0";
};

Design design_of_the_set() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  design.epsilon = Ball(0.01);
  design.lowest_frequency = Ball(0.02);
  design.highest_frequency = Ball(0.0201);
  design.noise = Ball(0.001);
  design.slew = zero;
  return design;
}

const std::vector<SteadyCell>& branch_of_the_set() {
  static const auto branch = steady_branch(design_of_the_set(), 0.3, 1e-4);
  REQUIRE(branch.has_value());
  return *branch;
}

std::string evidence_of(const WrittenSteadySet& set, const std::string& name) {
  std::string text = R"({"name": ")" + name + R"(", "matrices": {"metric": )" + json_of(set.metric) +
                     R"(, "covariance_below": )" + json_of(set.below) + R"(, "covariance_above": )" +
                     json_of(set.above) + R"(}, "numbers": {"noise": ")" + set.noise + R"(", "slew": ")" +
                     set.slew + "\"";
  for (std::size_t j = 0; j < set.levels.size(); ++j) {
    text += ", \"s_" + std::to_string(j) + "\": \"" + set.levels[j] + "\"";
  }
  return text + "}}";
}

/// Why the set is not verified; empty when it is.
std::string steady_set_refusal(const WrittenSteadySet& set) {
  std::int64_t cells = 0;
  Objections objections;
  const SteadySet checked = check_steady_set(read_json(evidence_of(set, "a")), design_of_the_set(),
                                             branch_of_the_set(), cells, objections);
  CHECK(checked.verified == objections.empty());
  return objections.empty() ? std::string() : objections.front();
}

}  // namespace

TEST_CASE("the set around the steady state is verified as it stands, and for a little slew") {
  CHECK(steady_set_refusal({}).empty());
  WrittenSteadySet set;
  set.slew = "0x1p-20";
  CHECK(steady_set_refusal(set).empty());
  set.slew = "0x1p-4";
  CHECK(!steady_set_refusal(set).empty());
}

TEST_CASE("entries and signs that the form does not have are refused, however small") {
  for (const auto& [i, j] : {std::pair{1U, 0U}, {2U, 0U}, {2U, 1U}}) {
    CAPTURE(i);
    CAPTURE(j);
    WrittenSteadySet set;
    set.metric[i][j] = "0x1p-60";
    CHECK(mentions(steady_set_refusal(set), "required form"));
    for (Rows WrittenSteadySet::*bound : {&WrittenSteadySet::below, &WrittenSteadySet::above}) {
      WrittenSteadySet other;
      (other.*bound)[i][j] = "0x1p-60";
      CHECK(mentions(steady_set_refusal(other), "required form"));
    }
  }
  for (const std::size_t i : {0U, 1U, 2U}) {
    CAPTURE(i);
    WrittenSteadySet set;
    for (std::string& entry : set.metric[i]) {  // the rows of T may have either sign, as far as |T e| goes
      entry = entry.front() == '-' ? entry.substr(1) : "-" + entry;
    }
    CHECK(mentions(steady_set_refusal(set), "required form"));
  }
}

TEST_CASE("levels begin at 1 and fall, noise and slew are not negative") {
  WrittenSteadySet set;
  SUBCASE("a first level below 1") {
    set.levels = {"0x1.ffp-1", "0x1.d244f73243c0ap-1"};
  }
  SUBCASE("a level that does not fall") {
    set.levels = {"0x1p+0", "0x1p+0"};
  }
  SUBCASE("a second level that does not fall") {
    set.levels = {"0x1p+0", "0x1.d244f73243c0ap-1", "0x1.d244f73243c0ap-1"};
  }
  SUBCASE("no level") {
    set.levels.clear();
  }
  SUBCASE("noise") {
    set.noise = "-0x1p-20";
  }
  SUBCASE("slew") {
    set.slew = "-0x1p-4";
  }
  CHECK(mentions(steady_set_refusal(set), "out of range"));
}

TEST_CASE("bounds on the covariance that are none") {
  WrittenSteadySet set;
  std::string why;
  SUBCASE("below") {
    set.below[0][0] = "-0x1p-30";
    why = "not positive definite";
  }
  SUBCASE("above") {
    set.above[0][0] = "-0x1p-30";
    why = "not positive definite";
  }
  SUBCASE("so far below that covariances of the set are not definite") {
    set.below[0][0] = "0x1p-6";
    set.below[1][1] = "0x1p-6";
    set.below[2][2] = "0x1p-6";
    why = "P* - below";
  }
  SUBCASE("kept from below, not from above") {
    set.above[2][2] = "0x1.8p-11";
    why = "next level";
  }
  SUBCASE("kept from above, not from below") {
    set.below[2][2] = "0x1.2p-11";
    why = "next level";
  }
  CHECK(mentions(steady_set_refusal(set), why));
}

namespace {

Rows times(double factor, Rows rows) {
  for (auto& row : rows) {
    for (std::string& entry : row) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), "%a", factor * from_hexadecimal(entry).near());
      entry = text.data();
    }
  }
  return rows;
}

}  // namespace

// The derivative of the steady covariance has eigenvalues of either sign, of which correlations in the bound
// make the one or the other count more.
TEST_CASE("slew moves the covariances, too, up and down") {
  WrittenSteadySet set;
  SUBCASE("one way") {
    set.below = times(0.87467, set.below);
  }
  SUBCASE("and the other") {
    set.below[0][1] = set.below[1][0] = "-" + set.below[0][1];
    set.below[0][2] = set.below[2][0] = "-" + set.below[0][2];
    set.below = times(0.87808, set.below);
  }
  CHECK(steady_set_refusal(set).empty());
  set.slew = "0x1.0624dd2f1a9fcp-8";
  CHECK(mentions(steady_set_refusal(set), "next level"));
}

TEST_CASE("directions of the metric that are too much alike are not covered") {
  WrittenSteadySet set;
  set.metric = {{{"0x1p+0", "0x0p+0", "-0x1.9p+6"},
                 {"0x0p+0", "0x1p+0", "-0x1.8cp+6"},
                 {"0x0p+0", "0x0p+0", "0x1p+0"}}};
  CHECK(!steady_set_refusal(set).empty());
}

TEST_CASE("what is promised in the long run counts the bias, and the last level") {
  const WrittenSteadySet set;
  const Tree derivation = read_json(R"({"conditions": [], "quantities": {}, "evidence": [)" +
                                    evidence_of(set, "start-error") + "]}");
  std::int64_t cells = 0;
  Objections objections;
  Design design = design_of_the_set();
  design.amplitude_error = design.phase_error = design.frequency_error = Ball(0x1p-20);
  const Promises promises = check_steady_contraction(derivation, design, cells, objections);
  REQUIRE(promises.ultimate.has_value());
  const double bias = std::fabs(branch_of_the_set().back().middle[2].near());
  const double reach = 1.0 / from_hexadecimal(set.metric[2][2]).near();
  const double expected = bias + from_hexadecimal(set.levels.back()).near() * reach;
  CHECK(bias > 0.004 * reach);
  CHECK(promises.ultimate->near() >= expected * (1.0 - 1e-3));
  CHECK(promises.ultimate->near() <= expected * (1.0 + 1e-2));
}

TEST_CASE("the rate is that of the slowest step") {
  WrittenSteadySet set;
  set.levels = {"0x1p+0", "0x1.fp-1", "0x1.cdp-1"};
  CHECK(steady_set_refusal(set).empty());
  const Tree derivation = read_json(R"({"conditions": [], "quantities": {}, "evidence": [)" +
                                    evidence_of(set, "start-error") + "]}");
  std::int64_t cells = 0;
  Objections objections;
  const Promises promises = check_steady_contraction(derivation, design_of_the_set(), cells, objections);
  REQUIRE(promises.rate.has_value());
  CHECK(promises.rate->near() >= 0x1.fp-1);
}

TEST_CASE("a set is one for its own noise and slew, and for no more") {
  const Tree derivation = read_json(R"({"conditions": [], "quantities": {}, "evidence": [)" +
                                    evidence_of(WrittenSteadySet(), "start-error") + "]}");
  const auto has_set = [&](const Design& design) {
    std::int64_t cells = 0;
    Objections objections;
    return check_steady_contraction(derivation, design, cells, objections).reach.has_value();
  };
  Design design = design_of_the_set();
  CHECK(has_set(design));
  SUBCASE("noise") {
    design.noise = Ball(0.00101);
  }
  SUBCASE("slew") {
    design.slew = Ball(0x1p-60);
  }
  CHECK_FALSE(has_set(design));
}

TEST_CASE("settling is claimed at no less than the ultimate error, and not before the last level") {
  Design design = design_of_the_set();
  design.amplitude_error = design.phase_error = Ball(0x1p-20);
  design.frequency_error = Ball(0.118);  // above the last level
  const Symmetric<Ball> steady = covariance_part(branch_of_the_set().back().middle);
  design.covariance = matrix_of(steady);
  const auto settles = [&](const std::string& error, const std::string& samples) {
    const Tree derivation =
        read_json(R"({"conditions": [], "quantities": {"settling_samples": {"hi": ")" + samples +
                  R"("}, "settled_frequency_error": {"hi": ")" + error + R"("}}, "evidence": [)" +
                  evidence_of(WrittenSteadySet(), "start-error") + "]}");
    std::int64_t cells = 0;
    Objections objections;
    return check_steady_contraction(derivation, design, cells, objections).settled.has_value();
  };
  CHECK(settles("0x1p-1", "0x1p+0"));
  CHECK_FALSE(settles("0x1p-1", "0x0p+0"));
  CHECK_FALSE(settles("0x1p-6", "0x1p+0"));
}

namespace {

/// Does a step from level 1 lead to so high a level that only the meaning of the step is in question?
bool leads_anywhere(const Ball& noise, const Ball& motion = zero, const Ball& covariance_motion = zero) {
  SteadySetting setting;
  const Design design = design_of_the_set();
  setting.q1 = design.q1;
  setting.q2 = design.q2;
  setting.r = design.r;
  setting.retention = one - design.epsilon;
  setting.metric = {Ball(16.0), zero, zero, Ball(16.0), zero, Ball(16.0)};
  setting.below = setting.above = {Ball(1e-4), zero, zero, Ball(1e-4), zero, Ball(1e-4)};
  setting.set_directions();
  SteadyCover cover(setting, branch_of_the_set().back());
  const Ball next(1e6);
  return cover.maps_into_next({one, next - motion, next - covariance_motion, noise});
}

}  // namespace

TEST_CASE("what noise may carry through zero leads nowhere, nor what more noise may") {
  CHECK(leads_anywhere(Ball(0.001)));
  CHECK(!leads_anywhere(Ball(3.0)));
  CHECK(!leads_anywhere(Ball(1e3)));
}

TEST_CASE("a steady state that moves farther than the next level leads nowhere") {
  CHECK(leads_anywhere(Ball(0.001), Ball(1e3), Ball(1e3)));
  CHECK(!leads_anywhere(Ball(0.001), Ball(1e9)));
  CHECK(!leads_anywhere(Ball(0.001), zero, Ball(1e9)));
}

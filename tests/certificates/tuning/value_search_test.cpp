#include "certificates/tuning/value_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/request_error.hpp"
#include "tests/certificates/tuning/tuning_example.hpp"

namespace veritrack::certificates {
namespace {

/// A tracker whose certified values are known: best at q1 = r/10 and q2 = r/100.
struct Example {
  explicit Example(const std::string& text = testing::kTunedText)
      : design(read_design(text, "design.toml")), tables(quadrature_tables(design)) {
    problem.assume = &tables.assume;
    problem.require = &tables.require;
    problem.given = {tables.design.q1.text, tables.design.q2.text, tables.design.r.text,
                     tables.design.epsilon.text};
    problem.design_with = [this](const DesignValues&) { return design; };
    problem.certify = [this](const DesignValues& values, const Assumptions&, const std::set<Objective>&) {
      ++asked;
      const double r = number_of(values.r).nearest;
      CertifiedValues found;
      found.long_run = 0.01 * (1.0 + std::pow(std::log10(number_of(values.q1).nearest / r) + 1.0, 2) +
                               std::pow(std::log10(number_of(values.q2).nearest / r) + 2.0, 2));
      found.for_ever = 2.0 * found.long_run;
      found.radius = 0.1;
      found.noise = 0.05 * number_of(values.q2).nearest / r;
      found.slew = 1.0;
      return found;
    };
  }

  Design design;
  QuadratureEkfTables tables;
  TuningProblem problem;
  int asked = 0;
};

double ratio(const std::string& q, const std::string& r) {
  return number_of(q).nearest / number_of(r).nearest;
}

TEST_CASE("the best is found, and r is the variance of the noise") {
  const rigor::NearestRounding nearest;
  Example example;
  const TuningOutcome outcome = search_values(example.problem, TuningRequest());
  CHECK(ratio(outcome.chosen.q1, outcome.chosen.r) == doctest::Approx(0.1).epsilon(0.15));
  CHECK(ratio(outcome.chosen.q2, outcome.chosen.r) == doctest::Approx(0.01).epsilon(0.15));
  CHECK(outcome.chosen.r == "0.0001");  // 0.02^2/4
  CHECK(outcome.is_met);
  CHECK_FALSE(outcome.was_stopped);
  CHECK(outcome.after.long_run < outcome.before.long_run);
  const auto count = [&](TriedDesign::Role role) {
    const auto& all = outcome.trade_off.designs;
    return std::count_if(all.begin(), all.end(), [&](const TriedDesign& each) { return each.role == role; });
  };
  CHECK(count(TriedDesign::Role::given) == 1);
  CHECK(count(TriedDesign::Role::chosen) == 1);
  CHECK(count(TriedDesign::Role::trade_off) == 9);
}

TEST_CASE("the same twice, with no more designs than allowed") {
  const rigor::NearestRounding nearest;
  Example one;
  Example two;
  TuningRequest request;
  request.most_designs = 7;
  int told = 0;
  request.progress = [&](int done, int /*most*/) { told = done; };
  const TuningOutcome first = search_values(one.problem, request);
  CHECK(first.chosen == search_values(two.problem, request).chosen);
  CHECK(first.looked_at <= 7);
  CHECK(one.asked <= 7 + 8);
  CHECK(told == one.asked);
}

TEST_CASE("what is required comes first") {
  const rigor::NearestRounding nearest;
  Example example(testing::kTunedText + "[require]\nlargest_noise_at_least = 0.05\n");  // q2 = r
  const TuningOutcome outcome = search_values(example.problem, TuningRequest());
  CHECK(outcome.is_met);
  CHECK(ratio(outcome.chosen.q2, outcome.chosen.r) >= 0.999);
}

TEST_CASE("a deadline that is over leaves the given values, and says so") {
  const rigor::NearestRounding nearest;
  Example example;
  const std::atomic<bool> now{true};
  TuningRequest request;
  request.deadline = search::Deadline().or_when(now);
  const TuningOutcome outcome = search_values(example.problem, request);
  CHECK(outcome.was_stopped);
  CHECK(outcome.chosen == example.problem.given);
  CHECK(example.asked == 1);
  const auto notes = notes_of(example.problem, outcome);
  CHECK(notes.back().find("time limit") != std::string::npos);
}

TEST_CASE("objectives go with the noise") {
  Example bounded;
  Example gaussian(testing::kTunedTextAt20Decibels);
  CHECK(chosen_objective("", bounded.tables.assume) == Objective::long_run);
  CHECK(chosen_objective("", gaussian.tables.assume) == Objective::rms);
  CHECK(chosen_objective("simulated-rms", bounded.tables.assume) == Objective::simulated_rms);
  CHECK_THROWS_WITH_AS((void)chosen_objective("noise", gaussian.tables.assume),
                       doctest::Contains("allowed: rms, lowest-snr, simulated-rms"), RequestError);
  CHECK_THROWS_AS((void)chosen_objective("rms", bounded.tables.assume), RequestError);
}

TEST_CASE("a leak stays, unless it is free") {
  const rigor::NearestRounding nearest;
  std::string text = testing::kTunedText;
  text.replace(text.find("epsilon = 0"), 11, "epsilon = 0.05");
  Example example(text);
  CHECK(search_values(example.problem, TuningRequest()).chosen.epsilon == "0.05");
  example.problem.free_leak = true;
  const auto certify = example.problem.certify;
  example.problem.certify = [&](const DesignValues& values, const Assumptions& assume,
                                const std::set<Objective>& needed) {
    CertifiedValues found = certify(values, assume, needed);
    found.long_run += number_of(values.epsilon).nearest;
    return found;
  };
  CHECK(search_values(example.problem, TuningRequest()).chosen.epsilon == "0");
  // One that pays becomes larger, but no tracker has a leak of 1.
  example.problem.certify = [&](const DesignValues& values, const Assumptions& assume,
                                const std::set<Objective>& needed) {
    CertifiedValues found = certify(values, assume, needed);
    found.long_run /= 1.0 + 100.0 * number_of(values.epsilon).nearest;
    return found;
  };
  const double leak = number_of(search_values(example.problem, TuningRequest()).chosen.epsilon).nearest;
  CHECK(leak > 0.05);
  CHECK(leak <= 0.5);
}

TEST_CASE("simulations are compared as they are where nothing is required") {
  const rigor::NearestRounding nearest;
  Requirements require;
  CHECK_FALSE(asks_for_proofs(Objective::simulated_rms, require));
  CHECK(asks_for_proofs(Objective::long_run, require));
  Example example;
  example.problem.objective = Objective::simulated_rms;
  example.problem.certify = [](const DesignValues&, const Assumptions&, const std::set<Objective>& needed) {
    CHECK(needed == std::set<Objective>{Objective::simulated_rms});
    CertifiedValues found;  // nothing certified
    found.simulated_rms = 0.01;
    return found;
  };
  CHECK(search_values(example.problem, TuningRequest()).is_met);
  require.rms_frequency_error_below = number_of("0.1");
  CHECK(asks_for_proofs(Objective::simulated_rms, require));
}

}  // namespace
}  // namespace veritrack::certificates

#include "analysis/sets/kalman_filter_result.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::sets {
namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;

Condition condition(const char* id, Verdict verdict) {
  return {id, "", verdict, Interval::empty(), Interval::empty(), std::string(id) + "."};
}

std::vector<std::string> names_of(const std::vector<theorems::Quantity>& quantities) {
  std::vector<std::string> names;
  names.reserve(quantities.size());
  for (const auto& quantity : quantities) {
    names.push_back(quantity.name);
  }
  return names;
}

TEST_CASE("a bound is proved only when every assumed start is covered, and when it is finite") {
  const rigor::UpwardRounding upward;
  StartResult starts;
  CHECK_FALSE(starts.proved_bound());
  starts.verdict = Verdict::proved;
  CHECK_FALSE(starts.proved_bound());
  theorems::set_value(starts.frequency_error_bound, Interval(0.25));
  REQUIRE(starts.proved_bound());
  CHECK(starts.proved_bound()->upper() == 0.25);
  for (const Verdict verdict : {Verdict::undecided, Verdict::refuted}) {
    starts.verdict = verdict;
    CHECK_FALSE(starts.proved_bound());
  }
}

TEST_CASE("a value that is not finite makes its quantity not applicable, and a finite one applicable again") {
  const rigor::UpwardRounding upward;
  theorems::Quantity bound = quantities::frequency_error_bound();
  CHECK_FALSE(bound.applies());
  theorems::set_value(bound, Interval(1.0));
  CHECK(bound.applies());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Interval& value : {Interval::empty(), Interval::from_bounds(0.0, infinity)}) {
    theorems::set_value(bound, value, "No set.");
    CHECK_FALSE(bound.applies());
    CHECK(*bound.not_applicable == "No set.");
    CHECK(rigor::is_empty(bound.value));
  }
}

TEST_CASE("the first open condition is the first that is not PROVED, whatever comes after") {
  StartResult starts;
  CHECK(starts.first_open_condition() == nullptr);
  starts.conditions = {condition("a", Verdict::proved), condition("b", Verdict::undecided),
                       condition("c", Verdict::refuted)};
  CHECK(starts.first_open_condition()->id == "b");
  CHECK(starts.first_condition(Verdict::refuted)->id == "c");
  starts.conditions.resize(1);
  CHECK(starts.first_open_condition() == nullptr);
  CHECK(starts.first_condition(Verdict::refuted) == nullptr);
}

TEST_CASE("the quantities of a result come in the order of the certificates, before the sampled ones") {
  KalmanFilterResult result;
  theorems::Derivation derivation;
  derivation.conditions = {condition("a", Verdict::proved)};
  derivation.quantities = {{"sampled", "", "", "", Interval(1.0), std::nullopt, theorems::Sense::sampled}};
  conclude(derivation, result);
  CHECK(names_of(derivation.quantities) ==
        std::vector<std::string>{"contraction_rate", "radius", "frequency_error_radius", "phase_error_radius",
                                 "amplitude_error_radius", "ultimate_frequency_error",
                                 "frequency_error_bound", "settling_samples", "settled_frequency_error",
                                 "largest_noise", "largest_slew", "sampled"});
  CHECK(result.starts.verdict == Verdict::proved);
  CHECK(result.starts.conditions.size() == 1);
  result.starts.capture_samples = quantities::capture_samples();
  result.bias_frequency = quantities::bias_frequency();
  const auto names = names_of(quantities_of(result));
  CHECK(names[7] == "capture_samples");
  CHECK(names.back() == "bias_frequency");
}

TEST_CASE("every quantity has words with its unit or what it counts") {
  KalmanFilterResult result;
  for (const auto& quantity : quantities_of(result)) {
    CAPTURE(quantity.name);
    CHECK_FALSE(quantity.words.empty());
    CHECK_FALSE(quantity.symbol.empty());
    CHECK(quantity.is_proved());
  }
}

}  // namespace
}  // namespace veritrack::sets

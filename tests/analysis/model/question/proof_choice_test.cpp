#include "analysis/model/question/proof_choice.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

SetQuestion question_over(const test::TwoChannelExample& loop, double low, double high) {
  SetQuestion question{.tone = loop.tone, .tracker = loop.model};
  question.whole_band = Interval::from_bounds(low, high);
  question.band = searched_band(question.whole_band, 2);
  return question;
}

TEST_CASE("a filter's covariance is bounded unless its start is assumed, or few states have another F") {
  trackers::FilterParts filter;
  filter.states = 3;
  CHECK(covariance_is_bounded(filter, false));
  CHECK_FALSE(covariance_is_bounded(filter, true));
  filter.has_given_jacobian = true;
  CHECK_FALSE(covariance_is_bounded(filter, false));
  filter.states = 4;
  CHECK(covariance_is_bounded(filter, false));
}

TEST_CASE("with two channels gains are enough") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_over(loop, -0.5, 0.5);
  question.allows_gains = true;
  question.noise = 0.05;
  const FirstProof first = prove_by_gains_first(question);
  CHECK(first.is_enough);
  CHECK(first.by_gains);
  CHECK_FALSE(first.no_gains);
  CHECK_FALSE(first.objection);
}

TEST_CASE("where gains are not asked, tubes need a band, and not too many states") {
  using Kind = ProofObjection::Kind;
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_over(loop, 0.25, 0.5);
  FirstProof first = prove_by_gains_first(question);
  CHECK_FALSE(first.objection);
  CHECK_FALSE(first.is_enough);
  CHECK_FALSE(first.by_gains);
  REQUIRE(first.no_gains);
  CHECK(first.no_gains->kind == NoGains::Kind::question);

  const auto objection = [](const SetQuestion& asked) {
    const FirstProof found = prove_by_gains_first(asked);
    CHECK_FALSE(found.is_enough);
    REQUIRE(found.objection);
    return *found.objection;
  };
  CHECK(objection(question_over(loop, 0.25, 0.25)).kind == Kind::no_band);
  CHECK(objection(question_over(loop, -0.25, 0.25)).kind == Kind::negative_frequencies);

  trackers::Recursion larger = *question.tracker.recursion;
  question.tracker.recursion = &larger;
  larger.states = 16;
  CHECK_FALSE(prove_by_gains_first(question).objection);
  for (const auto& [states, most] : {std::pair(17, 16), std::pair(20, 16), std::pair(21, 20)}) {
    larger.states = states;
    const ProofObjection found = objection(question);
    CHECK(found.kind == Kind::too_many_states);
    CHECK(found.states == states);
    CHECK(found.most_states == most);
  }
}

TEST_CASE("gains stand where tubes prove nothing") {
  const rigor::UpwardRounding upward;
  const test::Example loop(test::phase_locked_loop());
  SetQuestion question{.tone = test::tone_of(loop.tracker), .tracker = loop.model};
  question.whole_band = Interval::from_bounds(0.0, 0.3002);
  question.band = {0.3, 0.3002, {}};
  question.noise = 0.01;
  question.deviations = {Interval(0.0), Interval(0.0)};
  question.deadline = search::Deadline(0.0);  // no tube is found
  ProvedSets by_gains;
  by_gains.assumed.emplace().tubes.noise = 0.01;
  CHECK_FALSE(choose_proof(question, by_gains).is_by_gains);
  by_gains.assumed->tubes.is_complete = true;
  const ChosenProof chosen = choose_proof(question, by_gains);
  CHECK(chosen.is_by_gains);
  CHECK(chosen.sets.deciding().is_proved());

  CHECK_FALSE(choose_proof(question, std::nullopt).no_phase_gains);
  question.allows_phase_gains = true;
  const ChosenProof without = choose_proof(question, std::nullopt);
  REQUIRE(without.no_phase_gains);
  CHECK(without.no_phase_gains->kind == NoGains::Kind::band);
  CHECK_FALSE(without.sets.deciding().is_proved());

  // The time is over: nothing is said of the loop.
  question.whole_band = Interval::from_bounds(0.3, 0.3002);
  const ChosenProof late = choose_proof(question, std::nullopt);
  REQUIRE(late.no_phase_gains);
  CHECK(late.no_phase_gains->kind == NoGains::Kind::time);
  CHECK(late.no_phase_gains->detail.find("a basis was found") == 0);
}

}  // namespace
}  // namespace veritrack::model

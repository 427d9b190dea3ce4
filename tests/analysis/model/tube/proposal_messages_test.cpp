// The words of proposals that failed: proposal_messages.cpp, declared in tube_proposal.hpp.
#include <doctest/doctest.h>

#include <string>

#include "analysis/model/tube/frequency_cells.hpp"

namespace veritrack::model {
namespace {

SteadyState steady_with(SteadyStateOutcome outcome) {
  SteadyState steady;
  steady.outcome = outcome;
  steady.frequency = 0.25;
  steady.samples = 4000;
  steady.period = 400;
  steady.names = {"w", "theta"};
  steady.drift = Eigen::Vector2d(0.001, -0.5);
  steady.slowest_state = 1;
  return steady;
}

bool has(const std::string& text, const char* part) {
  const bool is = text.find(part) != std::string::npos;
  CHECK_MESSAGE(is, text);
  return is;
}

TEST_CASE("a steady state that was found needs no words") {
  CHECK(reason_of(steady_with(SteadyStateOutcome::settled)).empty());
  TubeProposal proposal;
  proposal.outcome = TubeOutcome::proposed;
  CHECK(reason_of(proposal).empty());
}

TEST_CASE("a simulation that diverges says when, and at which operation") {
  SteadyState steady = steady_with(SteadyStateOutcome::diverges);
  CHECK(reason_of(steady) ==
        "no steady state: the simulation diverges or is undefined within 4000 samples, at 0.25 rad/sample");
  steady.undefined = "the denominator x may vanish";
  CHECK(has(reason_of(steady), "0.25 rad/sample: the denominator x may vanish"));
}

TEST_CASE("a state that does not stop: it turns with the phase, or settles slowly") {
  SteadyState steady = steady_with(SteadyStateOutcome::still_drifts);
  CHECK(has(reason_of(steady), "after 4000 samples theta at phase 0 still moves by 0.5 in 400 samples"));
  // The phase turns by 100 rad in a period, the state by as much, or three times that, the other way.
  steady.drift[1] = 100.0;
  CHECK(has(reason_of(steady),
            "it turns once while the phase turns once; if it is an angle, name it in angles"));
  steady.drift[1] = -300.0;
  CHECK(has(reason_of(steady), "it turns -3 times while the phase turns once"));
  // Nine decades at 1 - 1e-4 a sample: 9 ln 10/1e-4.
  steady.drift[1] = 0.5;
  steady.rate = 0.9999;
  CHECK(has(reason_of(steady), "settling may take 2.1e+05 samples"));
  steady.names.clear();
  CHECK(has(reason_of(steady), "samples state 1 at phase 0"));
}

TEST_CASE("a lock elsewhere is named by the ratio of the frequencies") {
  SteadyState steady = steady_with(SteadyStateOutcome::locked_elsewhere);
  const auto locked_at = [&](double mean) {
    steady.mean_frequency = mean;
    return reason_of(steady);
  };
  CHECK(has(locked_at(0.75), "it has locked to harmonic number 3"));
  CHECK(has(locked_at(0.125), "the tone's frequency divided by 2"));
  CHECK(has(locked_at(-0.25), "with the sign of the frequency reversed"));
  CHECK(has(locked_at(0.4), "it has locked to something else"));
  CHECK(has(locked_at(0.4), "settles on 0.4 rad/sample when the tone has 0.25"));
  steady.outcome = SteadyStateOutcome::repeats_later;
  steady.repetition = 2;
  CHECK(has(reason_of(steady), "on a curve of period 2 in the phase, at 0.25"));
}

TEST_CASE("errors that do not decay are named by their mode, the small parts left out") {
  SteadyState steady = steady_with(SteadyStateOutcome::not_exponentially_stable);
  steady.rate = 1.0;
  steady.mode = Eigen::Vector2d(0.05, 1.0);
  const std::string text = reason_of(steady);
  CHECK(has(text, "each sample multiplies errors by 1, at 0.25 rad/sample, in the mode 1 of theta"));
  CHECK(text.find("of w") == std::string::npos);
  steady.rate = 0.99999999;
  CHECK(has(reason_of(steady), "which is 1 as far as 4000 samples can tell"));
  steady.names = {"ph", "a", "b"};
  steady.mode = Eigen::Vector3d(1.0, 0.0, 0.0);
  steady.neutral = {0, 1, 2};
  CHECK(has(reason_of(steady),
            "ph, a and b may turn together, and the tracker does not notice. Write a*cos(ph) + b*sin(ph) and "
            "b*cos(ph) - a*sin(ph) as two states in place of these three"));
}

TEST_CASE("a proposal that failed says at which step, with its numbers") {
  TubeProposal proposal;
  proposal.steady_state = steady_with(SteadyStateOutcome::settled);
  proposal.steady_state.rate = 0.875;
  proposal.outcome = TubeOutcome::no_shape;
  CHECK(has(reason_of(proposal), "no tube found around the steady state"));
  CHECK(has(reason_of(proposal), "errors by 0.875"));
  proposal.outcome = TubeOutcome::no_common_shape;
  CHECK(has(reason_of(proposal), "contracts in the whole cell"));
  proposal.outcome = TubeOutcome::no_curve;
  CHECK(has(reason_of(proposal), "not on a smooth curve"));
  proposal.outcome = TubeOutcome::cell_too_wide;
  proposal.curve_error = 2e-6;
  proposal.loss = 0.25;
  proposal.variation = 0.5;
  CHECK(has(reason_of(proposal),
            "off by 2e-06 rad/sample and costs 25 % of the tube, whose size varies by 50 %"));
  proposal.loss = 1e-13;
  CHECK(reason_of(proposal) == "the size of the tube changes too much over the cell: by 50 %");
  proposal.outcome = TubeOutcome::no_steady_state;
  proposal.steady_state.outcome = SteadyStateOutcome::diverges;
  CHECK(reason_of(proposal) == reason_of(proposal.steady_state));
}

TEST_CASE("neighbouring cells that failed alike have one reason, with where they are") {
  const auto cell = [](TubeOutcome outcome, double low, double high) {
    TubeProposal proposal;
    proposal.outcome = outcome;
    proposal.frequency = 0.5 * (low + high);
    proposal.half_width = 0.5 * (high - low);
    return proposal;
  };
  BandProposal band;
  CHECK(reasons_of(band).empty());
  band.cells = {cell(TubeOutcome::no_shape, 0.25, 0.375), cell(TubeOutcome::no_shape, 0.375, 0.5),
                cell(TubeOutcome::proposed, 0.5, 0.75), cell(TubeOutcome::time_limit, 0.75, 1.0)};
  const std::vector<std::string> reasons = reasons_of(band);
  REQUIRE(reasons.size() == 2);
  CHECK(has(reasons[0], "between 0.25 and 0.5 rad/sample"));
  CHECK(reasons[1] == std::string(kTimeLimit) + ", between 0.75 and 1 rad/sample");
}

}  // namespace
}  // namespace veritrack::model

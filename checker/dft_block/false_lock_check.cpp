#include "checker/dft_block/false_lock_check.hpp"

#include "checker/dft_block/block_step.hpp"
#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

const std::string kBelow = "false-lock-below";
const std::string kAbove = "false-lock-above";
constexpr const char* kEvidence = "false-lock";

/// A decimal of the evidence: what it stands for, as `read_number` has it, is the decimal itself.
Ball decimal(const Tree& text) {
  return from_decimal(text.text());
}

bool is_within(const Ball& x, const Ball& low, const Ball& high) {
  return certainly_at_most(low.lower(), x) && certainly_at_most(x, high.upper());
}

/// The covariance of the centre.
Matrix3 covariance_of(const BlockBall& ball) {
  const auto& c = ball.centre;
  return {{{c[3], c[4], c[5]}, {c[4], c[6], c[7]}, {c[5], c[7], c[8]}}};
}

}  // namespace

bool is_false_lock(const std::string& id) {
  return id == kBelow || id == kAbove;
}

FalseLockTone false_lock_tone(const Tree& derivation) {
  const Tree& decimals = find_evidence(derivation, kEvidence)->at("decimals");
  return {decimals.at("amplitude").text(), decimals.at("offset").text()};
}

Derivation false_lock(const Tree& derivation, const BlockProblem& problem, Objections& objections) {
  const bool above = derivation.at("id").is(kAbove);
  Derivation found;
  found.title = above ? "A set of estimates that stay too high for ever"
                      : "A set of estimates that stay too low for ever";
  const Tree* evidence = find_evidence(derivation, kEvidence);
  if (evidence == nullptr || derivation.at("evidence").elements().size() != 1) {
    objections.emplace_back("the evidence is not \"false-lock\" alone");
    return found;
  }
  const Tree& numbers = evidence->at("numbers");
  const Tree& centre = evidence->at("matrices").at("centre");
  const Tree& metric = evidence->at("matrices").at("metric");
  const Ball amplitude = decimal(evidence->at("decimals").at("amplitude"));
  const Ball offset = decimal(evidence->at("decimals").at("offset"));
  BlockBall ball;
  ball.radius = exact_number(numbers.at("radius"));
  ball.rate = exact_number(numbers.at("rate"));
  ball.turns = exact_number(numbers.at("turns"));
  bool is_shape = centre.elements().size() == 1 && centre.at(0).elements().size() == kBlockStates &&
                  metric.elements().size() == kBlockStates && arb_is_int(ball.turns.raw()) != 0;
  for (std::size_t i = 0; is_shape && i < kBlockStates; ++i) {
    is_shape = metric.at(i).elements().size() == kBlockStates;
    ball.centre[i] = exact_number(centre.at(0).at(i));
    for (std::size_t k = 0; is_shape && k < kBlockStates; ++k) {
      ball.shape.set(static_cast<slong>(i), static_cast<slong>(k), exact_number(metric.at(i).at(k)));
    }
  }
  if (!is_shape) {
    objections.emplace_back("the evidence is no ball of nine numbers");
    return found;
  }
  const bool is_assumed = is_within(amplitude, problem.amplitude_low, problem.amplitude_high) &&
                          is_within(offset, problem.offset_low, problem.offset_high) &&
                          certainly_positive(amplitude);
  if (!is_assumed) {
    objections.emplace_back("the tone is not one of those that are assumed");
    return found;
  }
  const BlockTone tone{problem.q1 * four * pi() / amplitude,   problem.q2, problem.q3,
                       square(amplitude) / (four * problem.r), offset,     problem.half_width};
  const BlockBallFound states = check_ball(ball, tone);
  const bool is_kept = states.is_kept && definite(covariance_of(ball));
  const Range error = states.all[2];
  const bool is_away =
      is_kept && (above ? certainly_less(half, error.low) : certainly_less(error.high, -half));
  found.conditions = {
      {"set", "|G(s_0) - s_0|_S + \\kappa \\rho \\le \\rho,\\ \\kappa < 1", proved_if(is_kept)},
      {"away", above ? "\\tilde\\delta > 1/2" : "\\tilde\\delta < -1/2", proved_if(is_away)}};
  if (!is_away) {
    objections.emplace_back(is_kept ? "the set is not more than half a bin off"
                                    : "the set is not certainly mapped into itself and contracted");
    return found;
  }
  const auto shifted = [](const Range& range) { return Range(one + range.low, one + range.high); };
  const Range last = shifted(states.fixed[0]);
  found.quantities = {{"contraction_rate", ball.rate, Sense::bounds_above},
                      {"offset_error", error},
                      {"fixed_offset_error", states.fixed[2]},
                      {"phase_error", states.all[1]},
                      {"root_amplitude", shifted(states.all[0])},
                      {"amplitude", max(square(last.low), square(last.high)), Sense::bounds_above}};
  return found;
}

}  // namespace veritrack::checker

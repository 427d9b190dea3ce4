#include "analysis/quadrature/gaussian/lock_certificate.hpp"

#include <cmath>
#include <utility>

#include "analysis/quadrature/gaussian/lock_rounding.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/theorems/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;

constexpr const char* kSource = "docs/gaussian.md";
constexpr const char* kNone = "No set could be certified.";
/// What the starts may add to the probability, next to the samples: exp of that level.
constexpr double kStartLevel = 8.0;
/// c_0: more lets the inequality hold near the middle of the set, and costs its logarithm in L.
constexpr double kDrift = 1.0;
/// kappa: what the set forgets of a start, so that it holds as well long after it.
constexpr double kDecay = 0.95;

/// The widest of these ranges of multiples that costs no more than the starts may.
constexpr std::array<std::array<double, 2>, 4> kMultiples{{{0.5, 2.0}, {0.7, 1.5}, {0.8, 1.25}, {0.9, 1.1}}};

Interval widest_multiples(const LockSet& set, LockStarts starts, double most) {
  if (starts.covariance.is_given) {
    return starts.covariance.multiples;
  }
  Interval widest = starts.covariance.multiples;
  for (const auto& [from, to] : kMultiples) {
    starts.covariance.multiples = Interval::from_bounds(from, to);
    if (from <= widest.lower() && widest.upper() <= to &&
        certainly_less_equal(start_level(set, starts), Interval(most))) {
      widest = starts.covariance.multiples;
      break;
    }
  }
  return widest;
}

Condition leak(const Interval& epsilon) {
  const bool none = epsilon == Interval(0.0);
  return {"leak",
          "\\epsilon = 0",
          none ? Verdict::proved : Verdict::undecided,
          epsilon,
          Interval(0.0),
          none ? "there is no leak, so the errors do not depend on the frequency."
               : "with a leak no probability is certified yet; a design with epsilon = 0 may have one."};
}

std::string db_of(const LockQuestion& question) {
  constexpr double kHair = 1e-6;  // for words: 20 dB are not to read 19.9
  const double deviation = midpoint(question.noise_deviation);
  return rigor::to_decimal(-10.0 * std::log10(2.0 * deviation * deviation) + kHair, 3,
                           rigor::Direction::down) +
         " dB";
}

Condition drift(const LockQuestion& question, const std::optional<LockProposal>& proposal,
                const LockVerification& verification) {
  Condition condition{
      "drift", "E[W(k+1) \\mid k] \\le \\kappa W(k) + c_0 \\text{ in the set}", Verdict::undecided, {}, {},
      {}};
  if (!proposal) {
    condition.reason =
        "there is no steady state to search about: the statement needs q1, q2, r and the noise to be "
        "certainly positive.";
    return condition;
  }
  condition.verdict = verification.verdict;
  condition.reason =
      verification.verdict == Verdict::proved
          ? "it is proved in " + std::to_string(verification.cells) + " cells that cover the set."
      : proposal->margin <= 0.0
          ? "at " + db_of(question) +
                " the search found no set in which it holds at all sampled points. Less noise, or a smaller "
                "gain, may help."
          : "a set was found in which it holds at all sampled points, but " + verification.reason;
  return condition;
}

Condition rounding_condition(const LockRounding& rounding) {
  return {"rounding",
          "\\varrho \\le \\eta,\\ \\mu\\,hi \\le \\eta D_h,\\ \\mu\\,lo^{-1} \\le (1 - \\mu)\\,\\eta D_l",
          rounding.has_room ? Verdict::proved : Verdict::undecided,
          Interval::empty(),
          Interval::empty(),
          rounding.has_room
              ? "what a step in double precision adds is within the room that the inequality leaves."
              : "what a step in double precision adds could not be shown to be small enough."};
}

Condition start_condition(const Interval& level, const LockSet& set) {
  const bool inside = certainly_less_equal(level, Interval(set.level));
  return {"start-in-set",
          "\\tfrac12|T e(0)|^2 + \\tfrac12\\gamma s(P(0))^2 \\le L",
          inside ? Verdict::proved : Verdict::undecided,
          level,
          Interval(set.level),
          inside ? "every assumed start lies in the set."
                 : "the assumed starts do not lie in the set: smaller start errors would.",
          theorems::Sense::at_most};
}

}  // namespace

Interval expected_weight(const LockSet& set, const Interval& start_level) {
  return rigor::exp(start_level) + Interval(set.drift) / (Interval(1.0) - Interval(set.decay));
}

bool is_well_posed(const LockQuestion& question) {
  return certainly_positive(question.design.q1) && certainly_positive(question.design.q2) &&
         certainly_positive(question.design.r) && certainly_positive(question.noise_deviation) &&
         certainly_not_negative(question.frequency_walk) &&
         certainly_less_equal(Interval(1.0), question.samples) && question.probability > 0.0 &&
         question.probability < 1.0;
}

LockRequest proposal_request(const LockQuestion& question) {
  LockRequest request;
  const auto& d = question.design;
  request.design = {midpoint(d.q1), midpoint(d.q2), midpoint(d.r), 0.0};
  request.noise_deviation = question.noise_deviation.upper();
  request.frequency_walk = question.frequency_walk.upper();
  request.decay = kDecay;
  request.drift = kDrift;
  request.level =
      std::log((question.samples.upper() * kDrift + std::exp(kStartLevel) + kDrift / (1.0 - kDecay)) /
               question.probability) +
      1e-6;
  return request;
}

Interval losing_probability(const LockSet& set, const Interval& start_level, const Interval& samples) {
  return rigor::exp(-Interval(set.level)) *
             (expected_weight(set, start_level) + samples * Interval(set.drift)) +
         probability_beyond(samples);
}

LockCertificate certify_lock(const LockQuestion& question) {
  const rigor::UpwardRounding upward;
  const bool sensible = question.design.epsilon == Interval(0.0) && is_well_posed(question);
  return certify_lock(question, sensible ? propose_lock_set(proposal_request(question)) : std::nullopt);
}

LockCertificate certify_lock(const LockQuestion& question, const std::optional<LockProposal>& proposal,
                             std::int64_t most_cells) {
  LockCertificate result;
  result.proposal = proposal;
  result.covariance_multiples = question.starts.covariance.multiples;
  theorems::Derivation& derivation = result.derivation;
  derivation.id = "lock";
  derivation.title = "Gaussian noise: the probability of losing lock";
  LockVerification verification;
  const rigor::UpwardRounding upward;
  derivation.conditions.push_back(leak(question.design.epsilon));
  const bool leaks = derivation.conditions.back().verdict != Verdict::proved;
  if (!leaks && is_well_posed(question) && proposal && proposal->margin > 0.0) {
    verification = verify_lock_set(question.design, proposal->set, most_cells);
  }
  Interval probability;
  Interval reach;
  Interval level;
  if (!leaks) {
    derivation.conditions.push_back(drift(question, proposal, verification));
  }
  if (verification.verdict == Verdict::proved) {
    const LockSet& set = proposal->set;
    const LockRounding rounding = lock_rounding(question.design, question.signal, set, question.samples);
    LockStarts starts = question.starts;
    starts.covariance.multiples = widest_multiples(set, starts, kStartLevel);
    result.covariance_multiples = starts.covariance.multiples;
    // A little more, so that another program finds it below this.
    level = Interval((start_level(set, starts) * Interval(1.01) + Interval(0.01)).upper());
    derivation.conditions.push_back(rounding_condition(rounding));
    derivation.conditions.push_back(start_condition(level, set));
    result.cells = verification.cells;
    // What the set says it tolerates is at least what is assumed.
    const bool tolerates = certainly_less_equal(question.noise_deviation, Interval(set.noise_deviation)) &&
                           certainly_less_equal(question.frequency_walk, Interval(set.frequency_walk));
    if (tolerates && rounding.has_room && certainly_less_equal(level, Interval(set.level))) {
      result.set = set;
      derivation.notes.push_back(
          "e is the error in the frame of the true phase: real and imaginary part of the estimate relative "
          "to the "
          "signal, less 1, and the frequency error. s(P) says how far the covariance is from the filter's "
          "steady "
          "state. W = exp(|T e|^2/2 + gamma s(P)^2/2), and the set is where W is at most exp(L), L = " +
          rigor::upper_decimal(Interval(set.level)) +
          ", kappa = " + rigor::upper_decimal(Interval(set.decay)) +
          ", c_0 = " + rigor::upper_decimal(Interval(set.drift)) + ".");
      probability = losing_probability(set, level, question.samples);
      reach = largest_frequency_error(set);
    }
  }
  theorems::conclude(derivation);
  theorems::add_quantity(
      derivation,
      {"probability_of_losing_lock", "p", "e^{-L}(e^{l_0} + c_0/(1 - \\kappa) + N c_0)", kSource,
       "probability of losing lock within the assumed number of samples", theorems::Sense::at_most},
      probability, kNone);
  theorems::add_quantity(derivation,
                         {"lock_frequency_error", "B", "\\sqrt{2L}\\,|e_3'T^{-1}|", kSource,
                          "frequency error while in lock, rad/sample", theorems::Sense::at_most},
                         reach, kNone);
  theorems::add_quantity(derivation,
                         {"start_level", "l_0", "\\max\\tfrac12|Te|^2 + \\tfrac12\\gamma s(P)^2", kSource,
                          "how far out in the set the assumed starts lie", theorems::Sense::at_most},
                         result.set ? level : Interval(), kNone);
  return result;
}

}  // namespace veritrack::quadrature

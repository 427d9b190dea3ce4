#include "analysis/quadrature/gaussian/lock_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quadrature/gaussian/lock_band.hpp"
#include "analysis/quadrature/gaussian/lock_rounding.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;

constexpr const char* kSource = "docs/gaussian.md";
constexpr const char* kNone = "No set could be certified.";
constexpr const char* kDriftInequality = "E[W(k+1) \\mid k] \\le \\kappa W(k) + c_0 \\text{ in the set}";
constexpr const char* kIllPosed =
    "there is no steady state to search about: the statement needs q1, q2, r and the noise to be "
    "certainly positive.";
/// The room that is added to the level of the starts.
constexpr double kLevelFactor = 1.01;
constexpr double kLevelRoom = 0.01;
/// c_0: more lets the inequality hold near the middle of the set, and costs its logarithm in L.
constexpr double kDrift = 1.0;
/// kappa: what the set forgets of a start, so that it holds as well long after it.
constexpr double kDecay = 0.95;
/// With a leak the middle of the set is not where the tracker settles at every frequency of the piece, and it
/// is there that the inequality is closest.
constexpr double kDriftWithLeak = 10.0;

/// The widest of these ranges of multiples that costs no more than the starts may.
constexpr std::array<std::array<double, 2>, 4> kMultiples{{{0.5, 2.0}, {0.7, 1.5}, {0.8, 1.25}, {0.9, 1.1}}};

/// The largest level that a start has in one of the sets.
Interval start_level(const std::vector<LockSet>& sets, const LockStarts& starts) {
  Interval worst(0.0);
  for (const LockSet& set : sets) {
    Interval level = start_level(set, starts);
    if (is_empty(level)) {
      return level;
    }
    worst = max(worst, level);
  }
  return worst;
}

Interval widest_multiples(const std::vector<LockSet>& sets, LockStarts starts, double most) {
  if (starts.covariance.is_given) {
    return starts.covariance.multiples;
  }
  Interval widest = starts.covariance.multiples;
  for (const auto& [from, to] : kMultiples) {
    starts.covariance.multiples = Interval::from_bounds(from, to);
    if (from <= widest.lower() && widest.upper() <= to &&
        certainly_less_equal(start_level(sets, starts), Interval(most))) {
      widest = starts.covariance.multiples;
      break;
    }
  }
  return widest;
}

Condition leak(const LockQuestion& question) {
  const Interval none(0.0);
  if (question.design.epsilon == none) {
    return {"leak",
            "\\epsilon = 0",
            Verdict::proved,
            none,
            none,
            "there is no leak, so the errors do not depend on the frequency."};
  }
  const bool constant = question.frequency_walk == none;
  return {"constant-frequency",
          "w = 0",
          constant ? Verdict::proved : Verdict::undecided,
          question.frequency_walk,
          none,
          constant
              ? "the frequency is constant, so that each piece of the band may have a set of its own."
              : "with a leak the errors depend on the frequency, and no probability is certified yet for "
                "one that walks."};
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
  Condition condition{"drift", kDriftInequality, Verdict::undecided, {}, {}, {}};
  if (!proposal) {
    condition.reason = kIllPosed;
    return condition;
  }
  condition.verdict = verification.verdict;
  condition.reason =
      verification.verdict == Verdict::proved
          ? "it is proved in " + std::to_string(verification.cells) + " cells that cover the set."
      : proposal->margin <= 0.0
          ? "at " + db_of(question) +
                " the search found no set in which it is satisfied at all sampled points. Less noise, or a "
                "smaller "
                "gain, may help."
          : "a set was found in which it is satisfied at all sampled points, but " + verification.reason;
  return condition;
}

Condition drift_over_band(const LockQuestion& question, const LockBand& band) {
  const bool proved = !band.sets.empty();
  return {"drift",
          kDriftInequality,
          proved ? Verdict::proved : Verdict::undecided,
          Interval::empty(),
          Interval::empty(),
          proved ? "it is proved in " + std::to_string(band.cells) + " cells that cover " +
                       (band.sets.size() == 1
                            ? "the set, for all frequencies of the band."
                            : "the sets of " + std::to_string(band.sets.size()) + " pieces of the band.")
                 : "at " + db_of(question) + ", " + band.reason};
}

Condition rounding_condition(bool has_room) {
  return {"rounding",
          "\\varrho \\le \\eta,\\ \\mu\\,hi \\le \\eta D_h,\\ \\mu\\,lo^{-1} \\le (1 - \\mu)\\,\\eta D_l",
          has_room ? Verdict::proved : Verdict::undecided,
          Interval::empty(),
          Interval::empty(),
          has_room ? "what a step in double precision adds is within the room that the inequality leaves."
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

/// Does each of the sets begin where the one before ends, or sooner, and has one of them every frequency?
bool cover(const std::vector<LockSet>& sets, const Interval& frequencies) {
  double covered = frequencies.lower();
  for (const LockSet& set : sets) {
    if (!(set.lowest_frequency <= covered)) {
      return false;
    }
    covered = set.highest_frequency;
  }
  return frequencies.upper() <= covered;
}

/// The definitions of the error and the sets.
std::string note_on(const std::vector<LockSet>& sets, bool leaks) {
  const LockSet& set = sets.front();
  return "e is the error in the frame of the true phase: real and imaginary part of the estimate relative "
         "to the signal, less 1, and the frequency error. s(P) says how far the covariance is from the "
         "filter's steady state. W = exp(|T e|^2/2 + gamma s(P)^2/2), and the set is where W is at most "
         "exp(L), L = " +
         rigor::upper_decimal(Interval(set.level)) +
         ", kappa = " + rigor::upper_decimal(Interval(set.decay)) +
         ", c_0 = " + rigor::upper_decimal(Interval(set.drift)) + "." +
         (leaks ? " With a leak e is that error less the one at which the tracker settles in the middle of a "
                  "piece of the band of frequencies; each of the " +
                      std::to_string(sets.size()) + " pieces has a set of its own."
                : "");
}

/// The numbers that the sets come to.
struct LockNumbers {
  Interval probability, reach, level;
};

void add_quantities(theorems::Derivation& derivation, const LockNumbers& numbers, bool leaks,
                    bool has_starts) {
  theorems::add_quantity(
      derivation,
      {"probability_of_losing_lock", "p", "e^{-L}(e^{l_0} + c_0/(1 - \\kappa) + N c_0)", kSource,
       "probability of losing lock within the assumed number of successive samples",
       theorems::Sense::at_most},
      numbers.probability, kNone);
  theorems::add_quantity(derivation,
                         {"lock_frequency_error", "B",
                          leaks ? "\\max(|e_{03}| + \\sqrt{2L}\\,|e_3'T^{-1}|)" : "\\sqrt{2L}\\,|e_3'T^{-1}|",
                          kSource, "frequency error while in lock, rad/sample", theorems::Sense::at_most},
                         numbers.reach, kNone);
  theorems::add_quantity(derivation,
                         {"start_level", "l_0", "\\max\\tfrac12|Te|^2 + \\tfrac12\\gamma s(P)^2", kSource,
                          "how far out in the set the assumed starts lie", theorems::Sense::at_most},
                         has_starts ? numbers.level : Interval(), kNone);
}

LockCertificate certify(const LockQuestion& question, const LockRequest& request,
                        const std::optional<LockProposal>& proposal, std::int64_t most_cells) {
  LockCertificate result;
  result.proposal = proposal;
  result.covariance_multiples = question.starts.covariance.multiples;
  theorems::Derivation& derivation = result.derivation;
  derivation.id = "lock";
  derivation.title = "Gaussian noise: the probability of losing lock";
  const rigor::UpwardRounding upward;
  derivation.conditions.push_back(leak(question));
  const bool leaks = !(question.design.epsilon == Interval(0.0));
  const bool sensible = derivation.conditions.back().verdict == Verdict::proved;
  std::vector<LockSet> sets;
  if (sensible && !leaks) {
    LockVerification verification;
    if (is_well_posed(question) && proposal && proposal->margin > 0.0) {
      verification = verify_lock_set(question.design, proposal->set, most_cells);
    }
    derivation.conditions.push_back(drift(question, proposal, verification));
    if (verification.verdict == Verdict::proved) {
      sets = {proposal->set};
      result.cells = verification.cells;
    }
  } else if (sensible) {
    const LockBand band = is_well_posed(question)
                              ? prove_lock_band(question.design, request, question.frequencies)
                              : LockBand{{}, 0, kIllPosed};
    derivation.conditions.push_back(drift_over_band(question, band));
    sets = band.sets;
    result.cells = band.cells;
  }
  LockNumbers numbers;
  if (!sets.empty()) {
    LockStarts starts = question.starts;
    starts.covariance.multiples = widest_multiples(
        sets, starts, (kUsualStartLevel + std::log(sets.front().drift) - kLevelRoom) / kLevelFactor);
    result.covariance_multiples = starts.covariance.multiples;
    // A little more, so that another program finds it below this.
    numbers.level =
        Interval((start_level(sets, starts) * Interval(kLevelFactor) + Interval(kLevelRoom)).upper());
    bool has_room = true;
    bool tolerates = !leaks || cover(sets, question.frequencies);
    for (const LockSet& set : sets) {
      has_room = has_room && lock_rounding(question.design, question.signal, set, question.samples).has_room;
      // The set says that it tolerates at least what is assumed.
      tolerates = tolerates &&
                  certainly_less_equal(question.noise_deviation, Interval(set.noise_deviation)) &&
                  certainly_less_equal(question.frequency_walk, Interval(set.frequency_walk));
    }
    const LockSet& set = sets.front();
    derivation.conditions.push_back(rounding_condition(has_room));
    derivation.conditions.push_back(start_condition(numbers.level, set));
    if (tolerates && has_room && certainly_less_equal(numbers.level, Interval(set.level))) {
      result.sets = sets;
      derivation.notes.push_back(note_on(sets, leaks));
      numbers.probability = numbers.reach = Interval(0.0);
      for (const LockSet& each : sets) {
        numbers.probability =
            max(numbers.probability, losing_probability(each, numbers.level, question.samples));
        numbers.reach = max(numbers.reach, largest_frequency_error(each));
      }
    }
  }
  theorems::conclude(derivation);
  add_quantities(derivation, numbers, leaks, !result.sets.empty());
  return result;
}

/// The request for a proposal; an empty one where the question has no answer.
LockRequest usual_request(const LockQuestion& question) {
  return is_well_posed(question) ? proposal_request(question) : LockRequest{};
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

LockRequest proposal_request(const LockQuestion& question, double start_level) {
  LockRequest request;
  const auto& d = question.design;
  request.design = {midpoint(d.q1), midpoint(d.q2), midpoint(d.r), midpoint(d.epsilon)};
  request.noise_deviation = question.noise_deviation.upper();
  request.frequency_walk = question.frequency_walk.upper();
  request.decay = kDecay;
  request.drift = question.design.epsilon == Interval(0.0) ? kDrift : kDriftWithLeak;
  request.level = std::log((question.samples.upper() + std::exp(start_level) + 1.0 / (1.0 - kDecay)) *
                           request.drift / question.probability) +
                  1e-6;
  request.lowest_frequency = question.frequencies.lower();
  request.highest_frequency = question.frequencies.upper();
  return request;
}

Interval losing_probability(const LockSet& set, const Interval& start_level, const Interval& samples) {
  return rigor::exp(-Interval(set.level)) *
             (expected_weight(set, start_level) + samples * Interval(set.drift)) +
         probability_beyond(samples);
}

LockCertificate certify_lock(const LockQuestion& question) {
  const rigor::UpwardRounding upward;
  return certify_lock(question, usual_request(question));
}

LockCertificate certify_lock(const LockQuestion& question, const LockRequest& request) {
  const rigor::UpwardRounding upward;
  const bool sensible = question.design.epsilon == Interval(0.0) && is_well_posed(question);
  return certify(question, request, sensible ? propose_lock_set(request) : std::nullopt, kMostLockCells);
}

LockCertificate certify_lock(const LockQuestion& question, const std::optional<LockProposal>& proposal,
                             std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  return certify(question, usual_request(question), proposal, most_cells);
}

}  // namespace veritrack::quadrature

#include "analysis/model/question/proof_choice.hpp"

#include <algorithm>
#include <utility>

#include "analysis/model/question/gain_sets.hpp"
#include "analysis/model/question/phase_sets.hpp"
#include "analysis/model/steady_state/neutral_turn.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

/// Where a phase is described twice: what to write instead.
std::string advice_on_turns(const SetQuestion& question) {
  const rigor::NearestRounding nearest;
  const std::vector<double> start = question.tone.start(question.whole_band.upper());
  const Eigen::VectorXd near =
      Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  const auto turn = find_neutral_turn(question.tone.step, near, near.cwiseAbs());
  return turn ? words_of(*turn, question.tone.names) : std::string();
}

/// Where gains are not enough: why there are no tubes, either.
std::optional<ProofObjection> objection_to_tubes(const SetQuestion& question) {
  constexpr int kMostStatesInTubes = 16;
  const int states = question.tracker.recursion->states;
  const bool is_too_large = question.tone.filter == nullptr && states > kMostStatesInTubes;
  if (!is_too_large && !question.band.is_empty()) {
    return std::nullopt;
  }
  using Kind = ProofObjection::Kind;
  if (question.whole_band.lower() < 0.0) {
    return ProofObjection{Kind::negative_frequencies, 0, 0, advice_on_turns(question)};
  }
  return is_too_large ? ProofObjection{Kind::too_many_states, states, kMostStatesInTubes}
                      : ProofObjection{Kind::no_band};
}

double tolerated_noise(const std::optional<ProvedSet>& set) {
  return set && set->is_proved() ? set->tubes.noise : 0.0;
}
double proved_reach(const ProvedSet& set) {
  return set.is_proved() ? set.reach : 0.0;
}

/// Tubes may prove more of a loop that keeps vectors whose length matters, where noise is large.
bool is_best_of_two_channels(const ProvedSets& by_gains) {
  const std::vector<SteadyValue>& steady = by_gains.gains->steady;
  const bool has_lengths = std::any_of(steady.begin(), steady.end(), [&](const SteadyValue& each) {
    return each.imaginary && has_length(each, steady);
  });
  return !has_lengths || by_gains.deciding().is_proved();
}

/// Adds what gains on the average prove of noise and starts, where that is more than tubes have.
void add_averages(ProvedSets by_gains, ProvedSets& sets) {
  if (!(tolerated_noise(by_gains.noise) > tolerated_noise(sets.noise)) &&
      !(proved_reach(by_gains.starts) > proved_reach(sets.starts))) {
    return;
  }
  by_gains.starts.proof = ProvedSet::Proof::averages;
  if (by_gains.noise) {
    by_gains.noise->proof = ProvedSet::Proof::averages;
  }
  sets.averages = {*std::move(by_gains.gains), std::move(by_gains.starts), std::move(by_gains.noise)};
}

/// Adds the proof by gains that depend on the phase, if something is better with it.
void add_phases(const SetQuestion& question, ChosenProof& chosen) {
  ProvedSets& sets = chosen.sets;
  KnownLimits known{tolerated_noise(sets.noise), proved_reach(sets.starts)};
  if (sets.averages) {
    known = {std::max(known.noise, tolerated_noise(sets.averages->noise)),
             std::max(known.reach, proved_reach(sets.averages->starts))};
  }
  NoGains reason;
  sets.phases = prove_by_phase_gains(question, known, &reason);
  if (!sets.phases && question.allows_phase_gains) {
    chosen.no_phase_gains = std::move(reason);
  }
  if (sets.phases && !sets.best().is_without_tubes() &&
      !(tolerated_noise(sets.phases->noise) > known.noise)) {
    sets.phases.reset();
  }
}

/// Tubes are for exact arithmetic.
bool decides_for_program(const PhaseProof& phases) {
  return !phases.room.empty() && phases.starts.is_proved() && phases.assumed.is_proved();
}

ProvedSets without_tubes(const SetQuestion& question, PhaseProof phases) {
  const char* reason = "tubes were not searched for: they are for exact arithmetic";
  ProvedSets sets;
  sets.starts.tubes.name = kStarts;
  sets.starts.tubes.reasons.emplace_back(reason);
  if (question.is_disturbed()) {
    sets.assumed.emplace();
    sets.assumed->tubes.name = kAssumed;
    sets.assumed->tubes.reasons.emplace_back(reason);
  }
  sets.phases = std::move(phases);
  return sets;
}

}  // namespace

bool covariance_is_bounded(const trackers::FilterParts& filter, bool names_covariance) {
  // With an F other than the derivative no tube was found for Zarchan's third filter in this way, but one was
  // found in the other way; with more states than these the other way is out of reach.
  constexpr int kMostWithCovariance = 3;
  const bool prefers_states = filter.has_given_jacobian && filter.states <= kMostWithCovariance;
  return !names_covariance && !prefers_states;
}

FirstProof prove_by_gains_first(const SetQuestion& question) {
  FirstProof first;
  const trackers::Recursion& recursion = *question.tracker.recursion;
  if (recursion.states > rigor::kMostSmallRows && question.tone.filter == nullptr) {
    first.objection =
        ProofObjection{ProofObjection::Kind::too_many_states, recursion.states, rigor::kMostSmallRows};
    return first;
  }
  NoGains reason;
  first.by_gains = prove_by_gains(question, &reason);
  if (!first.by_gains) {
    first.no_gains = std::move(reason);
  }
  first.is_enough =
      first.by_gains && (recursion.samples > 1 ? is_best_of_two_channels(*first.by_gains)
                                               : !question.rounding && is_near_linear(*first.by_gains));
  if (!first.is_enough) {
    first.objection = objection_to_tubes(question);
  }
  return first;
}

ChosenProof choose_proof(const SetQuestion& question, std::optional<ProvedSets> by_gains,
                         const SetProgress& progress) {
  ChosenProof chosen;
  std::string no_rounding;
  if (question.rounding) {
    NoGains reason;
    auto phases = prove_by_phase_gains(question, {}, &reason);
    if (phases && decides_for_program(*phases)) {
      chosen.sets = without_tubes(question, *std::move(phases));
      return chosen;
    }
    no_rounding = phases ? phases->no_rounding : reason.detail;
  }
  chosen.sets = prove_sets(question, progress);
  chosen.sets.no_rounding = std::move(no_rounding);
  const bool is_one_channel = question.tracker.recursion->samples == 1;
  // With two channels gains prove something even where they do not decide.
  if (by_gains && !chosen.sets.deciding().is_proved() &&
      (by_gains->deciding().is_proved() || !is_one_channel)) {
    chosen.sets = *std::move(by_gains);
    chosen.is_by_gains = true;
    return chosen;
  }
  if (is_one_channel && by_gains && by_gains->gains && by_gains->gains->gains) {
    add_averages(*std::move(by_gains), chosen.sets);
  }
  add_phases(question, chosen);
  return chosen;
}

}  // namespace veritrack::model

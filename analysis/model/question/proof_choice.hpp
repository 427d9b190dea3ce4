// Which proof answers a question: gains, tubes, or both beside each other.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/question/no_gains.hpp"
#include "analysis/model/question/proved_sets.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::model {

/// Whether tubes are those of the filter's estimate alone, its covariance between two matrices.
/// `names_covariance`: something is assumed of the start of the covariance.
[[nodiscard]] bool covariance_is_bounded(const trackers::FilterParts& filter, bool names_covariance);

/// The reason why nothing is searched for.
struct ProofObjection {
  enum class Kind {
    too_many_states,
    no_band,              ///< the band has no width, or is not in [0, pi]
    negative_frequencies  ///< which only gains reach, and they do not answer
  };
  Kind kind = Kind::no_band;
  int states = 0, most_states = 0;  ///< where these are too many
  std::string advice = {};          ///< on how to write the recursion; or empty
};

/// What gains prove, which are tried first.
struct FirstProof {
  std::optional<ProofObjection> objection;
  std::optional<ProvedSets> by_gains;
  std::optional<NoGains> no_gains;  ///< why they prove nothing, where they were tried
  bool is_enough = false;           ///< no tubes are searched for
};

/// Needs the upward rounding mode.
[[nodiscard]] FirstProof prove_by_gains_first(const SetQuestion& question);

/// The sets, by the proof that decides, and what other proofs have beside them.
struct ChosenProof {
  ProvedSets sets;
  bool is_by_gains = false;               ///< gains prove what tubes do not
  std::optional<NoGains> no_phase_gains;  ///< why gains over the phase prove nothing, where they were tried
};

/// Searches for tubes, and takes from gains what is better. `progress` is that of prove_sets. Needs the
/// upward rounding mode.
[[nodiscard]] ChosenProof choose_proof(const SetQuestion& question, std::optional<ProvedSets> by_gains,
                                       const SetProgress& progress = {});

}  // namespace veritrack::model

// The answer to a question: the sets that are proved for a tracker.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/linear/stability.hpp"
#include "analysis/model/gain/gain_bounds.hpp"
#include "analysis/model/gain/phase_gains.hpp"
#include "analysis/model/question/set_question.hpp"
#include "analysis/model/set/proved_set.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"

namespace veritrack::model {

/// A proof without tubes (docs/gain-proof.md): the sets are the states that can be reached from the steady
/// state, or from the assumed starts.
struct GainProof {
  std::vector<SteadyValue> steady;             ///< by state
  std::optional<linear::RadiusBounds> radius;  ///< of the linear recursion, where that is constant
  std::optional<GainBounds> gains;             ///< none of an unstable loop
  LoopDisturbance disturbance = {};            ///< that is assumed
  std::optional<LoopBounds> assumed = {};      ///< for it
  std::optional<LoopRounding> rounding = {};   ///< of the program that runs; none: exact arithmetic
};

/// The same for a loop whose errors depend on the phase, beside tubes or without them.
struct PhaseProof {
  std::vector<FloquetCell> cells;  ///< from the lowest frequencies on
  PhaseGridding gridding;          ///< of each cell
  PhaseErrors errors;         ///< for what is assumed; without noise and slew where `assumed` is not proved
  ProvedSet starts, assumed;  ///< as those of ProvedSets
  std::optional<ProvedSet> noise;
  std::vector<double> room;  ///< of the states of a program that rounds; empty: exact arithmetic
  std::string no_rounding;   ///< why, where a program rounds
};

/// Beside tubes: of a loop of one channel whose ripple is averaged. Its bounds in the long run are mostly
/// worse, and more noise and larger errors at the start may be proved.
struct AveragesProof {
  GainProof proof;
  ProvedSet starts;  ///< as those of ProvedSets
  std::optional<ProvedSet> noise;
};

/// The first sample from which on the error is certainly below `target`, rad/sample, for what is assumed;
/// infinity where that is not known. Holds upward rounding.
[[nodiscard]] double samples_below(const GainProof& proof, const rigor::Interval& target);
[[nodiscard]] double samples_below(const PhaseProof& proof, const rigor::Interval& target);

/// The requested sets, and the reasons for those that were not proved.
struct ProvedSets {
  ProvedSet starts;                    ///< without noise
  std::optional<ProvedSet> assumed;    ///< for the assumed noise and slew; none when both are 0
  std::optional<ProvedSet> long_run;   ///< of a filter: inside the lowest levels of `assumed`
  std::optional<ProvedSet> slew;       ///< for the largest slew, without noise
  std::optional<ProvedSet> noise;      ///< for the largest noise
  std::vector<FrequencySlice> slices;  ///< of `starts`
  /// The frequency error in the long run of `assumed` to first order, not proved; none where it is unknown.
  std::optional<LinearWorstCase> linear;

  /// By gains: for the assumed noise and slew, and starts of which the frequency is off as far as possible.
  std::optional<ProvedSet> reach = {};
  std::optional<GainProof> gains = {};         ///< the proof, where it is by gains
  std::optional<PhaseProof> phases = {};       ///< by gains that depend on the phase; beside the other sets
  std::optional<AveragesProof> averages = {};  ///< beside the other sets, too
  /// Why the rounding of the program is not in the bounds; empty where it is, or there is no program.
  std::string no_rounding = {};
  /// The set for what is assumed.
  [[nodiscard]] const ProvedSet& deciding() const { return assumed ? *assumed : starts; }
  /// The one with the better bounds for what is assumed, by whatever proof.
  [[nodiscard]] const ProvedSet& best() const;
};

/// Searches and verifies. The search stops at the deadline; results proved by then are kept. `progress`
/// receives the share of the tasks that is done. Deterministic up to the deadline. Holds upward rounding.
[[nodiscard]] ProvedSets prove_sets(const SetQuestion& question, const SetProgress& progress = {});

/// The proved bound of the frequency error in the long run of `assumed`, rad/sample; infinity where nothing
/// is known.
[[nodiscard]] double settled_error_of(const ProvedSets& sets);
/// The same by the better proof.
[[nodiscard]] double best_settled_error_of(const ProvedSets& sets);

}  // namespace veritrack::model

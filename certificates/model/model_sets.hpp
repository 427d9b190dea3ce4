// What is certified of a model: sets of tubes, and what follows from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/model/set/tube_set.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_capture.hpp"
#include "certificates/model/model_lock.hpp"

namespace veritrack::certificates {

/// A set of tubes over the band, or a part of it, and what follows there. Bounds have a thousandth of room,
/// so that an independent program need not be as sharp. Infinite, or empty, where nothing is known.
struct ModelSet {
  model::TubeSet tubes;
  double frequency_error = 0.0;  ///< of level R_0, at most, rad/sample
  double half_distance = 0.0;    ///< to the next false lock (analysis/model/tube/false_lock.hpp), rad/sample
  double settled_error = 0.0;    ///< of level R_m, at most, rad/sample
  double reach = 0.0;            ///< at least, rad/sample
  double start_share = 0.0;      ///< the level of the assumed starts over R_0, at most
  rigor::Interval bias;          ///< contains the mean over the phase, without noise, at level R_m
  double ripple = 0.0;           ///< at most, likewise

  /// For the whole band.
  [[nodiscard]] bool is_proved() const { return tubes.is_complete; }
  /// Whether sentences about lock may be said of it.
  [[nodiscard]] bool is_lock() const { return names_lock(frequency_error, half_distance); }
  /// For a part of it only: `tubes.part`.
  [[nodiscard]] bool has_part() const { return !tubes.is_complete && !tubes.tubes.empty(); }
};

/// Of a cell of frequencies, for figures and tables.
struct ModelCell {
  double low = 0.0, high = 0.0;  ///< rad/sample
  rigor::Interval bias;
  double ripple = 0.0;
  double reach = 0.0;
};

struct ModelSets {
  ModelSet starts;                      ///< without noise
  std::optional<ModelSet> assumed;      ///< for the assumed noise and slew; none when both are 0
  std::optional<ModelSet> long_run;     ///< of a filter: inside the lowest levels of `assumed`
  std::optional<ModelSet> slew;         ///< for the largest slew, without noise
  std::optional<ModelSet> noise;        ///< for the largest noise
  std::optional<ModelCapture> capture;  ///< of start_exactly, into `assumed`, or `starts` without noise
  std::optional<ModelLock> gaussian;    ///< for the assumed Gaussian noise
  std::optional<ModelLock> lowest_snr;  ///< for as much Gaussian noise as can be proved
  std::vector<ModelCell> cells;         ///< of `starts`
  /// The frequency error in the long run of `assumed` to first order, not proved; none where it is unknown.
  std::optional<model::LinearWorstCase> linear;
  bool bounds_covariance = false;  ///< the tubes do, of a filter
  std::string objection;           ///< why nothing is certified of the assumptions; or empty
};

/// The tracker of a model on its signal: for proofs, and for proposals. The members refer to the model.
[[nodiscard]] model::TrackerModel proved_model(const Model& model, const ModelAssumptions& assume);
[[nodiscard]] model::TrackedTone proposed_tone(const Model& model, const ModelAssumptions& assume);
/// On this amplitude, from which those of samples may deviate by so much; signal units.
[[nodiscard]] model::TrackedTone proposed_tone(const Model& model, double amplitude, double deviation);

/// Whether the covariance of a filter is bounded by matrices, so that tubes are those of its estimate alone:
/// where no start names an entry of the covariance, and with a given Jacobian only for more than three
/// states.
[[nodiscard]] bool bounds_covariance(const Model& model, const ModelTables& tables);

/// The band, rad/sample. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval band_of(const ModelAssumptions& assume);

/// The part of the band, rad/sample, in which sets are searched for, and why not in the rest: one sentence
/// without a full stop for each end that is out of reach.
struct SearchedBand {
  double low = 0.0;
  double high = 0.0;
  std::vector<std::string> out_of_reach;
};
[[nodiscard]] SearchedBand searched_band(const rigor::Interval& band, std::size_t channels);

/// The assumed slew, rad/sample per sample. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval slew_of(const ModelAssumptions& assume);

/// The proved bound of the frequency error in the long run of `assumed`, rad/sample; infinity where nothing
/// is known.
[[nodiscard]] double settled_error_of(const ModelSets& sets);

/// Of the certificate of a design of this kind. Throws std::bad_any_cast for another.
[[nodiscard]] const ModelSets& model_sets(const Certificate& certificate);

/// Searches and verifies. `extent`: without what only is reported beside the requirements. After the deadline
/// no more is searched for; what is proved by then is kept. `by_structure`: the covariance of a filter is
/// bounded by matrices where it can be.
[[nodiscard]] ModelSets certify_sets(const ModelTables& tables, Extent extent,
                                     const search::Deadline& deadline, const CertifyProgress& progress,
                                     bool by_structure = true);

}  // namespace veritrack::certificates

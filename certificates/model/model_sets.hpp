// The certificate of a model: the question that its design file asks, and the answer.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/question/proved_sets.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_capture.hpp"
#include "certificates/model/model_lock.hpp"
#include "certificates/model/model_words.hpp"

namespace veritrack::certificates {

/// The proved sets, and the other certified statements on the tracker.
struct ModelSets : model::ProvedSets {
  std::optional<ModelCapture> capture;  ///< of start_exactly, into the set for the assumptions
  std::optional<ModelLock> gaussian;    ///< for the assumed Gaussian noise
  std::optional<ModelLock> lowest_snr;  ///< for the most Gaussian noise that can be proved
  bool bounds_covariance = false;       ///< the tubes bound a filter's covariance
  std::string objection;                ///< why nothing is certified for the assumptions; or empty
  /// Why gains do not cover the loop, by constant coefficients and over the phase; empty where they do or
  /// cannot be asked.
  std::string no_gains, no_phase_gains;

  /// The starts in a statement by this set.
  [[nodiscard]] StartsIn starts_in(const model::ProvedSet& set) const {
    return gains || set.is_without_tubes() ? StartsIn::steady_state
           : bounds_covariance             ? StartsIn::set_with_covariance
                                           : StartsIn::set;
  }
};

/// The tracker of a model on its signal: for proofs, and for proposals. The members refer to the model.
[[nodiscard]] model::TrackerModel proved_model(const Model& model, const ModelAssumptions& assume);
[[nodiscard]] model::TrackedTone proposed_tone(const Model& model, const ModelAssumptions& assume);
/// On this amplitude, from which those of samples may deviate by at most `deviation`; signal units.
[[nodiscard]] model::TrackedTone proposed_tone(const Model& model, double amplitude, double deviation);

/// Whether the covariance of a filter is bounded by matrices, so that tubes are those of its estimate alone:
/// where no start names an entry of the covariance, and with a given Jacobian only for more than three
/// states.
[[nodiscard]] bool bounds_covariance(const Model& model, const ModelTables& tables);

/// The band, rad/sample. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval band_of(const ModelAssumptions& assume);

/// The assumed slew, rad/sample per sample. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval slew_of(const ModelAssumptions& assume);

/// At most the length of a sample of two channels with the most noise that is claimed of a program that
/// rounds. Needs the upward rounding mode.
[[nodiscard]] double least_sample_of(const ModelAssumptions& assume);

/// The sets of the certificate of a design of this kind. Throws std::bad_any_cast for another.
[[nodiscard]] const ModelSets& model_sets(const Certificate& certificate);

/// Searches and verifies. `extent`: may leave out what is only reported beside the requirements. The search
/// stops at the deadline; results proved by then are kept. `by_structure`: the covariance of a filter is
/// bounded by matrices where possible.
[[nodiscard]] ModelSets certify_sets(const ModelTables& tables, Extent extent,
                                     const search::Deadline& deadline, const CertifyProgress& progress,
                                     bool by_structure = true);

}  // namespace veritrack::certificates

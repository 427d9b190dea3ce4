// What is certified of a model: the question that its design file asks, and the answer.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/question/proved_sets.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_capture.hpp"
#include "certificates/model/model_lock.hpp"

namespace veritrack::certificates {

/// The sets that are proved, and what else is certified of the tracker.
struct ModelSets : model::ProvedSets {
  std::optional<ModelCapture> capture;  ///< of start_exactly, into the set for what is assumed
  std::optional<ModelLock> gaussian;    ///< for the assumed Gaussian noise
  std::optional<ModelLock> lowest_snr;  ///< for as much Gaussian noise as can be proved
  bool bounds_covariance = false;       ///< the tubes do, of a filter
  std::string objection;                ///< why nothing is certified of the assumptions; or empty
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

/// The assumed slew, rad/sample per sample. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval slew_of(const ModelAssumptions& assume);

/// Of the certificate of a design of this kind. Throws std::bad_any_cast for another.
[[nodiscard]] const ModelSets& model_sets(const Certificate& certificate);

/// Searches and verifies. `extent`: without what only is reported beside the requirements. After the deadline
/// no more is searched for; what is proved by then is kept. `by_structure`: the covariance of a filter is
/// bounded by matrices where it can be.
[[nodiscard]] ModelSets certify_sets(const ModelTables& tables, Extent extent,
                                     const search::Deadline& deadline, const CertifyProgress& progress,
                                     bool by_structure = true);

}  // namespace veritrack::certificates

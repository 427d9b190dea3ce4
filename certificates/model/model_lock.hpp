// The certified statements on a model in Gaussian noise: the probability that it loses lock.
#pragma once

#include <string>

#include "analysis/model/gaussian/gaussian_set.hpp"
#include "analysis/model/set/proved_set.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// A set of tubes for Gaussian noise over the whole band, and its consequences. Bounds are a thousandth
/// wider. Infinite where nothing is known.
struct ModelLock {
  model::TubeSet tubes;
  double frequency_error = 0.0;  ///< in the set, at most, rad/sample
  double half_distance = 0.0;    ///< to the next false lock (analysis/model/tube/false_lock.hpp), rad/sample
  double start_share = 0.0;      ///< the level of the starts over R, at most
  double probability = 1.0;      ///< of leaving the set within the assumed samples, at most
  std::string snr_db;            ///< of the noise, at least, dB: a decimal

  [[nodiscard]] bool is_proved() const { return tubes.is_complete; }
};

/// Whether sentences about lock may use a set with this bound of the frequency error, as they write it: it is
/// nearer to the true lock than to any false one.
[[nodiscard]] bool names_lock(double frequency_error, double half_distance);
[[nodiscard]] inline bool names_lock(const model::ProvedSet& set) {
  return names_lock(set.frequency_error, set.half_distance);
}
/// The reason why not.
[[nodiscard]] std::string lock_objection(double frequency_error, double half_distance);

/// Where nothing is assumed about starts: the level of those that statements are about, over R.
inline constexpr double kStartShare = 0.5;

/// The input of a search for a set. The members refer to objects of the caller.
struct LockSearch {
  const ModelTables* tables = nullptr;
  const Model* model = nullptr;
  const model::TrackedTone* tone = nullptr;
  const model::TrackerModel* tracker = nullptr;
  double low = 0.0, high = 0.0;  ///< of the frequency, rad/sample
  search::Deadline deadline;
};

/// For the assumed noise, or with `lowest_snr` for the most noise that can be proved. Needs the upward
/// rounding mode.
[[nodiscard]] ModelLock certify_model_lock(const LockSearch& search, bool lowest_snr,
                                           const model::SetProgress& progress);

/// The reported and the required claims of a model's certificate in Gaussian noise.
void add_lock_claims(Certificate& certificate);
[[nodiscard]] Claim required_lock_claim(const Certificate& certificate);

}  // namespace veritrack::certificates

// The data that only a certificate of the quadrature tracker has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_region.hpp"
#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/falsifier/lock_loss.hpp"
#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"
#include "analysis/theorems/audit.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/quadrature/start_covariance.hpp"

namespace veritrack::certificates {

/// The audit of one reading of the theorem along the simulated trajectory.
struct AuditedDerivation {
  std::string derivation;  ///< the id of the derivation whose constants were audited
  theorems::Audit audit;
};

/// A certified invariant set, with its purpose: evidence that can be checked again without
/// the search that found it.
struct NamedSet {
  std::string purpose;  ///< as in certificate.schema.json, e.g. "start-error"
  quadrature::CertifiedSet set;
};

/// The assumed starts, followed because they exceed the certified set.
struct FollowedStarts {
  quadrature::Region region;             ///< with the assumed noise and slew
  quadrature::SimulatedBasin basin;      ///< without, by simulation: proves nothing
  std::vector<double> frequency_errors;  ///< see quadrature::StartCapture; empty unless PROVED
};

/// The numbers of one result for the design, side by side with the others.
struct ComparedResult {
  std::string result;                     ///< the derivation's id, or "simulation"
  std::optional<rigor::Verdict> verdict;  ///< of its conditions; none for a simulation
  std::optional<rigor::Interval>
      frequency_error;                   ///< of the start, certified up to the lower end, rad/sample
  std::optional<rigor::Interval> noise;  ///< up to the lower end, relative to the amplitude
  std::optional<rigor::Interval> rate;   ///< factor per sample, at most the upper end
  bool simulated = false;                ///< proves nothing
};

struct QuadratureParticulars {
  StartCovarianceText start_covariance;
  std::vector<NamedSet> certified_sets;
  std::vector<quadrature::LockSet> lock_sets;                 ///< for Gaussian noise
  std::vector<quadrature::LockMeanSquare> lock_mean_squares;  ///< one for each of these sets, or none
  std::optional<quadrature::LockSet> lowest_snr_set;          ///< for the most of it that could be proved
  std::optional<quadrature::LockLoss> lock_loss;              ///< simulated
  std::optional<double> union_bound_snr;                      ///< dB; not in the evidence, so not proved
  std::optional<FollowedStarts> followed_starts;  ///< none when the certified set contains the assumed starts
  std::vector<AuditedDerivation> audits;
  std::vector<ComparedResult> comparison;
};

/// The data of a certificate of this tracker. Throws std::bad_any_cast for another.
[[nodiscard]] inline const QuadratureParticulars& quadrature_particulars(const Certificate& certificate) {
  return std::any_cast<const QuadratureParticulars&>(certificate.particulars);
}
[[nodiscard]] inline QuadratureParticulars& quadrature_particulars(Certificate& certificate) {
  return std::any_cast<QuadratureParticulars&>(certificate.particulars);
}

}  // namespace veritrack::certificates

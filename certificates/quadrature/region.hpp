// The proved region of attraction of a design: the starts from which the tracker is certain to recover.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_region.hpp"
#include "analysis/search/deadline.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The rectangle of starts that is examined, around the exact start.
struct RegionRequest {
  double frequency_error = 1.0;  ///< up to, rad/sample
  double phase_error = 1.5;      ///< up to, rad
  bool with_noise = false;       ///< with the noise and slew of [assume]; without, the signal is free of both
  search::Deadline deadline = {};  ///< cells that are open when it is over stay undecided
};

/// The region, and the simulated basin beside it.
struct RegionOfAttraction {
  quadrature::Region region;
  quadrature::SimulatedBasin basin;  ///< without noise, by simulation: proves nothing
  quadrature::BasinShares shares;    ///< of the simulated basin
};

/// The findings, or the reason why there are none.
struct RegionResult {
  std::optional<RegionOfAttraction> found;
  std::string reason;  ///< one sentence when nothing was found
};

/// Certifies an invariant set and follows every start of the rectangle until it lies in
/// that set (PROVED), locks elsewhere (REFUTED), or cannot be followed (UNDECIDED). The start is exact in
/// amplitude up to initial_amplitude_error of [assume]; its covariance is the initial_covariance of [assume].
/// Needs epsilon = 0. Runs in parallel; the result does not depend on the number of threads. Opens its own
/// rounding scope.
[[nodiscard]] RegionResult prove_region_of_attraction(const Design& design, const RegionRequest& request,
                                                      const CertifyProgress& progress = {});

/// The statement on the starts in the cells that are PROVED, as one sentence with all its hypotheses; without
/// the verdict.
[[nodiscard]] std::string region_statement(const Design& design, const RegionRequest& request);

/// Calls `progress`, when there is one, and asks to stop when the deadline is over. Refers to both: must not
/// outlive them.
[[nodiscard]] std::function<bool(const quadrature::RegionProgress&)> region_progress(
    const CertifyProgress& progress, const search::Deadline& deadline);

}  // namespace veritrack::certificates

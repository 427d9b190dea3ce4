// How much larger a certified set might be: where a search finds a step that leaves it. Proves nothing.
#pragma once

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/falsifier/falsifier_run.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The least radius at which gradient ascent finds a start in {|T e| = radius} x {P_lo <= P <= P_hi}, with
/// noise and slew up to those of the set, from which one step of the tracker leaves the ellipsoid; the
/// metric and the covariance bounds are the set's own. The radius at which the ellipsoid reaches amplitude
/// zero when no such start is found before. Deterministic; takes some hundredths of a second. Opens its own
/// NearestRounding scope. epsilon must be zero.
[[nodiscard]] double sampled_radius_limit(const CertifiedSet& set, const trackers::ToneModel<double>& design);

/// The same for a claim, about its centre.
[[nodiscard]] double sampled_radius_limit(const SetClaim& claim);

}  // namespace veritrack::quadrature

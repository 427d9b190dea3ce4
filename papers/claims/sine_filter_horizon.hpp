// A run of Zarchan's two-state filter for every noise of a bounded size, by verified simulation.
#pragma once

#include <string>

#include "analysis/rigor/interval.hpp"

namespace veritrack::theorems {

/// Decimals.
struct HorizonQuestion {
  std::string frequency;        ///< omega of the signal sin(omega t), rad/s
  std::string first_frequency;  ///< the filter's first estimate, rad/s; its first phase is 0
  std::string noise;            ///< |noise| of each sample is at most this, signal units
  std::string variance;         ///< of the noise that the filter assumes
  int samples = 200;            ///< of 0.1 s
};

/// The estimated frequency after the last sample, for every noise of that size: P(0) = diag(0, (omega -
/// first estimate)^2), no process noise, the amplitude 1 known. Empty where the enclosure is lost on the way.
/// Needs the upward rounding mode.
///
/// States and covariance together are m + A r, r in a box: a step maps that into f(m) + J A r + J_v v, J over
/// a box that holds the set, and A is chosen again from an orthogonal matrix (Lohner).
[[nodiscard]] rigor::Interval frequency_after(const HorizonQuestion& question);

}  // namespace veritrack::theorems

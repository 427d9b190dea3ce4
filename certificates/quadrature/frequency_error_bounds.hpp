// Simulated runs beside the certified bound of every sample, for the figure of the certificate.
#pragma once

#include <optional>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// |frequency error|, rad/sample, after 0, 1, ... samples.
struct FrequencyErrorBounds {
  /// The starts: all assumed ones, which had to be captured; otherwise all of the certified set.
  bool from_assumed_starts = false;
  std::vector<double> bound;  ///< certified, for every such start and all noise and slew assumed
  /// The same for the assumed starts, where `bound` is about all of the set; as long, or empty.
  std::vector<double> bound_of_assumed_starts;
  /// Runs of the tracker in double precision, from the boundary of the starts, without disturbances and with
  /// noise and slew chosen at each sample to push the frequency error out. As long as the bound. They prove
  /// nothing.
  std::vector<std::vector<double>> runs;
};

/// Empty when no set is certified or no bound is proved. Opens its own rounding scopes.
[[nodiscard]] std::optional<FrequencyErrorBounds> frequency_error_bounds(const Certificate& certificate);

}  // namespace veritrack::certificates

// The assumptions of a certificate, one after the other, and whether a recording keeps each, or why that was
// not tested.
#pragma once

#include <string>
#include <vector>

#include "reports/recording/track_document.hpp"

namespace veritrack::reports {

/// Why nothing was measured, where that is so.
[[nodiscard]] inline const char* why_none_judged(const TrackResult& result) {
  return result.blocks.empty() ? "no stretch was in lock and without gaps for long enough"
                               : "the tone is too weak in single samples; its lock is judged by blocks";
}

/// One assumption.
struct TestedAssumption {
  enum class Outcome { kept, not_kept, not_testable };
  std::string name;     ///< "slew"
  std::string assumed;  ///< "at most 1e-06 rad/sample per sample"
  std::string seen;     ///< what was measured; empty where nothing was
  Outcome outcome = Outcome::not_testable;
  std::string where;  ///< ranges of samples, or the reason
};

/// All assumptions of the design's certificate.
[[nodiscard]] std::vector<TestedAssumption> tested_assumptions(const TrackReport& report);

/// Whether the certificate is for Gaussian noise and the quadrature channel comes from a Hilbert filter,
/// whose noise is neither independent from sample to sample nor from channel to channel.
[[nodiscard]] bool hilbert_excludes_certificate(const TrackReport& report);

/// Whether some assumption was tested, and each that was is kept.
[[nodiscard]] bool keeps_to_tested(const TrackReport& report);

/// One or two sentences.
[[nodiscard]] std::string assumptions_sentence(const TrackReport& report);

/// The section of the document: a row each.
[[nodiscard]] std::string assumptions_section(const TrackReport& report);

}  // namespace veritrack::reports

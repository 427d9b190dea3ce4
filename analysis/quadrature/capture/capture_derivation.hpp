// The result of all followed cells of starts together: bounds over time, quantities and conditions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/capture/capture_region.hpp"
#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/sets/contraction_question.hpp"
#include "analysis/sets/kalman_filter_result.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// The bounds of all cells while they are followed, and those of the set from each cell's capture on.
struct CaptureBounds {
  /// On |frequency error|, rad/sample, after 0, 1, ... samples; the last one is valid for ever after.
  std::vector<double> frequency_errors;
  double ultimate_frequency_error = 0.0;  ///< of the set that captures
  std::optional<int> settling_samples;
  double settled_frequency_error = 0.0;  ///< from then on, rad/sample
};

/// The bounds of a region of which every cell is PROVED. Needs the upward mode.
[[nodiscard]] CaptureBounds capture_tube(const sets::ContractionQuestion& question, const CertifiedSet& set,
                                         const Region& region);

/// The claims that the cells prove about the starts, without the conditions. Needs the upward mode.
[[nodiscard]] sets::StartResult capture_result(rigor::Verdict verdict_on_starts,
                                               const CertifiedSet& set_of_capture, const Region& region,
                                               const CaptureBounds& tube);

/// The quantities of that result, and cells and cells_captured.
[[nodiscard]] std::vector<theorems::Quantity> capture_quantities(const sets::StartResult& result,
                                                                 const Region& region);

/// The condition certified-set: the set tolerates the assumed noise and slew. Needs the upward mode.
[[nodiscard]] theorems::Condition set_tolerates_assumptions(const sets::ContractionQuestion& question,
                                                            const CertifiedSet& set);

/// The condition starts-captured, with the reason for its verdict; the first cells that failed go to `notes`.
[[nodiscard]] theorems::Condition starts_captured(const Region& region, std::vector<std::string>& notes);

/// Exact numbers from which the verdict can be established again: every cell with the samples after which it
/// is captured and its level then ("cover", PROVED), or the starts that lock elsewhere ("witness", REFUTED).
[[nodiscard]] std::vector<theorems::Evidence> capture_evidence(const sets::ContractionQuestion& question,
                                                               const Region& region);

}  // namespace veritrack::quadrature

// Capture of all assumed starts: from the start errors and the initial covariance of a question, with its
// noise and slew on, into a certified set.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/capture/capture_region.hpp"
#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// All start errors that the question allows. Needs the upward mode.
[[nodiscard]] StartBox assumed_starts(const sets::ContractionQuestion& question);

/// The closed loop of the question, to be followed with its noise and slew from its start covariances
/// (with_start_covariance). Nothing when there are none. Needs the upward mode.
[[nodiscard]] std::optional<CaptureProblem> capture_problem(const sets::ContractionQuestion& asked);

/// The proved claims about the starts.
struct StartCapture {
  /// The quantities of `result`, cells and cells_captured; conditions certified-set, starts-captured.
  theorems::Derivation derivation;
  sets::StartResult result;
  Region region;  ///< the cells of starts; none when nothing was followed
  /// Upper bounds on |frequency error| (rad/sample) after 0, 1, ... samples, for every assumed start and all
  /// noise and slew; the last one is valid for ever after. Empty unless PROVED.
  std::vector<double> frequency_errors;
};

/// Follows every start of the question, in cells, until it lies in `set`, which must have been certified
/// (verify_certified_set) for the question's design. PROVED: every start is captured. REFUTED: some start,
/// named in the reason, locks at a wrong frequency whatever the noise. UNDECIDED otherwise, with the number
/// of cells that failed and the first of them as notes. `id` is the derivation's. Needs epsilon = 0. At most
/// `most_cells` cells are followed, on the threads of oneTBB; the result does not depend on their number.
/// `progress` as in prove_region. Opens its own rounding scope.
[[nodiscard]] StartCapture capture_starts(const sets::ContractionQuestion& question, const CertifiedSet& set,
                                          const std::string& id, std::size_t most_cells,
                                          const std::function<bool(const RegionProgress&)>& progress = {});

}  // namespace veritrack::quadrature

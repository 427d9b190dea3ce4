// The guarantee of the quadrature tracker without a leak in Coq: a theorem about the filter's recursion.
#pragma once

#include "certificates/document/coq_parts.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/start_covariance.hpp"

namespace veritrack::certificates::coq {

/// The numbers that Coq checks and the theorems frequency_error_for_ever and frequency_error_in_the_long_run,
/// to be read after ekf_parts(); or only the reason why they are missing. Needs the upward mode.
[[nodiscard]] Proofs guarantee_proofs(const QuadratureEkfTables& tables, const StartCovarianceText& start);

}  // namespace veritrack::certificates::coq

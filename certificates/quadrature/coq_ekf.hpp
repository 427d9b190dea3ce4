// The guarantee of the quadrature tracker without a leak in Coq: a theorem about the filter's recursion.
#pragma once

#include "certificates/document/coq_parts.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/start_covariance.hpp"

namespace veritrack::certificates::coq {

/// Appends the files of certificates/coq/ekf/, the numbers that Coq checks, and the theorems
/// frequency_error_for_ever and frequency_error_in_the_long_run. Appends nothing for a design with a leak,
/// with Gaussian noise, of another amplitude than 1 or with an error of the start in Hz, nor where no numbers
/// are found. Needs the upward mode.
void prove_guarantee(Proofs& proofs, const QuadratureEkfTables& tables, const StartCovarianceText& start);

}  // namespace veritrack::certificates::coq

// The results of a search against a certificate, which show how tight it is. None of it is proved.
#pragma once

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"

namespace veritrack::quadrature {

/// Appends, marked as not proved: frequency_error_radius_sampled_limit (rad/sample, see
/// sampled_radius_limit), frequency_error_radius_share_of_limit, and the share of the two bounds that the
/// falsifier reached, frequency_error_bound_tightness and ultimate_frequency_error_tightness. The certificate
/// must have a `set`. Needs the upward mode.
void add_sampled_quantities(const sets::ContractionQuestion& question,
                            const ContractionCertificate& certificate, theorems::Derivation& derivation);

}  // namespace veritrack::quadrature

// The certificate of a design of the quadrature tracker.
#pragma once

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Adds the published theorem in its readings ("theorem-2.9/..."), other published results, this program's
/// own proofs ("contraction"; then, when the starts exceed the certified set, "capture" and perhaps
/// "capture/noise-free" and "capture/reduced-noise"), and the claims. With Gaussian noise the probability of
/// losing lock ("lock") in place of all these. Needs the upward mode.
void certify_quadrature(Certificate& certificate, const CertifyProgress& progress);

/// Adds the published results alone, with the simulation that audits them: for noise with a bound. Needs the
/// upward mode.
void quadrature_published_results(Certificate& certificate);

}  // namespace veritrack::certificates

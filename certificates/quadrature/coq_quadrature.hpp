// What Coq can check of a certificate: the constants and refutations of Theorem 2.9, and the guarantee of the
// tracker without a leak.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and what it proves. Needs the upward mode.
[[nodiscard]] FormalProofs quadrature_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

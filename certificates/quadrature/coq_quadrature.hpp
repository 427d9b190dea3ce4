// The parts of a certificate that Coq can check: the constants and refutations of Theorem 2.9, and the
// guarantee of the tracker without a leak.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and its statements. Needs the upward mode.
[[nodiscard]] FormalProofs quadrature_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

// The parts of a certificate that Coq can check: the identities of the KKL observer and the lower bound on
// its ell.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and its statements. Needs the upward mode.
[[nodiscard]] FormalProofs kkl_observer_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

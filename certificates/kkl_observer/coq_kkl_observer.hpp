// What Coq can check of a certificate: the identities of the KKL observer and the lower bound on its ell.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and what it proves. Needs the upward mode.
[[nodiscard]] FormalProofs kkl_observer_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

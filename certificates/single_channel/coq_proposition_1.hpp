// What Coq can check of a certificate: Bittanti and Savaresi's Proposition 1.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and what it proves. Needs the upward mode.
[[nodiscard]] FormalProofs proposition_1_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

// The part of a certificate that Coq can check: Bittanti and Savaresi's Proposition 1.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and its statements. Needs the upward mode.
[[nodiscard]] FormalProofs proposition_1_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

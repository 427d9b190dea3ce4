// What Coq can check of a certificate: the constants and refutations of Theorem 2.9.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// certificate.v, and what it proves. Needs the upward mode.
[[nodiscard]] FormalProofs theorem_2_9_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates::coq

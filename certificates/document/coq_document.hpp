// certificate.v: the statements of a certificate that a proof assistant can check, with their proofs.
#pragma once

#include <stdexcept>

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates {

/// Thrown for a kind of tracker whose certificates have nothing that Coq can check. what() is one line.
class NoFormalProofs : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The file and its statements: for the KKL observer its identities and the lower bound on ell, for the
/// quadrature tracker the constants and refutations of Theorem 2.9, for the single-channel tracker
/// Proposition 1. The numbers are the decimals of the design file and those that the certificate prints; none
/// of the program's computations enters. Throws NoFormalProofs. Opens its own rounding scope.
[[nodiscard]] FormalProofs coq_proofs(const Certificate& certificate);

}  // namespace veritrack::certificates

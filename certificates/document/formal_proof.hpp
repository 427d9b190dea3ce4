// Proofs of a certificate's statements in the language of the proof assistant Coq.
#pragma once

#include <string>
#include <vector>

namespace veritrack::certificates {

/// The file beside the certificate that holds them.
inline constexpr const char* kFormalProofFile = "certificate.v";

/// A statement of the certificate that certificate.v proves.
struct FormalProof {
  std::string lemma;      ///< its name in certificate.v
  std::string of;         ///< its subject: the id of a claim, or "derivation/condition-or-quantity"
  std::string statement;  ///< one sentence of Markdown
};

/// certificate.v and its lemmas. Nothing is proved until coqc has accepted the text.
struct FormalProofs {
  std::string text;
  std::vector<FormalProof> proofs;
  std::vector<std::string> left_out;  ///< statements not proved there and why, a sentence or two each
};

}  // namespace veritrack::certificates

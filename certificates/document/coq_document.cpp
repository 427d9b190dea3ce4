#include "certificates/document/coq_document.hpp"

#include <fmt/format.h>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/coq_parts.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

namespace coq {

void Proofs::prove(const std::string& lemma, const std::string& proposition, const std::string& proof,
                   std::string of, std::string statement) {
  write(fmt::format("\nLemma {} :\n  {}.\nProof.\n{}\nQed.\n", lemma, proposition, proof));
  cite(lemma, std::move(of), std::move(statement));
}

FormalProofs Proofs::finished() const {
  FormalProofs result = proofs_;
  std::string names;
  for (const FormalProof& proof : result.proofs) {
    names += (names.empty() ? "" : ",\n  ") + proof.lemma;
  }
  result.text += fmt::format(
      "\n(* The statements that certificate.md lists as proved here, and their axioms. *)\nDefinition "
      "proved_here := (\n  {}).\nPrint Assumptions proved_here.\n",
      names);
  return result;
}

}  // namespace coq

FormalProofs coq_proofs(const Certificate& certificate) {
  const rigor::UpwardRounding upward;
  const TrackerKind& kind = kind_of(certificate.design);
  if (kind.formal_proofs == nullptr) {
    throw NoFormalProofs(
        fmt::format("a certificate of the tracker {} has no formal proofs; allowed with --coq: {}", kind.name,
                    names_of_kinds([](const TrackerKind& other) { return other.formal_proofs != nullptr; })));
  }
  return kind.formal_proofs(certificate);
}

}  // namespace veritrack::certificates

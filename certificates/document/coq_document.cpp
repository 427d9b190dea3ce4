#include "certificates/document/coq_document.hpp"

#include <fmt/format.h>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/coq_parts.hpp"

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
      "\n(* What certificate.md says is proved here, and the axioms that it rests on. *)\n"
      "Definition proved_here := (\n  {}).\nPrint Assumptions proved_here.\n",
      names);
  return result;
}

}  // namespace coq

FormalProofs coq_proofs(const Certificate& certificate) {
  const rigor::UpwardRounding upward;
  if (std::holds_alternative<KklObserverTables>(certificate.design.tables)) {
    return coq::kkl_observer_proofs(certificate);
  }
  if (std::holds_alternative<SingleChannelEkfTables>(certificate.design.tables)) {
    return coq::proposition_1_proofs(certificate);
  }
  return coq::theorem_2_9_proofs(certificate);
}

}  // namespace veritrack::certificates

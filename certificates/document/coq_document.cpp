#include "certificates/document/coq_document.hpp"

#include <fmt/format.h>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/coq_parts.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

namespace coq {

Proofs::Proofs(std::string_view for_all_designs) {
  write(for_all_designs);
  write("\n(* Everything above is the same for all designs of the kind. *)\n");
}

void Proofs::prove(const std::string& lemma, const std::string& proposition, const std::string& proof,
                   std::string of, std::string statement) {
  write(fmt::format("\nLemma {} :\n  {}.\nProof.\n{}\nQed.\n", lemma, proposition, proof));
  cite(lemma, std::move(of), std::move(statement));
}

void Proofs::append(const Proofs& other) {
  write(other.proofs_.text);
  proofs_.proofs.insert(proofs_.proofs.end(), other.proofs_.proofs.begin(), other.proofs_.proofs.end());
  proofs_.left_out.insert(proofs_.left_out.end(), other.proofs_.left_out.begin(),
                          other.proofs_.left_out.end());
}

void Proofs::leave_out(std::string what_and_why) {
  write(fmt::format("\n(* {} *)\n", what_and_why));
  proofs_.left_out.push_back(std::move(what_and_why));
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

#include "certificates/document/markdown_formal_proofs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::certificates {

namespace {

/// The lemmas that show the same statement.
struct Row {
  std::string of, statement, lemmas;
};

std::vector<Row> rows_of(const std::vector<FormalProof>& proofs) {
  std::vector<Row> rows;
  for (const FormalProof& proof : proofs) {
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
      return row.of == proof.of && row.statement == proof.statement;
    });
    if (same == rows.end()) {
      rows.push_back({proof.of, proof.statement, "`" + proof.lemma + "`"});
    } else {
      same->lemmas += ", `" + proof.lemma + "`";
    }
  }
  return rows;
}

}  // namespace

std::string formal_proofs_section(const Certificate& certificate) {
  if (!certificate.formal_proofs) {
    return "";
  }
  std::string text = fmt::format(
      "## What a proof assistant can check\n\n`{}` beside this document proves the following statements in "
      "the language of Coq, with the decimals of the design file and of this document; the proofs trust "
      "nothing that this program computed. They are proved when `coqc {}` accepts the file (Coq 8.16 with "
      "coq-interval 4.6), which this program does not run. The last lines that coqc prints list the axioms; "
      "these should be only those of the real numbers. Everything else in this document rests on interval "
      "arithmetic.\n\n",
      kFormalProofFile, kFormalProofFile);
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows_of(certificate.formal_proofs->proofs)) {
    cells.push_back({"`" + row.of + "`", markdown::escaped(row.statement), row.lemmas});
  }
  text += markdown::table({"Part of the certificate", "Statement", "Lemma"}, cells) + "\n";
  for (const std::string& sentence : certificate.formal_proofs->left_out) {
    text += "*Not proved there:* " + markdown::escaped(sentence) + "\n\n";
  }
  return text;
}

}  // namespace veritrack::certificates

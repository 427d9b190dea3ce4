// A tracker that a user has written down, as a kind of tracker.
#include <fmt/format.h>

#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_claims.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/recursion_text.hpp"

namespace veritrack::certificates {

namespace {

std::string title_of(const Design& design) {
  return design.source.empty() ? design.name : fmt::format("{} ({})", design.name, design.source);
}

std::string show(const Design& design, CodeLanguage language) {
  const rigor::UpwardRounding upward;
  const ModelTables& tables = model_tables(design);
  return recursion_text(make_model(tables.model, tables.assume.signal), title_of(design), language);
}

void certify_model(Certificate& certificate, const CertifyProgress& progress) {
  certificate.particulars = certify_sets(model_tables(certificate.design), certificate.extent, progress);
  add_model_claims(certificate);
}

std::string summary(const Certificate& certificate) {
  std::string text;
  for (const Claim& claim : certificate.claims) {
    if (!claim.required && claim.verdict != rigor::Verdict::undecided) {
      text += fmt::format("{}: {}\n\n", markdown::verdict(claim.verdict), claim.statement);
    }
  }
  return text;
}

std::string sections(const Certificate& certificate, const MarkdownOptions& /*options*/) {
  return "## The recursion\n\n" + markdown::fenced(show(certificate.design, CodeLanguage::formulas), "") +
         "\n";
}

}  // namespace

const TrackerKind& model_kind() {
  static const TrackerKind kind{.name = "model",
                                .design_json = model_design_json,
                                .certify = certify_model,
                                .summary = summary,
                                .sections = sections,
                                .evidence_json = model_evidence_json,
                                .show = show};
  return kind;
}

}  // namespace veritrack::certificates

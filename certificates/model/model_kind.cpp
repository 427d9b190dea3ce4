// A tracker that a user has written down, as a kind of tracker.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/markdown_model.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_claims.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_promise.hpp"
#include "certificates/model/model_run.hpp"
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

std::ptrdiff_t required_and_proved(const Certificate& certificate) {
  return std::count_if(certificate.claims.begin(), certificate.claims.end(), [](const Claim& claim) {
    return claim.required && claim.verdict == rigor::Verdict::proved;
  });
}

std::ptrdiff_t required_claims_of(const Certificate& certificate) {
  return std::count_if(certificate.claims.begin(), certificate.claims.end(),
                       [](const Claim& claim) { return claim.required; });
}

void certify_model(Certificate& certificate, const CertifyProgress& progress) {
  const auto certify = [&](Certificate result, bool by_structure) {
    result.particulars =
        certify_sets(model_tables(result.design), result.extent, result.deadline, progress, by_structure);
    add_model_claims(result);
    return result;
  };
  Certificate first = certify(certificate, true);
  if (model_sets(first).bounds_covariance && required_and_proved(first) < required_claims_of(first) &&
      !first.deadline.is_over()) {
    // In the long run, tubes with the covariance among their states may be narrower.
    Certificate second = certify(certificate, false);
    if (required_and_proved(second) > required_and_proved(first)) {
      first = std::move(second);
    }
  }
  certificate = std::move(first);
}

}  // namespace

const TrackerKind& model_kind() {
  static const TrackerKind kind{.name = "model",
                                .design_json = model_design_json,
                                .certify = certify_model,
                                .summary = model_summary,
                                .sections = model_sections,
                                .limited_in_time = true,
                                .evidence_json = model_evidence_json,
                                .show = show,
                                .track = model_on_samples,
                                .frequency_promise = model_frequency_promise};
  return kind;
}

}  // namespace veritrack::certificates

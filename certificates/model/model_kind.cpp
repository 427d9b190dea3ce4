// A tracker that a user has written down, as a kind of tracker.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/better_way.hpp"
#include "certificates/model/markdown_model.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_claims.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_promise.hpp"
#include "certificates/model/model_run.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/model_tuning.hpp"
#include "certificates/model/recursion_text.hpp"
#include "certificates/model/tie/tie.hpp"
#include "certificates/model/written_code.hpp"

namespace veritrack::certificates {

namespace {

std::string title_of(const Design& design) {
  return design.source.empty() ? design.name : fmt::format("{} ({})", design.name, design.source);
}

std::string show(const Design& design, CodeLanguage language) {
  const rigor::UpwardRounding upward;
  const ModelTables& tables = model_tables(design);
  if (language == CodeLanguage::single_precision_c || language == CodeLanguage::double_precision_c) {
    return written_code(tables, title_of(design),
                        language == CodeLanguage::single_precision_c ? "binary32" : "binary64");
  }
  return recursion_text(make_model(tables.model, tables.assume.signal), title_of(design), language);
}

void certify_model(Certificate& certificate, const CertifyProgress& progress) {
  certificate = better_way([&](bool by_structure) {
    Certificate result = certificate;
    result.particulars =
        certify_sets(model_tables(result.design), result.extent, result.deadline, progress, by_structure);
    add_model_claims(result);
    return result;
  });
}

}  // namespace

const TrackerKind& model_kind() {
  static const TrackerKind kind{.name = "model",
                                .design_json = model_design_json,
                                .certify = certify_model,
                                .answers = model_answers,
                                .sections = model_sections,
                                .remarks = model_remarks,
                                .limited_in_time = true,
                                .evidence_json = model_evidence_json,
                                .report_json = model_report_json,
                                .tune = tune_model,
                                .tuning_objectives = model_tuning_objectives(),
                                .names_parameters = true,
                                .show = show,
                                .tie = tie::tie_model,
                                .track = model_on_samples,
                                .frequency_promise = model_frequency_promise};
  return kind;
}

}  // namespace veritrack::certificates

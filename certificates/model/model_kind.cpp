// A tracker that a user has written down, as a kind of tracker.
#include <fmt/format.h>

#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/recursion_text.hpp"
#include "certificates/sets/required_claims.hpp"

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

Json texts_json(const std::vector<SourceText>& texts) {
  Json list = Json::array();
  for (const SourceText& text : texts) {
    list.push_back(text.text);
  }
  return list;
}

Json named_json(const std::vector<NamedText>& texts) {
  Json list = Json::array();
  for (const NamedText& text : texts) {
    list.push_back({{"name", text.name.text}, {"formula", text.formula.text}});
  }
  return list;
}

Json matrix_json(const std::vector<std::vector<SourceText>>& rows) {
  Json matrix = Json::array();
  for (const std::vector<SourceText>& row : rows) {
    matrix.push_back(texts_json(row));
  }
  return matrix;
}

Json filter_json(const ModelEkfTable& filter) {
  Json json{{"states", texts_json(filter.states)},
            {"predict", filter.predict.text},
            {"measure", texts_json(filter.measure)},
            {"Q", matrix_json(filter.process_noise)},
            {"R", matrix_json(filter.measurement_noise)}};
  if (!filter.jacobian.empty()) {
    json["jacobian"] = matrix_json(filter.jacobian);
  }
  return json;
}

Json model_design_json(const Design& design) {
  const auto& [model, assume, require] = model_tables(design);
  Json assumed{{"amplitude", number_json(assume.amplitude)},
               {"frequency", {number_json(assume.frequency[0]), number_json(assume.frequency[1])}},
               {"frequency_in_hertz", assume.frequency_in_hertz},
               {"noise", number_json(assume.noise)},
               {"slew", number_json(assume.slew)},
               {"slew_in_hertz_per_second", assume.slew_in_hertz_per_second}};
  add_number(assumed, "sample_rate", assume.sample_rate);
  Json recursion{{"samples", texts_json(model.samples)},
                 {"parameters", named_json(model.parameters)},
                 {"angles", texts_json(model.angles)},
                 {"frequency", model.frequency.text},
                 {"signal", texts_json(signal_of(model, assume.signal))}};
  if (model.ekf) {
    recursion["ekf"] = filter_json(*model.ekf);
  } else {
    recursion["states"] = texts_json(model.states);
    recursion["step"] = model.step.text;
  }
  return {{"model", recursion}, {"assume", assumed}};
}

/// Nothing is proved of a model yet; what is required says so.
void certify_model(Certificate& certificate, const CertifyProgress& /*progress*/) {
  for (const auto& [path, position] : certificate.design.positions) {
    if (!path.starts_with("require.")) {
      continue;
    }
    Claim claim;
    claim.id = "model/" + path.substr(std::string("require.").size());
    claim.requirement = path;
    claim.statement = "The requirement " + path + " of the design file holds.";
    claim.required = true;
    claim.position = position;
    claim.reason = "This version reads and shows recursions; it does not certify them.";
    certificate.claims.push_back(claim);
  }
  conclude_requirements(certificate);
}

std::string summary(const Certificate& /*certificate*/) {
  return {};
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
                                .show = show};
  return kind;
}

}  // namespace veritrack::certificates

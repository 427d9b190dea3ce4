#include "certificates/single_channel/single_channel_json.hpp"

#include "certificates/document/json.hpp"
#include "certificates/sets/assumptions_json.hpp"
#include "certificates/single_channel/recursion_part.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace veritrack::certificates {

Json single_channel_design_json(const Design& read) {
  const auto& [design, assume, require, simulate] = single_channel_tables(read);
  Json chosen = Json::object();
  add_number(chosen, "q", design.q);
  add_number(chosen, "r", design.r);
  add_number(chosen, "lambda", design.lambda);
  chosen["epsilon"] = number_json(design.epsilon);
  if (design.variances) {
    chosen["process_noise"] = {{"q1", number_json((*design.variances)[0])},
                               {"q2", number_json((*design.variances)[1])}};
  } else {
    chosen["process_noise"] = design.process_noise == SingleChannelDesignTable::ProcessNoise::identity
                                  ? "identity"
                                  : "frequency-only";
  }
  return {{"design", chosen}, {"assume", assume_json(assume)}, {"require", require_json(require)}};
}

Json single_channel_evidence_json(const Certificate& certificate) {
  Json json = Json::object();
  if (has_recursion(certificate)) {
    json["recursion"] = inner_certificate_json(*recursion_part(certificate).certificate);
  }
  return json;
}

Json single_channel_report_json(const Certificate& certificate) {
  return {{"simulate", simulate_json(single_channel_tables(certificate.design).simulate)}};
}

}  // namespace veritrack::certificates

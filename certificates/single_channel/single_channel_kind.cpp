// The single-channel tracker as a kind of tracker.
#include <optional>
#include <string>
#include <vector>

#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/frequency_promise.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/markdown_assumptions.hpp"
#include "certificates/sets/markdown_contraction.hpp"
#include "certificates/single_channel/coq_proposition_1.hpp"
#include "certificates/single_channel/markdown_single_channel.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "certificates/single_channel/single_channel_json.hpp"
#include "certificates/single_channel/single_channel_tuning.hpp"

namespace veritrack::certificates {

namespace {

std::vector<const Claim*> answers(const Certificate& certificate) {
  std::vector<const Claim*> found = guarantees(certificate);
  for (const Claim& claim : certificate.claims) {
    if (claim.id.starts_with("recursion/")) {
      found.push_back(&claim);
    }
  }
  return found;
}

std::string sections(const Certificate& certificate, const MarkdownOptions& options) {
  const SingleChannelEkfTables& tables = single_channel_tables(certificate.design);
  return single_channel_design_section(certificate) + assumptions_section(tables.assume) +
         contraction_section(certificate) + recursion_section(certificate) + bias_section(certificate) +
         simulated_run_section(certificate, tables.simulate, options) + single_channel_coverage_section();
}

FrequencyPromise frequency_promise(const Certificate& certificate) {
  return ekf_frequency_promise(certificate, single_channel_tables(certificate.design).assume, false);
}

std::string published(const Certificate& certificate) {
  return transfer_function_section(certificate) + proposition_section(certificate);
}

}  // namespace

const TrackerKind& single_channel_kind() {
  static const TrackerKind kind{.name = "single-channel-ekf",
                                .design_json = single_channel_design_json,
                                .certify = certify_single_channel,
                                .answers = answers,
                                .sections = sections,
                                .remarks = single_channel_remarks,
                                .published_results = single_channel_published_results,
                                .published = published,
                                .limited_in_time = true,
                                .evidence_json = single_channel_evidence_json,
                                .report_json = single_channel_report_json,
                                .formal_proofs = coq::proposition_1_proofs,
                                .tune = tune_single_channel,
                                .tuning_objectives = single_channel_tuning_objectives(),
                                .track = single_channel_on_samples,
                                .frequency_promise = frequency_promise};
  return kind;
}

}  // namespace veritrack::certificates

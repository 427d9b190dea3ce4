// The vibration regulator as a kind of tracker.
#include "certificates/document/tracker_kind.hpp"
#include "certificates/regulator/markdown_regulator.hpp"
#include "certificates/regulator/regulator.hpp"

namespace veritrack::certificates {

const TrackerKind& regulator_kind() {
  static const TrackerKind kind{.name = "vibration-regulator",
                                .design_json = regulator_design_json,
                                .certify = certify_regulator,
                                .answers = regulator_answers,
                                .sections = regulator_sections,
                                .limited_in_time = true,
                                .evidence_json = regulator_evidence_json};
  return kind;
}

}  // namespace veritrack::certificates

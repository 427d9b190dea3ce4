// The KKL observer as a kind of tracker.
#include <string>

#include <array>
#include <string_view>

#include "certificates/document/tracker_kind.hpp"
#include "certificates/kkl_observer/coq_kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_json.hpp"
#include "certificates/kkl_observer/kkl_observer_run.hpp"
#include "certificates/kkl_observer/markdown_kkl_observer.hpp"

namespace veritrack::certificates {

const TrackerKind& kkl_observer_kind() {
  static constexpr std::array<std::string_view, 1> kObjectives{"frequency-error"};
  static const TrackerKind kind{.name = "kkl-observer",
                                .design_json = kkl_observer_design_json,
                                .certify = certify_kkl_observer,
                                .answers = kkl_observer_answers,
                                .sections = kkl_observer_sections,
                                .published_results = kkl_observer_published_results,
                                .published = kkl_observer_published,
                                .formal_proofs = coq::kkl_observer_proofs,
                                .tune = tune_kkl_observer,
                                .tuning_objectives = kObjectives,
                                .track = kkl_observer_on_samples};
  return kind;
}

}  // namespace veritrack::certificates

// The certificate of a design of the KKL observer.
#pragma once

#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/kkl_observer/kkl_robustness.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/tuning.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"

namespace veritrack::certificates {

/// Adds the derivations "kkl-ell", "kkl-paper" and "kkl-robustness" (and "kkl-section-v" for the paper's
/// rates), the required claims and their verdict to a certificate whose design is one of the KKL observer.
/// Needs the upward mode.
void certify_kkl_observer(Certificate& certificate, const CertifyProgress& progress);

/// The same with ell and the claims of the paper alone. Needs the upward mode.
void kkl_observer_published_results(Certificate& certificate);

/// Chooses the rates of an observer with four filters for a small frequency error under the assumed
/// disturbance and a settling time of at most settles_within (without it: that of the given rates). The ell
/// is left to the certificate. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune_kkl_observer(const Design& design, const TuningRequest& request);

/// The range of the signal, for M filters. Needs the upward mode. Throws std::out_of_range when there are
/// fewer.
template <int M = 4>
[[nodiscard]] kkl_observer::KklRangeOf<M> kkl_range(const KklObserverTables& tables) {
  kkl_observer::KklRangeOf<M> range;
  for (int i = 0; i < M; ++i) {
    range.lambda(i) = tables.design.lambda.at(static_cast<std::size_t>(i)).value;
  }
  range.frequency = rigor::hull(tables.assume.frequency[0].value, tables.assume.frequency[1].value);
  return range;
}

/// The question about the robustness of an observer with M filters, four to eight, and an ell in use. Needs
/// the upward mode.
template <int M = 4>
[[nodiscard]] kkl_observer::KklRobustnessQuestionOf<M> kkl_robustness_question(
    const KklObserverTables& tables, const rigor::Interval& ell);

/// The rates of a design, if they are those of the paper's section V, (1, 2, 3, 4) 1/s.
[[nodiscard]] std::optional<Eigen::Vector4d> section_v_rates(const KklObserverTables& tables);

/// The ell that an observer runs with: the design's, or the lower end of the proved one.
struct KklEll {
  rigor::Interval value;               ///< empty when there is none
  double nearest = 0.0;                ///< NaN when there is none
  std::optional<std::string> decimal;  ///< as the design writes it; none: the proved one
};

/// Decided from the design and the derivation "kkl-ell" of its certificate.
[[nodiscard]] KklEll kkl_ell_in_use(const Certificate& certificate);

/// The proved bound of that name ("frequency_error_bound", "amplitude_error_bound", "settling_time"); empty
/// when nothing was proved.
[[nodiscard]] std::optional<rigor::Interval> proved_kkl_bound(const Certificate& certificate,
                                                              const std::string& name);

}  // namespace veritrack::certificates

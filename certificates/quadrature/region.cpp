#include "certificates/quadrature/region.hpp"

#include <fmt/format.h>

#include "analysis/quadrature/capture/capture_starts.hpp"
#include "analysis/quadrature/capture/capture_target.hpp"
#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/start_covariance.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

using rigor::Interval;

std::function<bool(const quadrature::RegionProgress&)> region_progress(const CertifyProgress& progress) {
  return [&progress](const quadrature::RegionProgress& so_far) {
    if (progress) {
      progress({so_far.proved_share, so_far.refuted_share, so_far.propagations});
    }
    return true;
  };
}

std::string region_statement(const Design& design, const RegionRequest& request) {
  const QuadratureEkfTables& tables = quadrature_tables(design);
  StartCovarianceText covariance;
  {
    const rigor::NearestRounding nearest;
    covariance = start_covariance_text(tables);
  }
  const rigor::UpwardRounding upward;
  const GuaranteeTerms terms{
      tables.assume,   tables.require, false, true, covariance_words(covariance, std::nullopt),
      kDoublePrecision};
  return fmt::format(
      "{}{}, started with a frequency error and a phase error that lie in a cell that is proved to be "
      "captured, "
      "within {} of the amplitude {}, the tracker is in the certified set after at most as many samples as "
      "the "
      "cell says, and never leaves it.",
      tone(terms, false), request.with_noise ? assumed_disturbance(terms) : disturbance_of("", ""),
      tables.assume.initial_amplitude_error.text, terms.covariance);
}

RegionResult prove_region_of_attraction(const Design& design, const RegionRequest& request,
                                        const CertifyProgress& progress) {
  const rigor::UpwardRounding upward;
  sets::ContractionQuestion question = contraction_question(design);
  if (!request.with_noise) {
    question.noise = Interval(0.0);
    question.slew = Interval(0.0);
  }
  if (!question.design.without_leak()) {
    return {std::nullopt,
            "A map needs a design without leak (epsilon = 0): with a leak the set into which starts are "
            "followed depends on the frequency, which the map does not support."};
  }
  const quadrature::ContractionCertificate certificate = quadrature::certify_contraction(question);
  if (!certificate.set || certificate.set->verdict != rigor::Verdict::proved) {
    std::string reason = "No set could be certified in which starts might be captured.";
    for (const theorems::Condition& condition : certificate.derivation.conditions) {
      if (condition.verdict != rigor::Verdict::proved) {
        reason += " " + condition.id + ": " + condition.reason;
        break;
      }
    }
    return {std::nullopt, reason};
  }
  std::optional<quadrature::CaptureProblem> problem = quadrature::capture_problem(question);
  if (!problem) {
    return {std::nullopt, "The steady-state covariance could not be verified."};
  }
  // The set was certified for this noise and slew; it is invariant for no more.
  problem->noise = certificate.set->set.noise;
  problem->slew = certificate.set->set.slew;
  const quadrature::CertifiedSetTarget target(certificate.set->set, true);
  const quadrature::StartBox starts{rigor::symmetric(question.initial_amplitude_error.upper()),
                                    rigor::symmetric(request.phase_error),
                                    rigor::symmetric(request.frequency_error)};
  constexpr int kGrid = 64;
  RegionOfAttraction found;
  found.region = quadrature::prove_region(*problem, target, starts, {}, region_progress(progress));
  found.basin = quadrature::simulate_basin(*problem, starts, kGrid, kGrid, 2000);
  found.shares = quadrature::shares_of_basin(found.region, found.basin);
  return {std::move(found), ""};
}

}  // namespace veritrack::certificates

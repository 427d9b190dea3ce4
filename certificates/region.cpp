#include "certificates/region.hpp"

#include "analysis/contraction/capture_target.hpp"
#include "analysis/contraction/fixed_point_bias.hpp"
#include "analysis/contraction/quadrature_certificate.hpp"
#include "certificates/guarantee.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

/// P* without a leak, verified: the covariance of the fixed point at frequency 0, which without a leak is
/// that of every frequency.
std::optional<rigor::IntervalMatrix<3>> verified_steady_state(
    const trackers::QuadratureEkfDesign<Interval>& design) {
  const contraction::LockBranch branch = contraction::verify_lock_branch(design, Interval(0.0));
  if (branch.verdict != rigor::Verdict::proved || branch.cells.empty()) {
    return std::nullopt;
  }
  const auto state = branch.cells.front().box();
  rigor::IntervalMatrix<3> covariance;
  covariance << state[3], state[4], state[5],  //
      state[4], state[6], state[7],            //
      state[5], state[7], state[8];
  return covariance;
}

}  // namespace

RegionResult prove_region_of_attraction(
    const Design& design, const RegionRequest& request,
    const std::function<bool(const contraction::RegionProgress&)>& progress) {
  const rigor::UpwardRounding upward;
  contraction::ContractionQuestion question = contraction_question(design);
  if (!request.with_noise) {
    question.noise = Interval(0.0);
    question.slew = Interval(0.0);
  }
  if (!(question.design.epsilon == Interval(0.0))) {
    return {std::nullopt, "A map needs a design without leak (epsilon = 0)."};
  }
  const contraction::ContractionCertificate certificate = contraction::certify_contraction(question);
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
  const std::optional<rigor::IntervalMatrix<3>> covariance =
      question.initial_covariance ? question.initial_covariance : verified_steady_state(question.design);
  if (!covariance) {
    return {std::nullopt, "The steady-state covariance could not be verified."};
  }

  contraction::CaptureProblem problem;
  problem.design = question.design;
  problem.initial_covariance = *covariance;
  // The set was certified for this noise and slew; it is invariant for no more.
  problem.noise = certificate.set->set.noise;
  problem.slew = certificate.set->set.slew;
  const contraction::CertifiedSetTarget target(certificate.set->set, true);
  const contraction::StartBox starts{rigor::symmetric(question.initial_amplitude_error.upper()),
                                     rigor::symmetric(request.phase_error),
                                     rigor::symmetric(request.frequency_error)};
  constexpr int kGrid = 64;
  RegionOfAttraction found;
  found.region = contraction::prove_region(problem, target, starts, {}, progress);
  found.basin = contraction::simulate_basin(problem, starts, kGrid, kGrid, 2000);
  found.shares = contraction::shares_of_basin(found.region, found.basin);
  return {std::move(found), ""};
}

}  // namespace veritrack::certificates

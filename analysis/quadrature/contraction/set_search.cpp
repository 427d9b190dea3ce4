#include "analysis/quadrature/contraction/set_search.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "analysis/quadrature/contraction/promises.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

bool sets_its_own_disturbance(Objective objective) {
  return objective == Objective::noise || objective == Objective::slew;
}

ProposalRequest request_for(const sets::ContractionQuestion& question, Objective objective) {
  ProposalRequest request;
  const auto& design = question.design;
  request.design = {midpoint(design.q1), midpoint(design.q2), midpoint(design.r), 0.0};
  request.objective = objective;
  request.noise = question.noise.upper();
  request.slew = question.slew.upper();
  request.start << question.initial_amplitude_error.upper(), question.initial_phase_error.upper(),
      question.initial_frequency_error.upper();
  if (question.start_covariance) {
    const auto block = [&](const rigor::IntervalMatrix<3>& p) {
      return BlockCovariance<double>{midpoint(p(0, 0)), midpoint(p(1, 1)), midpoint(p(1, 2)),
                                     midpoint(p(2, 2))};
    };
    const rigor::UpwardRounding upward;
    request.start_covariance = CovarianceRange{block(question.start_covariance->lower_end()),
                                               block(question.start_covariance->upper_end())};
  }
  request.required = question.required;
  request.evaluations = question.search_evaluations;
  return request;
}

/// The proposal, when it verifies, and tolerates the assumed noise and slew where the objective does not set
/// them.
std::optional<Verification> verified(const sets::ContractionQuestion& question,
                                     const ProposalRequest& request,
                                     const std::optional<CertifiedSet>& proposal) {
  if (!proposal) {
    return std::nullopt;
  }
  Verification verification =
      verify_certified_set(question.design, *proposal, {question.amplitude, question.largest_frequency});
  // A proposal is not trusted, not even to tolerate the noise and slew that it was searched for.
  const rigor::UpwardRounding upward;
  // cannot bind (question.noise, question.slew): it copies them from the request as they are.
  const bool tolerates_assumptions =
      sets_its_own_disturbance(request.objective) ||
      (certainly_less_equal(question.noise, Interval(verification.set.noise)) &&
       certainly_less_equal(question.slew, Interval(verification.set.slew)));
  return verification.verdict == rigor::Verdict::proved && tolerates_assumptions
             ? std::optional(std::move(verification))
             : std::nullopt;
}

std::optional<Verification> first_that_verifies(const sets::ContractionQuestion& question,
                                                const ProposalRequest& request, const Shape& shape) {
  for (const double fraction : {0.85, 0.8, 0.7, 0.6, 0.45, 0.3, 0.15, 0.05}) {
    if (auto found = verified(question, request, propose_set(request, shape, fraction))) {
      return found;
    }
  }
  return std::nullopt;
}

/// The first of the proposed shapes that verifies, or, where its size is the objective, the largest.
std::optional<Verification> best_that_verifies(const sets::ContractionQuestion& question,
                                               const ProposalRequest& request) {
  const rigor::NearestRounding nearest;
  const auto size = [](const CertifiedSet& set) { return set.radius / set.metric(2, 2); };
  std::optional<Verification> best;
  for (const Shape& shape : propose_shapes(request)) {
    std::optional<Verification> found = first_that_verifies(question, request, shape);
    if (found && (!best || size(found->set) > size(best->set))) {
      best = std::move(found);
    }
    if (best && request.objective != Objective::start_error) {
      break;
    }
  }
  return best;
}

}  // namespace

std::optional<Verification> find_set(const sets::ContractionQuestion& question, Objective objective,
                                     double settled_error) {
  ProposalRequest request = request_for(question, objective);
  request.settled_error = settled_error;
  return best_that_verifies(question, request);
}

std::optional<Verification> find_sufficient_set(const sets::ContractionQuestion& question) {
  if (!question.required.any() || (question.required.samples && !question.settled_frequency_error)) {
    return std::nullopt;
  }
  ProposalRequest request = request_for(question, Objective::requirement);
  request.settled_error = question.settled_frequency_error.value_or(0.0);
  const rigor::NearestRounding nearest;
  for (const SufficientShape& found : propose_sufficient_shapes(request)) {
    auto set = verified(question, request, propose_set(request, found.shape, found.fraction));
    const rigor::UpwardRounding upward;
    if (set && Promises(question, {set->set}).satisfy(question.required)) {
      return set;
    }
  }
  return std::nullopt;
}

std::optional<Verification> with_slew(const sets::ContractionQuestion& question, const CertifiedSet& noisy) {
  constexpr double kShare = 0.999;  // of what the noise leaves
  CertifiedSet proposal = noisy;
  proposal.noise = question.noise.upper();
  proposal.slew = question.slew.upper();
  const double left = (1.0 - noisy.rate * noisy.rate) * noisy.radius * noisy.radius -
                      noisy.noise_gain * noisy.noise_gain * proposal.noise * proposal.noise;
  if (!(left > 0.0) || !(proposal.slew > 0.0)) {
    return std::nullopt;
  }
  proposal.slew_gain = kShare * std::sqrt(left) / proposal.slew;
  Verification verification =
      verify_certified_set(question.design, proposal, {question.amplitude, question.largest_frequency});
  return verification.verdict == rigor::Verdict::proved ? std::optional(verification) : std::nullopt;
}

std::optional<Verification> find_inner_set(const sets::ContractionQuestion& question,
                                           const CertifiedSet& outer) {
  ProposalRequest request = request_for(question, Objective::ultimate_error);
  const auto block = [](const rigor::Matrix<3>& p) {
    return BlockCovariance<double>{p(0, 0), p(1, 1), p(1, 2), p(2, 2)};
  };
  request.start_covariance = CovarianceRange{block(outer.covariance_lower), block(outer.covariance_upper)};
  {
    const rigor::UpwardRounding upward;
    const auto bounds = error_bounds(outer, ultimate_level(outer, question.noise, question.slew));
    constexpr double kRoom = 1.0001;
    request.start << kRoom * bounds[0].upper(), kRoom * bounds[1].upper(), kRoom * bounds[2].upper();
  }
  std::optional<Verification> inner = best_that_verifies(question, request);
  const rigor::UpwardRounding upward;
  // cannot bind (outer): Promises asks the same before it uses the set.
  return inner && certainly_maps_into(outer, inner->set, question.noise, question.slew) ? inner
                                                                                        : std::nullopt;
}

}  // namespace veritrack::quadrature

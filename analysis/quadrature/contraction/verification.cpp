#include "analysis/quadrature/contraction/verification.hpp"

#include <cmath>
#include <utility>

#include "analysis/quadrature/contraction/error_contraction.hpp"
#include "analysis/quadrature/contraction/turn_bounds.hpp"
#include "analysis/quadrature/rounding/set_rounding.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using IntervalDesign = trackers::ToneModel<Interval>;

BlockCovariance<Interval> block(const rigor::Matrix<3>& p) {
  return {Interval(p(0, 0)), Interval(p(1, 1)), Interval(p(1, 2)), Interval(p(2, 2))};
}

/// Symmetric, and P12 = P13 = 0.
bool is_block(const rigor::Matrix<3>& p) {
  return p(0, 1) == 0.0 && p(1, 0) == 0.0 && p(0, 2) == 0.0 && p(2, 0) == 0.0 && p(1, 2) == p(2, 1);
}

bool certainly_positive_definite(const BlockCovariance<Interval>& p VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  rigor::LowerTriangle<2> rest;
  rest[0][0] = p.p22;
  rest[1][0] = p.p23;
  rest[1][1] = p.p33;
  return rigor::certainly_positive(p.p11) && rigor::certainly_positive_definite<2>(rest);
}

/// The first hypothesis on the inputs that does not hold, as a sentence; empty when all hold.
std::string objection(const IntervalDesign& design, const CertifiedSet& set) {
  const Interval zero(0.0);
  const auto& t = set.metric;
  // cannot bind (design.r, design.q2, design.q1): no order is kept without them. Lower bounds grow by less
  // than q1 and q2, and for r <= 0 a variance p is not between the bounds after p r / (p + r).
  if (!certainly_positive(design.r) || !certainly_positive(design.q2) || !certainly_not_negative(design.q1)) {
    return "the design is not one with q1 >= 0, q2 > 0 and r > 0.";
  }
  if (!(design.epsilon == zero)) {
    return "this certificate is for epsilon = 0.";
  }
  if (t(0, 1) != 0.0 || t(0, 2) != 0.0 || t(1, 0) != 0.0 || t(2, 0) != 0.0 || t(2, 1) != 0.0 ||
      !rigor::is_finite(t)) {
    return "the metric does not have the form that the proof needs.";
  }
  if (!certainly_positive(Interval(t(0, 0))) || !certainly_positive(Interval(t(1, 1))) ||
      !certainly_positive(Interval(t(2, 2)))) {
    return "the metric is not certainly invertible.";
  }
  if (!certainly_not_negative(Interval(set.noise_gain)) || !certainly_not_negative(Interval(set.slew_gain))) {
    return "the gains of noise and slew are not finite numbers of 0 or more.";
  }
  if (!certainly_positive(Interval(set.radius)) || !certainly_not_negative(Interval(set.noise)) ||
      !certainly_not_negative(Interval(set.slew)) || !certainly_not_negative(Interval(set.rate)) ||
      !certainly_less(Interval(set.rate), Interval(1.0))) {
    return "radius, noise, slew or rate are outside their ranges.";
  }
  if (!is_block(set.covariance_lower) || !is_block(set.covariance_upper)) {
    return "the covariance bounds do not have the form that the proof needs.";
  }
  const BlockCovariance<Interval> low = block(set.covariance_lower);
  const BlockCovariance<Interval> high = block(set.covariance_upper);
  // cannot bind (high.p11 - low.p11): what is kept from below and from above is in order, with the steady
  // state between the two, or the spread of the gains between them is negative and has no root.
  if (!certainly_positive_definite(low) ||
      !certainly_positive_definite(BlockCovariance<Interval>{high.p11 - low.p11, high.p22 - low.p22,
                                                             high.p23 - low.p23, high.p33 - low.p33})) {
    return "the covariance bounds are not certainly positive definite and in order.";
  }
  return {};
}

/// The amplitude error and chi = psi + nu are at most R times the lengths of these rows of T^-1.
StepSetting<Interval> setting_of(const IntervalDesign& design, const CertifiedSet& set) {
  const BlockMetric<Interval> t{Interval(set.metric(0, 0)), Interval(set.metric(1, 1)),
                                Interval(set.metric(1, 2)), Interval(set.metric(2, 2))};
  const Interval radius(set.radius);
  const Interval one(1.0);
  const Interval amplitude = radius / t.amplitude;
  const Interval chi = radius * rigor::sqrt(rigor::square(one / t.phase) +
                                            rigor::square((one - t.coupling / t.phase) / t.frequency));
  // Any A and C not below these cover the ellipse.
  return {design,
          t,
          block(set.covariance_lower),
          block(set.covariance_upper),
          Interval(amplitude.upper()),
          Interval(chi.upper()),
          Interval(set.noise)};
}

StepConstants<Interval> constants_of(const CertifiedSet& set) {
  return {rigor::square(Interval(set.rate)), rigor::square(Interval(set.noise_gain)),
          rigor::square(Interval(set.slew_gain)), set.noise > 0.0, set.slew > 0.0};
}

}  // namespace

Verification verify_certified_set(const IntervalDesign& design, const CertifiedSet& proposal,
                                  const TrackedSignal& signal) {
  const rigor::UpwardRounding upward;
  Verification result;
  result.set = proposal;
  result.reason = objection(design, proposal);
  if (!result.reason.empty()) {
    return result;
  }
  const StepSetting<Interval> setting = setting_of(design, proposal);
  // cannot bind (setting.largest_amplitude): at amplitude zero the frequency is not seen, and P33 grows by
  // q2.
  if (!certainly_less(setting.largest_amplitude, Interval(1.0))) {
    result.reason = "the set contains amplitudes near zero, where the phase is undefined.";
    return result;
  }
  const StepConstants<Interval> constants = constants_of(proposal);
  const ContractionOverSet contraction = prove_contraction(setting, constants);
  result.cells = contraction.cells;
  if (!contraction.proved) {
    result.reason = contraction.reason;
    return result;
  }
  // Room for an independent verification, whose own bounds may be cruder.
  constexpr double kRoom = 16.0;
  const SetRounding rounding = set_rounding(design, signal, proposal);
  result.set.error_rounding = kRoom * rounding.error;
  result.set.covariance_rounding = kRoom * rounding.covariance;
  if (!std::isfinite(result.set.error_rounding) || !std::isfinite(result.set.covariance_rounding)) {
    result.reason = "the rounding of a step in double precision could not be bounded.";
    return result;
  }
  if (!certainly_keeps_covariance_between(setting.covariance_lower, setting.covariance_upper, design,
                                          bound_turns(setting), result.set.covariance_rounding)) {
    result.reason = "the covariance could not be shown to stay between its bounds.";
    return result;
  }
  const Interval radius(proposal.radius);
  if (!certainly_less_equal(next_level(result.set, radius, Interval(proposal.noise), Interval(proposal.slew)),
                            radius)) {
    result.reason = "noise and slew are too large for the rate of contraction.";
    return result;
  }
  result.verdict = Verdict::proved;
  result.reason = "every step maps the set into itself and contracts.";
  return result;
}

}  // namespace veritrack::quadrature

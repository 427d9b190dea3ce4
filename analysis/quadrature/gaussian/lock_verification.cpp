#include "analysis/quadrature/gaussian/lock_verification.hpp"

#include "analysis/quadrature/gaussian/drift_inequality.hpp"
#include "analysis/quadrature/gaussian/lock_cover.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

bool certainly_definite(const LevelCovariance<double>& p) {
  return rigor::is_positive_definite(enclosed(p)) == Verdict::proved;
}

/// The first hypothesis on the inputs that does not hold, as a sentence; empty when all hold.
std::string objection(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  if (!certainly_positive(design.r) || !certainly_positive(design.q2) || !certainly_not_negative(design.q1)) {
    return "the design is not one with q1 >= 0, q2 > 0 and r > 0.";
  }
  if (!certainly_not_negative(design.epsilon) || !certainly_less(design.epsilon, Interval(1.0))) {
    return "the leak is not one with 0 <= epsilon < 1.";
  }
  if (!(set.lowest_frequency <= set.highest_frequency) || !std::isfinite(set.lowest_frequency) ||
      !std::isfinite(set.highest_frequency) || !std::isfinite(set.bias[0]) || !std::isfinite(set.bias[1]) ||
      !std::isfinite(set.bias[2])) {
    return "the frequencies or the errors about which the set lies are outside their ranges.";
  }
  if (!certainly_positive(Interval(set.metric.amplitude)) ||
      !certainly_positive(Interval(set.metric.phase)) ||
      !certainly_positive(Interval(set.metric.frequency)) || !is_finite(Interval(set.metric.coupling))) {
    return "the metric is not certainly invertible.";
  }
  if (!certainly_definite(set.centre) || !certainly_definite(set.spread_above) ||
      !certainly_definite(set.spread_below)) {
    return "the covariances of the levels are not certainly positive definite.";
  }
  if (!certainly_positive(Interval(set.weight)) || !certainly_positive(Interval(set.level)) ||
      !certainly_positive(Interval(set.decay)) || !certainly_less(Interval(set.decay), Interval(1.0)) ||
      !certainly_not_negative(Interval(set.drift)) || !certainly_positive(Interval(set.noise_deviation)) ||
      !certainly_not_negative(Interval(set.frequency_walk))) {
    return "the weight, the level, the decay, the drift or the noise are outside their ranges.";
  }
  const Interval walked =
      rigor::square(Interval(set.frequency_walk)) *
      (rigor::square(Interval(set.metric.coupling)) + rigor::square(Interval(set.metric.frequency)));
  if (!certainly_less(walked, Interval(1.0))) {
    return "the frequency walks too far in a sample for this metric.";
  }
  return {};
}

}  // namespace

LockVerification verify_lock_set(const trackers::ToneModel<Interval>& design, const LockSet& proposal,
                                 std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  LockVerification result;
  result.reason = objection(design, proposal);
  if (!result.reason.empty()) {
    return result;
  }
  const DriftInequality inequality(design, proposal);
  CoverLimits limits;
  limits.cells_in_part = most_cells;
  const auto cells = cells_of_proof(
      proposal, has_mirror_image(design, proposal),
      [&](const LevelCell& cell) { return inequality.check(cell); }, limits);
  if (!cells) {
    result.reason =
        "somewhere in the set the expected value of W could not be shown to shrink but for the drift.";
    return result;
  }
  result.cells = *cells;
  result.verdict = Verdict::proved;
  result.reason = "the expected value of W shrinks but for the drift.";
  return result;
}

bool expects_cells(const trackers::ToneModel<Interval>& design, const LockSet& proposal, std::size_t every,
                   std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  if (!objection(design, proposal).empty()) {
    return false;
  }
  const DriftInequality inequality(design, proposal);
  const CoverLimits limits{most_cells / static_cast<std::int64_t>(every),
                           most_cells / static_cast<std::int64_t>(every), every};
  return cells_of_proof(
             proposal, has_mirror_image(design, proposal),
             [&](const LevelCell& cell) { return inequality.check(cell); }, limits)
      .has_value();
}

}  // namespace veritrack::quadrature

#include "analysis/single_channel/invariant_curve.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_model.hpp"
#include "analysis/single_channel/curve_proposal.hpp"
#include "analysis/single_channel/tube_verification.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::Verdict;
using trackers::ToneModel;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kError = trackers::kFrequencyError;

/// The means over the phase of the frequency error of the curves, over the whole interval.
Interval mean_error(const InvariantTube& tube) {
  const PhaseFamily& curve = tube.curve;
  const Interval t = Interval(curve.scale) * (tube.frequency - Interval(curve.center));
  Interval mean(0.0);
  for (auto term = curve.terms.rbegin(); term != curve.terms.rend(); ++term) {
    mean = mean * t + Interval(term->mean(kError));
  }
  return mean;
}

/// The frequency error on the verified curve, within `distance` of the family.
void read_off(const InvariantTube& tube, SteadyStateBias& bias) {
  using Model = rigor::TaylorModel<2, 5>;
  const bool no_leak = tube.design.without_leak();
  double lowest = kInfinity;
  double lowest_seen = kInfinity;
  double highest = -kInfinity;
  double highest_seen = -kInfinity;
  double largest_error = 0.0;
  bool locked = true;
  const Model omega = Model::variable(tube.frequency, 1);
  for (const CurveCell& cell : tube.cells) {
    const auto error = [&](Eigen::Index row) {
      return rigor::symmetric(
          (Interval(bias.distance) * Interval(cell.reach[static_cast<std::size_t>(row)])).upper());
    };
    const RotatingFrameState<Model> state = tube.curve.at(Model::variable(cell.phase, 0), omega);
    const RotatingFrameState<Model> middle = tube.curve.at(Model(midpoint(cell.phase)), omega);
    const Interval range = state(kError).range() + error(kError);
    const Interval somewhere = middle(kError).range() + error(kError);
    if (!rigor::is_finite(range) || !rigor::is_finite(somewhere)) {
      bias.reason = "the frequency error could not be bounded";
      return;
    }
    lowest = std::min(lowest, range.lower());
    highest = std::max(highest, range.upper());
    lowest_seen = std::min(lowest_seen, somewhere.upper());
    highest_seen = std::max(highest_seen, somewhere.lower());
    largest_error = std::max(largest_error, error(kError).upper());
    locked = locked && rigor::certainly_positive(Interval(1.0) + state(trackers::kDeltaInPhase).range() +
                                                 error(trackers::kDeltaInPhase));
  }
  if (!locked) {
    bias.reason =
        "a steady state is verified, but the tracker is not proved to stay within a quarter turn of the "
        "signal there";
    return;
  }
  if (no_leak) {
    bias.mean_bias = bias.min_error = bias.max_error = Interval(0.0);
  } else {
    bias.mean_bias = mean_error(tube) + rigor::symmetric(largest_error);
    bias.min_error = Interval::from_bounds(lowest, lowest_seen);
    bias.max_error = Interval::from_bounds(highest_seen, highest);
  }
  bias.verdict = Verdict::proved;
  bias.reason = "an invariant curve is verified, and every start near it converges to it";
}

/// The bias from a tube that is verified.
SteadyStateBias bias_in_tube(const ToneModel<Interval>& design, const Interval& frequency,
                             std::size_t most_cells) {
  SteadyStateBias bias;
  bias.frequency = frequency;
  if (!rigor::certainly_less_equal(Interval(0.0), frequency) ||
      !rigor::certainly_less_equal(frequency, Interval(rigor::pi().upper()))) {
    bias.reason = "the frequency is not within [0, pi] rad/sample";
    return bias;
  }
  const auto curve = propose_invariant_curves(
      {midpoint(design.q1), midpoint(design.q2), midpoint(design.r), midpoint(design.epsilon)}, frequency);
  if (!curve) {
    bias.reason = "the simulated tracker does not settle";
    return bias;
  }
  // A curve of many harmonics bends too much for wide cells.
  const std::size_t fewest_cells = curve->terms.front().cosines.size() > kFewHarmonics ? 512 : 128;
  for (std::size_t count = std::min(fewest_cells, most_cells); count <= most_cells; count *= 4) {
    const auto tube = propose_tube(design, frequency, *curve, count);
    if (!tube) {
      bias.reason = "no contracting tube was found around the simulated steady state";
      return bias;
    }
    const TubeVerification verification = verify_tube(*tube);
    bias.reason = verification.reason;
    if (verification.attempt == TubeAttempt::succeeded) {
      bias.rate = verification.rate;
      bias.distance = verification.distance;
      read_off(*tube, bias);
    }
    if (verification.attempt != TubeAttempt::wants_smaller_cells) {
      return bias;
    }
  }
  return bias;
}

}  // namespace

bool settles_exactly(const ToneModel<Interval>& design, const Interval& frequency) {
  return design.without_leak() && rigor::certainly_positive(design.q1) &&
         rigor::certainly_positive(design.q2) && rigor::certainly_positive(design.r) &&
         rigor::certainly_positive(frequency) && rigor::certainly_less(frequency, rigor::pi());
}

SteadyStateBias steady_state_bias(const ToneModel<Interval>& design, const Interval& frequency,
                                  std::size_t most_cells) {
  const rigor::UpwardRounding upward;
  SteadyStateBias bias = bias_in_tube(design, frequency, most_cells);
  if (bias.verdict != Verdict::proved && settles_exactly(design, frequency)) {
    bias.verdict = Verdict::proved;
    bias.rate.reset();
    bias.distance = 0.0;
    bias.mean_bias = bias.min_error = bias.max_error = Interval(0.0);
    bias.reason =
        "without a leak the exact estimate is an exponentially stable steady state at every frequency "
        "between 0 and pi "
        "(docs/single-channel.md, section 2); no rate is verified here: " +
        bias.reason;
  }
  return bias;
}

}  // namespace veritrack::single_channel

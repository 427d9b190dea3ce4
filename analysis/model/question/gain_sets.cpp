#include "analysis/model/question/gain_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/question/found_loop.hpp"
#include "analysis/model/question/largest_value.hpp"
#include "analysis/model/tube/false_lock.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// For a checker that rounds otherwise, rad/sample.
constexpr double kRounding = 1e-13;

/// For a checker whose bounds are cruder, above all of what turns with the signal.
double widened(const GainBounds& gains, double bound) {
  return rigor::mul_up(bound, gains.network().has_ripples ? 1.01 : 1.001);
}

class GainSets {
 public:
  GainSets(const SetQuestion& question, const GainBounds& gains, double half_distance)
      : question_(&question), gains_(&gains), half_distance_(half_distance) {}

  /// The deadline ends the searches for largest values only.
  [[nodiscard]] ProvedSets all() {
    ProvedSets sets;
    sets.starts = set_of(kStarts, {});
    add_bias(sets.starts);
    sets.assumed = set_of(kAssumed, {question_->noise, question_->slew, {}});
    add_starts(*sets.assumed);
    add_reach(sets.starts, {});
    if (question_->largest_noise) {
      sets.noise = largest(kLargestNoise, question_->tracker.amplitude.lower(), &LoopDisturbance::noise,
                           question_->noise);
    }
    if (question_->largest_slew) {
      sets.slew = largest(kLargestSlew, rigor::pi().lower(), &LoopDisturbance::slew, question_->slew);
    }
    if (question_->reach_of_assumed) {
      const LoopDisturbance assumed{question_->noise, question_->slew, {}};
      sets.reach = set_of(kAssumed, assumed);
      add_reach(*sets.reach, assumed);
    }
    if (question_->is_thorough) {
      sets.linear = LinearWorstCase{question_->whole_band.lower(), gains_->linear_error(0.0, 0.0),
                                    gains_->linear_error(question_->noise, question_->slew)};
    }
    return sets;
  }

 private:
  [[nodiscard]] bool is_lock(const std::optional<LoopBounds>& bounds) const {
    return bounds && widened(*gains_, widened(*gains_, bounds->for_ever)) < half_distance_;
  }

  /// What is claimed of a bound, which is 0 without noise.
  [[nodiscard]] double claimed(double bound) const {
    return rigor::add_up(widened(*gains_, bound), kRounding);
  }

  /// For a search, which ends at the deadline.
  [[nodiscard]] std::optional<LoopBounds> tried(const LoopDisturbance& disturbance) const {
    return question_->deadline.is_over() ? std::nullopt : gains_->bounds(disturbance, question_->deadline);
  }

  /// A set for starts in the steady state.
  [[nodiscard]] ProvedSet set_of(const char* name, const LoopDisturbance& disturbance) const {
    ProvedSet set;
    set.tubes.name = name;
    set.tubes.noise = disturbance.noise;
    set.tubes.slew = disturbance.slew;
    set.half_distance = half_distance_;
    set.start_share = 0.5;
    const std::optional<LoopBounds> bounds = gains_->bounds(disturbance);
    set.tubes.is_complete = bounds.has_value();
    if (bounds) {
      set.frequency_error = claimed(bounds->for_ever);
      set.settled_error = claimed(bounds->long_run);
    } else {
      set.tubes.reasons.emplace_back("the bounds of the errors do not close: too much noise or slew");
    }
    return set;
  }

  /// At least the assumed one, where that is a lock: a search ends a little below what it finds.
  [[nodiscard]] ProvedSet largest(const char* name, double most, double LoopDisturbance::*size,
                                  double assumed) const {
    const auto alone = [&](double value) {
      LoopDisturbance disturbance;
      disturbance.*size = value;
      return disturbance;
    };
    double found = largest_with(most, [&](double value) { return is_lock(tried(alone(value))); });
    if (assumed > found && is_lock(gains_->bounds(alone(assumed)))) {
      found = assumed;
    }
    ProvedSet set = set_of(name, alone(found));
    if (!(found > 0.0) && question_->deadline.is_over()) {
      set.tubes.is_complete = false;
      set.tubes.reasons = {kTimeLimit};
    }
    return set;
  }

  /// Without noise the error in the long run is that of the steady state, up to its residual.
  void add_bias(ProvedSet& set) const {
    const std::optional<LoopBounds> bounds = gains_->bounds({});
    if (!bounds) {
      return;
    }
    const Interval& bias = gains_->network().bias;
    const double mean = claimed(bounds->mean);
    set.bias = bias + Interval::from_bounds(-mean, mean);
    const double largest = rigor::sub_up(bounds->long_run, rigor::magnitude(bias));
    set.ripple = rigor::add_up(2.0 * widened(*gains_, largest), kRounding);
  }

  /// The largest frequency error at the start, with the other states in the steady state.
  void add_reach(ProvedSet& set, LoopDisturbance disturbance) const {
    const auto& state = gains_->network().frequency_state;
    if (!state || !set.is_proved()) {
      return;
    }
    const auto from = [&](double error) {
      disturbance.start.assign(gains_->network().a.size(), 0.0);
      const double deviation = rigor::add_up(error, rigor::magnitude(gains_->network().bias));
      disturbance.start[state->first] = rigor::div_up(deviation, state->second);
      return disturbance;
    };
    set.reach = largest_with(rigor::pi().lower(), [&](double error) { return is_lock(tried(from(error))); });
    if (const auto bounds = gains_->bounds(from(set.reach)); set.reach > 0.0 && bounds) {
      set.frequency_error = claimed(bounds->for_ever);
    }
  }

  /// The assumed starts, and their share of the largest ones of their shape.
  void add_starts(ProvedSet& set) {
    LoopDisturbance disturbance{question_->noise, question_->slew, {}};
    if (!question_->assumes_start || !set.is_proved()) {
      return;
    }
    const auto from = [&](double share) {
      disturbance.start.clear();
      for (const Interval& each : question_->deviations) {
        disturbance.start.push_back(rigor::mul_up(share, each.upper()));
      }
      return disturbance;
    };
    if (const auto bounds = gains_->bounds(from(1.0))) {
      set.frequency_error = claimed(bounds->for_ever);
      set.settled_error = claimed(bounds->long_run);
      return;
    }
    const double share = largest_with(1.0, [&](double each) { return tried(from(each)).has_value(); });
    set.start_share = share > 0.0 ? 1.0 / share : INFINITY;
  }

  const SetQuestion* question_;
  const GainBounds* gains_;
  double half_distance_;
};

/// With entries that the checker may know less exactly, where that is enough.
std::optional<linear::RadiusBounds> radius_of(const std::vector<linear::Row>& a) {
  const auto crude = linear::spectral_radius_bounds(linear::with_room(a));
  return crude ? crude : linear::spectral_radius_bounds(a);
}

ProvedSets unstable(GainProof proof) {
  ProvedSets sets;
  sets.starts.tubes.name = kStarts;
  sets.starts.tubes.reasons.emplace_back(
      fmt::format("its steady state is unstable: to first order, an error about it grows by "
                  "a factor of {:.4g} or more each sample",
                  proof.radius->lower));
  sets.assumed = sets.starts;
  sets.assumed->tubes.name = kAssumed;
  sets.gains = std::move(proof);
  return sets;
}

/// The gains with the noise of a sample as one input, where their bound in the long run is clearly better:
/// for a loop that multiplies a sample by an earlier one. Each wave with a noise of its own has fewer
/// remainders.
std::optional<GainBounds> with_shared_noise(const SetQuestion& question, const FoundLoop& found,
                                            const GainBounds& gains, const LoopDisturbance& assumed) {
  constexpr double kClearly = 0.95;
  if (question.tracker.recursion->samples != 2 || !(question.noise > 0.0)) {
    return std::nullopt;
  }
  std::optional<GainBounds> shared =
      GainBounds::make(loop_network(question.tracker, found.steady, question.whole_band, true),
                       gains.samples(), gains.blocks());
  const std::optional<LoopBounds> bounds = shared ? shared->bounds(assumed) : std::nullopt;
  const std::optional<LoopBounds> separate = bounds ? gains.bounds(assumed) : std::nullopt;
  const bool is_better = bounds && (!separate || bounds->long_run < kClearly * separate->long_run);
  return is_better ? std::move(shared) : std::nullopt;
}

/// The rounding of the program while its states are as far from the steady state as they come without it, and
/// half as far again. Throws NoRounding.
LoopRounding rounding_of(const SetQuestion& question, const FoundLoop& found, const GainBounds& gains,
                         const ProvedSets& sets, const LoopDisturbance& assumed) {
  constexpr double kSpare = 1.5;
  const std::size_t n = found.steady.size();
  if (gains.network().has_ripples) {
    throw NoRounding("in one channel it is known over the phases");
  }
  LoopNetwork network = gains.network();
  add_rounding(network, {std::vector<double>(n, INFINITY), std::vector<double>(n, 0.0), 0.0, question.turned,
                         question.tracker.amplitude.upper(), INFINITY});
  const std::optional<GainBounds> probe =
      GainBounds::make(std::move(network), gains.samples(), gains.blocks());
  if (!probe) {
    throw NoRounding("errors of its states may not decay");
  }
  std::vector<LoopDisturbance> worst{assumed};
  if (sets.noise && sets.noise->is_proved()) {
    // What turns the samples takes a part of it.
    const double of_samples = question.turned * question.tracker.amplitude.upper();
    worst.push_back(
        {std::max(0.0, (sets.noise->tubes.noise - 1.001 * of_samples) / (1.0 + question.turned)), 0.0, {}});
  }
  if (const auto& state = gains.network().frequency_state; state && sets.starts.reach > 0.0) {
    worst.push_back({0.0, 0.0, std::vector<double>(n, 0.0)});
    worst.back().start[state->first] = rigor::div_up(
        rigor::add_up(sets.starts.reach, rigor::magnitude(gains.network().bias)), state->second);
  }
  std::vector<double> room(n, 0.0);
  for (const LoopDisturbance& each : worst) {
    const std::optional<LoopBounds> bounds = probe->bounds(each);
    for (std::size_t i = 0; bounds && i < n; ++i) {
      room[i] = std::max(room[i], bounds->states[i]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const SteadyValue& each = found.steady[i];
    const double size =
        std::fabs(each.constant) + std::fabs(each.per_frequency * question.whole_band.upper());
    room[i] = question.tracker.recursion->is_angle[i] ? INFINITY : kSpare * room[i] + 0x1p-10 * size;
  }
  LoopRounding rounding = rounding_within(std::move(room), question.rounding, question.tracker, found.steady,
                                          question.whole_band);
  rounding.turned = question.turned;
  return rounding;
}

}  // namespace

double samples_below(const GainProof& proof, const Interval& target) {
  if (!proof.assumed) {
    return INFINITY;
  }
  const std::vector<double>& errors = proof.assumed->from_block;
  for (std::size_t block = 0; block < errors.size(); ++block) {
    if (rigor::certainly_less(Interval(widened(*proof.gains, errors[block])), target)) {
      const std::size_t length = proof.gains->samples() / proof.gains->blocks();
      return static_cast<double>(block * length);
    }
  }
  return INFINITY;
}

bool is_near_linear(const ProvedSets& by_gains) {
  constexpr double kNear = 1.6;
  const GainProof& proof = by_gains.gains.value();
  if (!proof.gains) {
    return true;
  }
  const LoopDisturbance& assumed = proof.disturbance;
  return proof.assumed &&
         proof.assumed->long_run <= kNear * proof.gains->linear_error(assumed.noise, assumed.slew);
}

std::optional<ProvedSets> prove_by_gains(const SetQuestion& question, NoGains* reason) {
  constexpr std::size_t kBlocks = 64;
  constexpr double kTail = 1e-8;
  // rad/sample. Sentences speak of the steady state: what the listed one is off may not show. Half of what
  // the checker allows.
  constexpr double kMostOfResidual = 0x1p-19;
  constexpr std::size_t kMostSamples = 1U << 20U;
  const Interval& band = question.whole_band;
  // One channel does not tell a frequency from its negative.
  const bool is_one = question.tracker.recursion->samples == 1;
  const auto nothing = [&](NoGains::Kind kind, const char* detail = "") -> std::optional<ProvedSets> {
    if (reason != nullptr) {
      *reason = {kind, detail};
    }
    return std::nullopt;
  };
  if (!question.allows_gains || question.tracker.filter != nullptr) {
    return nothing(NoGains::Kind::question);
  }
  if ((is_one && !(band.lower() > 0.0)) || !(std::max(band.upper(), -band.lower()) <= rigor::pi().upper())) {
    return nothing(NoGains::Kind::band);
  }
  try {
    std::optional<FoundLoop> found = find_loop(question);
    if (!found) {
      return nothing(NoGains::Kind::steady_state);
    }
    // To first order what turns with the signal changes with the errors, and so does an amplitude: then there
    // is no one matrix.
    const bool is_constant =
        !found->network.has_ripples && !found->network.may_rest_at_kink && !question.tracker.amplitude_varies;
    const std::optional<linear::RadiusBounds> radius =
        is_constant ? radius_of(found->network.a) : std::nullopt;
    if (radius && radius->lower > 1.0) {
      return unstable({found->steady, radius, std::nullopt, {}, std::nullopt});
    }
    const auto samples = linear::proposed_horizon(found->network.a, kBlocks, kTail, kMostSamples);
    std::optional<GainBounds> gains;
    if (samples) {
      gains = GainBounds::make(std::move(found->network), *samples, kBlocks);
    }
    if (!gains || !gains->bounds({})) {
      return nothing(NoGains::Kind::bounds);
    }
    if (!(gains->residual_error() <= kMostOfResidual)) {
      return nothing(NoGains::Kind::residual);
    }
    const double half_distance = half_distance_to_false_lock(question.tracker, band);
    LoopDisturbance assumed{question.noise, question.slew, {}};
    for (const Interval& each : question.deviations) {
      assumed.start.push_back(each.upper());
    }
    if (std::optional<GainBounds> shared = with_shared_noise(question, *found, *gains, assumed)) {
      gains = std::move(shared);
    }
    ProvedSets sets = GainSets(question, *gains, half_distance).all();
    std::optional<LoopRounding> rounding;
    if (question.rounding) {
      try {
        rounding = rounding_of(question, *found, *gains, sets, assumed);
        LoopNetwork network = gains->network();
        add_rounding(network, *rounding);
        std::optional<GainBounds> rounded = GainBounds::make(std::move(network), *samples, kBlocks);
        if (!rounded || !rounded->bounds({})) {
          throw NoRounding("its bounds do not close with it");
        }
        gains = std::move(rounded);
        sets = GainSets(question, *gains, half_distance).all();
      } catch (const NoRounding& missed) {
        rounding.reset();
        sets.no_rounding = missed.what();
      }
    }
    sets.gains = GainProof{found->steady, radius, *gains, assumed, gains->bounds(assumed), rounding};
    return sets;
  } catch (const NoFrame& objection) {
    return nothing(NoGains::Kind::structure, objection.what());
  }
}

}  // namespace veritrack::model

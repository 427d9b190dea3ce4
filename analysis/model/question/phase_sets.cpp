#include "analysis/model/question/phase_sets.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/phase_loop.hpp"
#include "analysis/model/question/largest_value.hpp"
#include "analysis/model/tube/false_lock.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

/// For a checker whose bounds are cruder.
double with_room(double bound) {
  return rigor::mul_up(bound, 1.025);
}

class PhaseSets {
 public:
  /// `exact`: the same in exact arithmetic, where the program rounds.
  PhaseSets(const SetQuestion& question, const PhaseLoop& loop, double half_distance, KnownLimits known,
            const PhaseSets* exact = nullptr)
      : question_(&question), loop_(&loop), half_distance_(half_distance), known_(known), exact_(exact) {}

  /// Empty where no bounds close without noise. Those for the assumed noise and slew need not close.
  [[nodiscard]] std::optional<PhaseProof> all() {
    const LoopDisturbance assumed{question_->noise, 0.0, {}};
    closes_for_assumed_ = loop_->probe().errors(assumed).has_value();
    if (!closes_for_assumed_ && !question_->largest_noise) {
      return std::nullopt;
    }
    if (closes_for_assumed_) {
      find_joint();
    }
    return find_sizes() ? std::optional(proof()) : std::nullopt;
  }

  /// The bounds of some part alone, from which room() follows. False where none close without noise.
  [[nodiscard]] bool look() {
    const PhaseGains& probe = loop_->probe();
    still_ = probe.errors({});
    if (!still_) {
      return false;
    }
    closes_for_assumed_ = probe.errors({question_->noise, 0.0, {}}).has_value();
    if (closes_for_assumed_) {
      find_joint();
    }
    find_largest();
    OfPart part;
    (void)find_part(probe, part);
    assumed_ = assumed_ ? assumed_ : part.assumed;
    from_starts_ = from_starts_ ? from_starts_ : part.from_starts;
    at_noise_ = part.at_noise;
    at_reach_ = part.at_reach;
    return true;
  }

  /// Whether the deadline was over before all parts had their bounds.
  [[nodiscard]] bool was_stopped() const { return was_stopped_; }

  /// How far each state may be from the curve for a program that rounds: half as far again as in all of
  /// these.
  [[nodiscard]] std::vector<double> room() const {
    constexpr double kSpare = 1.5;
    const trackers::Recursion& recursion = *question_->tracker.recursion;
    std::vector<double> room(static_cast<std::size_t>(recursion.states), INFINITY);
    for (std::size_t i = 0; i < room.size(); ++i) {
      if (recursion.is_angle[i]) {
        continue;
      }
      double most = 0.0;
      for (const auto* each : {&still_, &assumed_, &from_starts_, &at_noise_, &at_reach_}) {
        most = std::max(most, *each ? (*each)->states.at(i) : 0.0);
      }
      room[i] = kSpare * most + 0x1p-10 * size_of_state(i);
    }
    return room;
  }

 private:
  /// The bounds that are asked of each part at a constant frequency.
  struct OfPart {
    std::optional<PhaseErrors> still, assumed, from_starts, at_noise, at_reach;
    double noise = 0.0, reach = 0.0;
  };

  [[nodiscard]] bool is_lock(const std::optional<PhaseErrors>& errors) const {
    return errors && with_room(with_room(errors->for_ever)) < half_distance_;
  }
  [[nodiscard]] std::vector<double> start_of(double share) const {
    std::vector<double> start;
    for (const Interval& each : question_->deviations) {
      start.push_back(rigor::mul_up(share, each.upper()));
    }
    return start;
  }
  /// The start in which the frequency is off by this; empty where the frequency is no multiple of one state.
  [[nodiscard]] static std::vector<double> start_with(const PhaseGains& gains, double error) {
    const auto state = gains.frequency_state();
    const double factor = state ? rigor::mignitude(state->second) : 0.0;
    if (!(factor > 0.0)) {
      return {};
    }
    std::vector<double> start(gains.states(), 0.0);
    const double off = rigor::add_up(gains.largest_bias(), gains.rounding_of_frequency());
    start[state->first] = rigor::div_up(rigor::add_up(error, off), factor);
    return start;
  }
  [[nodiscard]] std::optional<PhaseErrors> from_error(const PhaseGains& gains, double error) const {
    const std::vector<double> start = start_with(gains, error);
    return start.empty() ? std::nullopt : gains.errors({0.0, 0.0, start});
  }

  /// With the assumed slew.
  void find_joint() {
    if (question_->slew > 0.0) {
      if (const auto joint = loop_->with_slew(question_->slew)) {
        assumed_ = joint->errors({question_->noise, question_->slew, {}});
        if (question_->assumes_start) {
          from_starts_ = joint->errors({question_->noise, question_->slew, start_of(1.0)});
        }
      }
    }
  }

  /// From this value down to one with this property: steps are small.
  static double down_to(double value, const std::function<bool(double)>& holds) {
    constexpr double kStep = 0.97;
    constexpr int kSteps = 100;
    for (int i = 0; i < kSteps; ++i, value *= kStep) {
      if (holds(value)) {
        return value;
      }
    }
    return 0.0;
  }

  bool find_part(const PhaseGains& gains, OfPart& part) const {
    part.still = gains.errors({});
    if (!part.still) {
      return false;
    }
    const bool moves = question_->slew > 0.0;
    if (!moves && closes_for_assumed_) {
      part.assumed = question_->noise > 0.0 ? gains.errors({question_->noise, 0.0, {}}) : part.still;
      if (part.assumed && question_->assumes_start) {
        part.from_starts = gains.errors({question_->noise, 0.0, start_of(1.0)});
      }
    }
    if (question_->largest_noise && probed_noise_ > known_.noise) {
      part.noise = down_to(probed_noise_, [&](double noise) {
        part.at_noise = gains.errors({noise, 0.0, {}});
        return is_lock(part.at_noise);
      });
    }
    if (probed_reach_ > known_.reach) {
      part.reach = down_to(probed_reach_, [&](double error) {
        part.at_reach = from_error(gains, error);
        return is_lock(part.at_reach);
      });
    }
    return true;
  }

  static void join(std::optional<PhaseErrors>& all, const std::optional<PhaseErrors>& one, bool is_first) {
    if (is_first || !one) {
      all = one;
    } else if (all) {
      all->join(*one);
    }
  }

  /// Noise and reach of some part.
  void find_largest() {
    const PhaseGains& probe = loop_->probe();
    constexpr int kSteps = 7;
    if (question_->largest_noise) {
      const double amplitude = question_->tracker.amplitude.lower();
      const double most = question_->rounding ? rigor::mul_down(kMostNoise, amplitude) : amplitude;
      probed_noise_ = largest_with(
          most,
          [&](double noise) {
            return is_lock(probe.errors({noise, 0.0, {}}));
          },
          kSteps);
    }
    probed_reach_ = largest_with(
        half_distance_, [&](double error) { return is_lock(from_error(probe, error)); }, kSteps);
  }

  /// At a constant frequency. False where some part has no bounds.
  bool find_sizes() {
    find_largest();
    std::vector<OfPart> parts(loop_->parts());
    const bool is_done = loop_->for_each_part([&](std::size_t number, const PhaseGains& gains) {
      if (question_->deadline.is_over()) {
        was_stopped_ = true;
        return false;
      }
      return find_part(gains, parts[number]);
    });
    if (!is_done) {
      return false;
    }
    const bool moves = question_->slew > 0.0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const OfPart& part = parts[p];
      join(still_, part.still, p == 0);
      if (!moves) {
        join(assumed_, part.assumed, p == 0);
        join(from_starts_, part.from_starts, p == 0);
      }
      join(at_noise_, part.at_noise, p == 0);
      join(at_reach_, part.at_reach, p == 0);
      noise_ = p == 0 ? part.noise : std::min(noise_, part.noise);
      reach_ = p == 0 ? part.reach : std::min(reach_, part.reach);
    }
    return true;
  }

  [[nodiscard]] double size_of_state(std::size_t state) const {
    double most = 0.0;
    for (const FloquetCell& cell : loop_->cells()) {
      double size = 0.0;
      for (const auto& of_harmonic : cell.curve.curve[state].coefficients) {
        for (const std::complex<double>& each : of_harmonic) {
          size += std::abs(each);
        }
      }
      most = std::max(most, size);
    }
    return most;
  }

  /// The effect of the curve's distance from a steady state: remainders over cells of phases, and the
  /// rounding of this program. The bounds of two programs may differ by as much.
  [[nodiscard]] double slack() const {
    return exact_ != nullptr ? exact_->slack() : std::max(0.0, still_->for_ever - still_->bias);
  }
  [[nodiscard]] double claimed(double bound) const { return rigor::add_up(with_room(bound), slack()); }

  [[nodiscard]] ProvedSet set_of(const char* name, const LoopDisturbance& disturbance,
                                 const std::optional<PhaseErrors>& errors) const {
    ProvedSet set;
    set.proof = ProvedSet::Proof::gains;
    set.tubes.name = name;
    set.tubes.noise = disturbance.noise;
    set.tubes.slew = disturbance.slew;
    set.half_distance = half_distance_;
    set.start_share = 0.5;
    set.tubes.is_complete = errors.has_value();
    if (errors) {
      set.frequency_error = claimed(errors->for_ever);
      set.settled_error = claimed(errors->long_run);
    } else {
      set.tubes.reasons.emplace_back("the bounds of the errors do not close: too much noise or slew");
    }
    return set;
  }

  [[nodiscard]] PhaseProof proof() const {
    constexpr double kRoom = 0.975;
    PhaseProof proof{loop_->cells(),
                     loop_->gridding(),
                     assumed_ ? *assumed_ : *still_,
                     set_of(kStarts, {}, still_),
                     {},
                     {},
                     {},
                     {}};
    ProvedSet& starts = proof.starts;
    const double width = with_room(still_->ripple);
    const double room = 0.03 * width + 2.0 * slack() + 1e-13;  // they may be little else
    starts.bias = still_->mean + Interval::from_bounds(-room, room);
    starts.ripple = rigor::add_up(width, 4.0 * slack() + 1e-13);
    if (reach_ > 0.0 && at_reach_) {
      starts.reach = kRoom * reach_;
      starts.frequency_error = claimed(at_reach_->for_ever);
    }
    proof.assumed = set_of(kAssumed, {question_->noise, question_->slew, {}}, assumed_);
    if (question_->assumes_start) {
      proof.assumed.start_share = INFINITY;
      if (from_starts_) {
        proof.errors = *from_starts_;
        proof.assumed.start_share = 1.0;
        proof.assumed.frequency_error = claimed(from_starts_->for_ever);
        proof.assumed.settled_error = claimed(from_starts_->long_run);
      }
    }
    for (double& error : proof.errors.from_block) {
      error = claimed(error);
    }
    if (question_->largest_noise && noise_ > 0.0) {
      proof.noise = set_of(kLargestNoise, {kRoom * noise_, 0.0, {}}, at_noise_);
    }
    return proof;
  }

  const SetQuestion* question_;
  const PhaseLoop* loop_;
  double half_distance_;
  KnownLimits known_;
  const PhaseSets* exact_;
  bool closes_for_assumed_ = false;
  std::atomic<bool> was_stopped_ = false;  // parts are worked on in parallel
  double probed_noise_ = 0.0, probed_reach_ = 0.0;
  std::optional<PhaseErrors> still_, assumed_, from_starts_, at_noise_, at_reach_;
  double noise_ = 0.0, reach_ = 0.0;
};

/// The same of the program that runs. Throws NoRounding.
PhaseProof rounded_proof(const SetQuestion& question, PhaseLoop& loop, double half_distance,
                         KnownLimits known) {
  if (!(question.noise <= rigor::mul_down(kMostNoise, question.tracker.amplitude.lower()))) {
    throw NoRounding("the noise may be as large as the signal");
  }
  PhaseSets exact(question, loop, half_distance, known);
  if (question.turned > 0.0) {
    throw NoRounding("it has an arc tangent of its own");
  }
  if (!exact.look()) {
    throw NoRounding("its bounds do not close");
  }
  std::vector<double> room = exact.room();
  if (!loop.round({room, question.rounding})) {
    throw NoRounding("errors of its states may not decay");
  }
  PhaseSets sets(question, loop, half_distance, known, &exact);
  std::optional<PhaseProof> proof = sets.all();
  if (!proof) {
    throw NoRounding(sets.was_stopped() ? "time was over" : "its bounds do not close with it");
  }
  proof->room = std::move(room);
  return *std::move(proof);
}

}  // namespace

double samples_below(const PhaseProof& proof, const Interval& target) {
  const std::vector<double>& errors = proof.errors.from_block;
  const std::size_t length = proof.gridding.lags / PhaseKernels::kBlocks;
  for (std::size_t block = 0; block < errors.size(); ++block) {
    if (rigor::certainly_less(Interval(errors[block]), target)) {
      return static_cast<double>(block * length);
    }
  }
  return INFINITY;
}

std::optional<PhaseProof> prove_by_phase_gains(const SetQuestion& question, KnownLimits known,
                                               NoGains* reason) {
  const Interval& band = question.whole_band;
  const auto nothing = [&](NoGains::Kind kind, const char* detail = "") -> std::optional<PhaseProof> {
    if (reason != nullptr) {
      *reason = {kind, detail};
    }
    return std::nullopt;
  };
  if (!question.allows_phase_gains) {
    return nothing(NoGains::Kind::question);
  }
  if (!(band.lower() > 0.0) || !(band.upper() < rigor::pi().lower())) {
    return nothing(NoGains::Kind::band);
  }
  try {
    const ProgramRounding none{
        std::vector<double>(static_cast<std::size_t>(question.tracker.recursion->states), INFINITY), {}};
    TrackerModel tracker = question.tracker;
    tracker.rounding = question.rounding ? &none : nullptr;
    const PhaseLoop loop =
        PhaseLoop::make(tracker, question.tone, band, question.slew > 0.0, question.deadline);
    const double half_distance = half_distance_to_false_lock(question.tracker, band);
    std::string no_rounding;
    if (question.rounding) {
      try {
        PhaseLoop rounded = loop;
        return rounded_proof(question, rounded, half_distance, known);
      } catch (const NoRounding& missed) {
        no_rounding = missed.what();
      }
    }
    PhaseSets sets(question, loop, half_distance, known);
    auto proof = sets.all();
    if (proof) {
      proof->no_rounding = std::move(no_rounding);
    }
    return proof                ? std::move(proof)
           : sets.was_stopped() ? nothing(NoGains::Kind::time, "the bounds of its errors were found")
                                : nothing(NoGains::Kind::bounds);
  } catch (const NoTime& missed) {
    return nothing(NoGains::Kind::time, missed.what());
  } catch (const NoFrame& objection) {
    return nothing(NoGains::Kind::structure, objection.what());
  }
}

}  // namespace veritrack::model

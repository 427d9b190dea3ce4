#include "certificates/model/model_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/model/band_part.hpp"
#include "certificates/model/loop_claims.hpp"
#include "certificates/model/model_limits.hpp"
#include "certificates/model/model_lock.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/model_words.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using model::ProvedSet;
using rigor::Interval;
using rigor::Verdict;

/// The frequencies for which a set is proved.
struct Scope {
  bool is_any = false;
  std::optional<BandPart> part;  ///< of the band; none: all of it
};

std::string above(double value) {
  return rigor::to_decimal(value, 4, rigor::Direction::up);
}
std::string below(double value) {
  return rigor::to_decimal(value, 4, rigor::Direction::down);
}

/// Sentences, and the sets that decide them.
class ModelClaims {
 public:
  explicit ModelClaims(Certificate& certificate)
      : certificate_(&certificate),
        tables_(&model_tables(certificate.design)),
        sets_(&model_sets(certificate)),
        deciding_(&sets_->best()),
        words_(words_for(std::nullopt, *deciding_)),
        units_(tables_->assume.sample_rate) {}

  void add_told() {
    if (is_gaussian()) {
      add_lock_claims(*certificate_);
    }
    if (const Scope scope = scope_of(*deciding_); scope.is_any && keeps_starts() && !is_gaussian()) {
      const ModelWords words = words_for(scope.part, *deciding_);
      Claim claim = reported("model/guarantee", words.assumed_tone() + words.noise() +
                                                    words.start(sets_->assumed ? "assumed" : "starts"));
      const std::string bound = above(deciding_->frequency_error);
      claim.values = {{"frequency_error", bound}};
      add_part(claim, scope.part);
      claim.statement +=
          fmt::format(", the frequency error stays at or below {} for ever", units_.at_most(bound));
      // A bound in the long run that is no smaller than the bound at every sample adds nothing.
      if (settled_error() < deciding_->frequency_error && above(settled_error()) != bound && settles()) {
        const std::string settled = above(settled_error());
        claim.values.emplace_back("settled_frequency_error", settled);
        claim.statement += fmt::format(", and at or below {} in the long run", units_.at_most(settled));
      }
      add(by(*deciding_, std::move(claim)));
    }
    if (const Scope scope = scope_of(*deciding_);
        scope.is_any && captures_start() && names_lock(*deciding_)) {
      add_capture(*sets_->capture, scope.part);
    }
    if (sets_->gains && sets_->gains->radius) {
      add_stability(*sets_->gains->radius);
    }
    if (const auto limits = limits_of(*sets_, tables_->assume)) {
      add_limits(*limits);
    }
    if (const auto limit = slew_limit_of(*sets_, tables_->assume)) {
      add_slew_limit(*limit);
    }
    const ProvedSet& starts = settled_set();
    if (const Scope scope = scope_of(starts); scope.is_any && knows_bias()) {
      const ModelWords words = words_for(scope.part, starts);
      Claim claim = reported("model/steady-state",
                             words.constant_tone() + ", without noise, " + words.started_in("starts"));
      const std::string low = below(starts.bias.lower());
      const std::string high = above(starts.bias.upper());
      constexpr int kDigits = 6;  // so that a large one is as exact as it is known
      const std::string ripple = rigor::to_decimal(starts.ripple, kDigits, rigor::Direction::up);
      claim.values = {{"bias_low", low}, {"bias_high", high}, {"ripple", ripple}};
      add_part(claim, scope.part);
      claim.statement += fmt::format(
          ", the mean over the phase of the frequency error in the long run is between {}, and the error "
          "varies "
          "by at most {} over the phase",
          units_.between(low, high), units_.at_most(ripple));
      add(by(starts, std::move(claim)));
    }
  }

  void add_required() {
    if (tables_->require.sets.probability_of_losing_lock_below) {
      certificate_->claims.push_back(required_lock_claim(*certificate_));
    }
    const ModelRequirements& require = tables_->require;
    const Requirements& sets = require.sets;
    const std::string assumed = words_.assumed_tone() + words_.noise();
    if (const auto& number = sets.frequency_error_below) {
      Claim claim = required("model/frequency-error-bound", *number,
                             assumed + words_.start(sets_->assumed ? "assumed" : "starts"),
                             "the frequency error stays below {} for ever", frequency_words);
      const bool is_met =
          keeps_starts() && rigor::certainly_less(Interval(deciding_->frequency_error), number->value);
      claim = by(*deciding_, std::move(claim));
      decide(claim, guaranteed(), deciding_->frequency_error, *number, "The proved bound is {} rad/sample",
             guarantee_objection(is_met));
    }
    if (sets.settles_within) {
      add(by(*deciding_, settling(assumed)));
    }
    if (const auto& number = require.captured_within) {
      add(captured(*number));
    }
    if (const auto& number = sets.largest_noise_at_least) {
      const auto say = [&](const std::string& in_lock) {
        return required("model/largest-noise", *number, words_.constant_tone(),
                        "the tracker tolerates noise up to {}: a certified invariant set exists" + in_lock);
      };
      decide_size(say, largest_noise(*sets_), *number, "The largest noise that was proved is {}",
                  objection_to_size(sets_->noise, &model::TubeSet::noise, "noise"));
    }
    if (const auto& number = sets.largest_slew_at_least) {
      const auto say = [&](const std::string& in_lock) {
        return required("model/largest-slew", *number,
                        words_.tone_with("a frequency that stays in " + words_.band()) + ", without noise",
                        "the tracker tolerates a slew up to {}: a certified invariant set exists" + in_lock,
                        slew_words);
      };
      decide_size(say, largest_slew(*sets_), *number, "The largest slew that was proved is {}",
                  objection_to_size(sets_->slew, &model::TubeSet::slew, "slew"));
    }
    if (const auto& number = sets.frequency_error_radius_at_least) {
      const auto say = [&](const std::string& in_lock) {
        return required(
            "model/frequency-error-radius", *number, assumed,
            "a certified invariant set" + in_lock + " contains frequency errors up to {} at every phase",
            frequency_words);
      };
      const ProvedSet* set = sets_->reach ? &*sets_->reach : deciding_;
      decide_size(say, {covers_assumptions() ? set->reach : 0.0, set}, *number,
                  "The certified set reaches {} rad/sample", assumption_objection());
    }
    add_required_steady_state(require);
    add_loop_claims(*certificate_);
    conclude_requirements(*certificate_);
  }

 private:
  /// Bias and ripple.
  void add_required_steady_state(const ModelRequirements& require) {
    const ModelWords words = words_for(std::nullopt, settled_set());
    const std::string settled = words.constant_tone() + ", without noise, " + words.started_in("starts");
    if (const auto& number = require.bias_below) {
      Claim claim =
          required("model/bias", *number, "", "the mean frequency error is at most {}", frequency_words);
      claim.statement = fmt::format(
          "{}, the mean over the phase of the frequency error in the long run is at most {} in "
          "absolute value.",
          settled, frequency_words(*number));
      const Interval& bias = settled_set().bias;
      const double largest = std::max(bias.upper(), -bias.lower());
      const bool is_met = knows_bias() && rigor::certainly_less_equal(Interval(largest), number->value);
      claim = by(settled_set(), std::move(claim));
      decide(claim, has_bias(), largest, *number, "The proved bound of the mean is {} rad/sample",
             objection_of(settled_set(), is_met), true);
    }
    if (const auto& number = require.ripple_below) {
      Claim claim =
          required("model/ripple", *number, "", "the frequency error varies by at most {}", frequency_words);
      claim.statement =
          fmt::format("{}, the frequency error in the long run varies by at most {} over the phase.", settled,
                      frequency_words(*number));
      const bool is_met =
          knows_bias() && rigor::certainly_less_equal(Interval(settled_set().ripple), number->value);
      claim = by(settled_set(), std::move(claim));
      decide(claim, has_bias(), settled_set().ripple, *number, "It varies by at most {} rad/sample",
             objection_of(settled_set(), is_met), true);
    }
  }

  /// For a part of the band.
  [[nodiscard]] ModelWords words_for(std::optional<BandPart> part, const ProvedSet& set) const {
    const ModelWords words(*tables_, std::move(part), sets_->starts_in(set));
    const bool is_by_phases = !sets_->gains && set.proof == ProvedSet::Proof::gains;
    return (sets_->gains && sets_->gains->rounding) ||
                   (is_by_phases && sets_->phases && !sets_->phases->room.empty())
               ? words.rounded()
               : words;
  }
  static Claim reported(const char* id, const std::string& hypotheses) {
    Claim claim;
    claim.id = id;
    claim.hypotheses = hypotheses;
    claim.statement = hypotheses;
    claim.verdict = Verdict::proved;
    return claim;
  }
  /// Beside tubes, a claim by another proof says so.
  [[nodiscard]] Claim by(const ProvedSet& set, Claim claim) const {
    if (!sets_->gains && set.is_without_tubes()) {
      claim.values.emplace_back("by", set.proof == ProvedSet::Proof::averages ? "averages" : "gains");
    }
    return claim;
  }
  /// " (by the set "assumed" of the certificate)", for a set that was made for something else.
  [[nodiscard]] std::string by_set(const ProvedSet& set, const char* usual) const {
    return sets_->gains || set.is_without_tubes() || set.tubes.name == usual
               ? std::string()
               : fmt::format(" (by the set \"{}\" of the certificate)", set.tubes.name);
  }
  /// The stability of the linear recursion of a loop that is certified by gains.
  void add_stability(const linear::RadiusBounds& proved) {
    const linear::RadiusBounds radius = linear::with_room(proved);
    const ModelWords exact(*tables_, std::nullopt, sets_->starts_in(*deciding_));
    Claim claim = reported("model/stability", exact.constant_tone() + ", without noise");
    if (radius.upper < 1.0) {
      const std::string decay = rigor::to_decimal(radius.upper, 8, rigor::Direction::up);
      claim.values = {{"decay", decay}};
      claim.statement += fmt::format(
          ", the steady state of the certificate is stable: to first order, errors about it shrink in the "
          "long run by "
          "a factor of at most {} each sample",
          decay);
    } else if (radius.lower > 1.0) {
      const std::string growth = below(radius.lower);
      claim.values = {{"growth", growth}};
      claim.verdict = Verdict::refuted;
      claim.finding = "the steady state of the certificate is stable";
      claim.statement += fmt::format(
          ", the steady state of the certificate is stable: to first order, no error about it grows by a "
          "factor of {} "
          "or more each sample",
          growth);
    } else {
      return;
    }
    add(claim);
  }
  /// The grid is evidence: where the checker begins.
  void add_capture(const ModelCapture& capture, const std::optional<BandPart>& part) {
    const ModelWords words = words_for(part, *deciding_);
    const std::string samples = fmt::format("{}", capture.samples);
    Claim claim = reported("model/capture", words.constant_tone() + words.noise() + words.started_exactly());
    claim.values = {{"samples", samples}};
    claim.statement +=
        fmt::format(", the tracker is in the set \"{}\" of the certificate after at most {} samples",
                    deciding_name(), samples);
    if (std::isfinite(capture.frequency_error)) {
      const std::string before = above(capture.frequency_error);
      claim.values.emplace_back("frequency_error_before", before);
      claim.statement +=
          fmt::format(", with a frequency error of at most {} until then", units_.at_most(before));
    }
    const std::string after = above(deciding_->frequency_error);
    claim.values.emplace_back("frequency_error", after);
    claim.statement +=
        fmt::format(", and the frequency error stays at or below {} for ever after", units_.at_most(after));
    claim.values.emplace_back("phases", fmt::format("{}", capture.phases));
    claim.values.emplace_back("frequencies", fmt::format("{}", capture.frequencies));
    add_part(claim, part);
    add(claim);
  }
  void add_limits(const ModelLimits& limits) {
    Claim claim = reported("model/limits", words_for(limits.part, *limits.noise.set).constant_tone());
    const std::string noise = below(limits.noise.size);
    claim.values = {{"noise", noise}, {"frequency_error", above(limits.noise.set->frequency_error)}};
    claim.statement +=
        fmt::format(", the tracker tolerates noise up to {}{}: a certified invariant set exists{}", noise,
                    by_set(*limits.noise.set, "noise"), in_lock(*limits.noise.set));
    if (limits.reach.set != nullptr && limits.reach.set->proof != limits.noise.set->proof) {
      add_part(claim, limits.part);
      add(by(*limits.noise.set, std::move(claim)));
      add_reach(limits);
      return;
    }
    if (limits.reach.set != nullptr) {
      const std::string reach = below(limits.reach.size);
      const std::string within = above(limits.reach.set->frequency_error);
      claim.values.emplace_back("reach", reach);
      claim.values.emplace_back("reach_frequency_error", within);
      claim.statement += fmt::format(
          ", and without noise a certified invariant set in which it stays at or below {} contains frequency "
          "errors up to {} at every phase",
          units_.at_most(within), units_.at_least(reach));
    }
    add_part(claim, limits.part);
    add(by(*limits.noise.set, std::move(claim)));
  }
  /// The reach alone, where it is proved in another way than the noise.
  void add_reach(const ModelLimits& limits) {
    const ProvedSet& set = *limits.reach.set;
    const std::string reach = below(limits.reach.size);
    const std::string within = above(set.frequency_error);
    Claim claim = reported("model/reach", words_for(limits.part, set).constant_tone() + ", without noise");
    claim.values = {{"reach", reach}, {"frequency_error", within}};
    claim.statement += fmt::format(
        ", a certified invariant set in which the frequency error stays at or below {} contains frequency "
        "errors up to {} at every phase",
        units_.at_most(within), units_.at_least(reach));
    add_part(claim, limits.part);
    add(by(set, std::move(claim)));
  }
  /// The noise of the set that tolerates this slew is tolerated together with it.
  void add_slew_limit(const SlewLimit& limit) {
    const ModelWords words = words_for(limit.part, *limit.slew.set);
    Claim claim = reported("model/slew-limit", words.tone_with("a frequency that stays in " + words.band()));
    const ProvedSet& set = *limit.slew.set;
    const std::string slew = below(limit.slew.size);
    claim.values = {{"slew", slew}, {"frequency_error", above(set.frequency_error)}};
    if (set.tubes.noise > 0.0) {
      const std::string noise = below(set.tubes.noise);
      claim.values.emplace_back("noise", noise);
      claim.hypotheses += fmt::format(", with noise of at most {}", noise);
    } else {
      claim.hypotheses += ", without noise";
    }
    claim.statement =
        claim.hypotheses +
        fmt::format(", the tracker tolerates a slew up to {}{}: a certified invariant set exists{}",
                    units_.slew(slew), by_set(set, "slew"), in_lock(set));
    add_part(claim, limit.part);
    add(by(set, std::move(claim)));
  }
  /// The frequencies for which the set is proved.
  [[nodiscard]] Scope scope_of(const ProvedSet& set) const {
    Scope scope;
    if (!sets_->objection.empty() || (!set.is_proved() && !set.has_part())) {
      return scope;
    }
    scope.part = set.is_proved() ? std::nullopt : band_part(tables_->assume, set.tubes.part);
    scope.is_any = set.is_proved() || scope.part.has_value();
    return scope;
  }
  static void add_part(Claim& claim, const std::optional<BandPart>& part) {
    if (part) {
      claim.values.emplace_back("from", part->from);
      claim.values.emplace_back("to", part->to);
    }
  }
  void add(Claim claim) {
    claim.statement += claim.statement.ends_with(".") ? "" : ".";
    certificate_->claims.push_back(std::move(claim));
  }

  static Claim required(const char* id, const Number& number, const std::string& hypotheses,
                        std::string_view requirement, std::string (*words)(const Number&) = nullptr) {
    Claim claim;
    claim.id = id;
    claim.requirement =
        fmt::format(fmt::runtime(requirement), words == nullptr ? number.text : words(number));
    claim.statement = fmt::format("{}, {}.", hypotheses, claim.requirement);
    claim.required = true;
    claim.position = number.position;
    return claim;
  }

  /// PROVED when it is known and `bound` is below (with `or_equal`: at most) the required one.
  void decide(Claim& claim, bool is_known, double bound, const Number& number, std::string_view reason,
              const std::string& objection, bool or_equal = false) {
    if (!is_known || !std::isfinite(bound)) {
      claim.reason = objection;
    } else {
      const bool holds = or_equal ? rigor::certainly_less_equal(Interval(bound), number.value)
                                  : rigor::certainly_less(Interval(bound), number.value);
      claim.verdict = holds ? Verdict::proved : Verdict::undecided;
      claim.reason = fmt::format(fmt::runtime(reason), above(bound)) +
                     (holds ? "." : fmt::format("; {} was required.", number.text));
    }
    add(claim);
  }
  /// `say`: the claim in words, with " in which the frequency error stays at or below ..." of the set by
  /// which it is proved.
  template <typename Say>
  void decide_size(const Say& say, const LargestOfSets& largest, const Number& number,
                   std::string_view reason, const std::string& objection) {
    const double size = largest.size;
    if (!(size > 0.0) || !std::isfinite(size)) {
      Claim claim = say("");
      claim.reason = objection;
      add(claim);
      return;
    }
    const ProvedSet& set = *largest.set;
    const bool is_lock = names_lock(set);
    const bool holds = is_lock && rigor::certainly_less_equal(number.value, Interval(size));
    Claim claim = say(holds ? in_lock(set) : "");
    if (holds) {
      claim.verdict = Verdict::proved;
      claim.values = {{"frequency_error", above(set.frequency_error)}};
    }
    claim = by(set, std::move(claim));
    claim.reason = fmt::format(fmt::runtime(reason), below(size)) +
                   (holds     ? "."
                    : is_lock ? fmt::format("; {} was required.", number.text)
                              : fmt::format(". {}.", lock_objection(set.frequency_error, set.half_distance)));
    add(claim);
  }
  /// " in which the frequency error stays at or below 0.05 rad/sample".
  [[nodiscard]] std::string in_lock(const ProvedSet& set) const {
    return " in which the frequency error stays at or below " + units_.at_most(above(set.frequency_error));
  }

  /// From some sample on below the required error, by the levels of each tube.
  Claim settling(const std::string& assumed) {
    const Number& within = *tables_->require.sets.settles_within;
    const Number& target = *tables_->require.sets.settled_below;
    Claim claim = required("model/settling-time", within,
                           assumed + words_.start(sets_->assumed ? "assumed" : "starts"), "");
    claim.requirement = fmt::format("from sample {} on, the frequency error stays below {}", within.text,
                                    frequency_words(target));
    claim.statement = fmt::format("{}, {}.", assumed + words_.start(sets_->assumed ? "assumed" : "starts"),
                                  claim.requirement);
    const double samples = guaranteed() ? samples_below(target) : INFINITY;
    if (!guaranteed()) {
      claim.reason = guarantee_objection();
    } else if (!std::isfinite(samples)) {
      claim.reason = fmt::format("The proved bound in the long run is {} rad/sample; {} was required.",
                                 above(settled_error()), target.text);
    } else {
      const bool holds = rigor::certainly_less_equal(Interval(samples), within.value);
      claim.verdict = holds ? Verdict::proved : Verdict::undecided;
      claim.reason = fmt::format("It is proved from sample {} on.", samples);
    }
    return claim;
  }

  /// From the start of the design into the set.
  [[nodiscard]] Claim captured(const Number& within) const {
    const auto say = [&](const std::string& there) {
      const std::string requirement =
          fmt::format("the tracker is in the set \"{}\" of the certificate after at most {{}} samples{}",
                      deciding_name(), there);
      return required("model/capture-time", within,
                      words_.constant_tone() + words_.noise() + words_.started_exactly(), requirement);
    };
    Claim claim = say("");
    if (!covers_assumptions() || !sets_->capture) {
      claim.reason = assumption_objection();
    } else if (!sets_->capture->is_proved) {
      claim.reason = "It is not proved that it comes there: " + sets_->capture->reason + ".";
    } else {
      const double samples = sets_->capture->samples;
      const bool is_lock = names_lock(*deciding_);
      if (is_lock && rigor::certainly_less_equal(Interval(samples), within.value)) {
        const std::string error = above(deciding_->frequency_error);
        claim = say(", and there the frequency error stays at or below " + units_.at_most(error));
        claim.values = {{"frequency_error", error}};
        claim.verdict = Verdict::proved;
      }
      claim.reason = fmt::format("It is proved to be there after at most {} samples.", samples);
      if (!is_lock) {
        claim.reason += " " + lock_objection(deciding_->frequency_error, deciding_->half_distance) + ".";
      }
    }
    return claim;
  }
  [[nodiscard]] const char* deciding_name() const { return sets_->assumed ? "assumed" : "starts"; }

  /// The number of samples after which the error is below the target at all frequencies; infinity when it is
  /// not known.
  [[nodiscard]] double samples_below(const Number& target) const {
    if (sets_->gains) {
      return model::samples_below(*sets_->gains, target.value);
    }
    if (deciding_->is_without_tubes()) {
      return model::samples_below(*sets_->phases, target.value);
    }
    const Model model = make_model(tables_->model, tables_->assume.signal);
    const model::TrackerModel tracker = proved_model(model, tables_->assume);
    // The first level below it.
    const auto level_below = [&](const model::ProvedTube& proved) -> std::optional<std::size_t> {
      for (std::size_t level = 0; level < proved.levels.size(); ++level) {
        const Interval error = model::bound_errors(tracker, proved.tube, proved.levels[level], {}).error;
        const Interval room(1.001);
        if (rigor::is_finite(error) && rigor::certainly_less(error * room, target.value) &&
            rigor::certainly_less(-error * room, target.value)) {
          return level;
        }
      }
      return std::nullopt;
    };
    double samples = 0.0;
    std::size_t number = 0;  // of the tube, which is that of the long run's
    for (const model::TubeSet& part : model::sets_of_amplitudes(deciding_->tubes)) {
      for (const model::ProvedTube& tube : part.tubes) {
        double until = INFINITY;
        if (const auto level = level_below(tube)) {
          until = model::samples_until(tube, *level, part.crossing);
        } else if (sets_->long_run) {
          const model::ProvedTube& inner = sets_->long_run->tubes.tubes[number];
          if (const auto inner_level = level_below(inner)) {
            until = model::samples_until_long_run(tube, inner, *inner_level);
          }
        }
        samples = std::isfinite(until) ? std::max(samples, until) : INFINITY;
        ++number;
      }
    }
    return samples;
  }

  /// Then nothing holds for ever.
  [[nodiscard]] bool is_gaussian() const { return tables_->assume.gaussian.has_value(); }
  [[nodiscard]] bool covers_assumptions() const { return sets_->objection.empty() && deciding_->is_proved(); }
  /// Claims of the set that decides, for the frequencies that it covers.
  [[nodiscard]] bool keeps_starts() const {
    return deciding_->start_share <= 1.0 && std::isfinite(deciding_->frequency_error);
  }
  [[nodiscard]] bool captures_start() const {
    return sets_->capture && sets_->capture->is_proved && std::isfinite(deciding_->frequency_error);
  }
  [[nodiscard]] bool guaranteed() const { return covers_assumptions() && keeps_starts(); }
  [[nodiscard]] bool settles() const {
    return deciding_->is_without_tubes() || sets_->long_run ||
           std::all_of(deciding_->tubes.tubes.begin(), deciding_->tubes.tubes.end(),
                       [](const model::ProvedTube& tube) { return tube.levels.size() > 1; });
  }
  [[nodiscard]] double settled_error() const {
    return sets_->long_run && !deciding_->is_without_tubes() ? sets_->long_run->settled_error
                                                             : deciding_->settled_error;
  }
  [[nodiscard]] bool has_bias() const { return settled_set().is_proved() && knows_bias(); }
  /// By which the error without noise is known.
  [[nodiscard]] const ProvedSet& settled_set() const {
    const bool is_by_phases =
        sets_->phases && !sets_->starts.is_proved() && sets_->phases->starts.is_proved();
    return is_by_phases ? sets_->phases->starts : sets_->starts;
  }
  /// For the frequencies that the set without noise covers.
  [[nodiscard]] bool knows_bias() const {
    const ProvedSet& starts = settled_set();
    return rigor::is_finite(starts.bias) && std::isfinite(starts.ripple) &&
           std::all_of(starts.tubes.tubes.begin(), starts.tubes.tubes.end(),
                       [](const model::ProvedTube& tube) { return tube.levels.size() > 1; });
  }
  /// `is_met`: the requirement is proved for the frequencies that the set covers.
  [[nodiscard]] std::string objection_of(const ProvedSet& set, bool is_met = false) const {
    std::string text = sets_->gains || set.is_without_tubes()
                           ? "Not proved"
                           : "No set of tubes was proved for the whole band";
    if (const Scope scope = scope_of(set); scope.part) {
      text = fmt::format("{} over {} to {} {} only", is_met ? "Proved" : "A set of tubes was proved",
                         scope.part->from, scope.part->to, words_.unit());
    }
    constexpr std::size_t kMostReasons = 3;
    for (std::size_t i = 0; i < std::min(kMostReasons, set.tubes.reasons.size()); ++i) {
      text += (i == 0 ? ": " : "; ") + set.tubes.reasons[i];
    }
    return text + ".";
  }
  [[nodiscard]] std::string assumption_objection(bool is_met = false) const {
    if (!sets_->objection.empty()) {
      return "Nothing is certified: " + sets_->objection + ".";
    }
    return objection_of(*deciding_, is_met) + (deciding_->is_proved() ? std::string() : tolerated());
  }
  /// Where no set was proved for the assumed noise and slew: the noise and slew for which one was.
  [[nodiscard]] std::string tolerated() const {
    std::string text;
    const auto tell = [&](const ProvedSet* set, double model::TubeSet::*size, std::string_view what,
                          std::string_view unit) {
      const Scope scope = sets_->assumed && set != nullptr ? scope_of(*set) : Scope{};
      if (!scope.is_any || !(set->tubes.*size > 0.0)) {
        return;
      }
      text += fmt::format(
          " The largest {} for which a set was proved{} is {}{}.", what,
          scope.part ? fmt::format(", over {} to {} {},", scope.part->from, scope.part->to, words_.unit())
                     : std::string(),
          below(set->tubes.*size), unit);
    };
    if (sets_->assumed && sets_->assumed->tubes.noise > 0.0) {
      const ProvedSet* largest = largest_noise(*sets_).set;
      const ProvedSet* of_part = sets_->noise ? &*sets_->noise : nullptr;
      tell(largest != nullptr ? largest : of_part, &model::TubeSet::noise, "noise at a constant frequency",
           "");
    }
    tell(sets_->slew ? &*sets_->slew : nullptr, &model::TubeSet::slew, "slew without noise",
         " rad/sample per sample");
    return text;
  }
  /// The reason why the largest noise or slew is not known for the whole band.
  [[nodiscard]] std::string objection_to_size(const std::optional<ProvedSet>& set,
                                              double model::TubeSet::*size, std::string_view what) const {
    if (!set || !sets_->objection.empty()) {
      return assumption_objection();
    }
    if (set->is_proved() && !names_lock(*set)) {
      return fmt::format("A set was proved. {}.", lock_objection(set->frequency_error, set->half_distance));
    }
    return objection_of(*set) +
           (set->has_part() && set->tubes.*size > 0.0
                ? fmt::format(" The largest {} that was proved there is {}.", what, below(set->tubes.*size))
                : std::string());
  }
  [[nodiscard]] std::string guarantee_objection(bool is_met = false) const {
    if (covers_assumptions() && (sets_->gains || deciding_->is_without_tubes())) {
      return std::isfinite(deciding_->start_share)
                 ? fmt::format(
                       "Only deviations {} times as large as those of the assumed starts are proved to "
                       "settle.",
                       below(1.0 / deciding_->start_share))
                 : "No such starts, however close to the steady state, are proved to settle.";
    }
    if (covers_assumptions() && std::isfinite(deciding_->start_share)) {
      return fmt::format("The assumed starts are up to {} times outside the certified tube.",
                         above(deciding_->start_share));
    }
    return assumption_objection(is_met);
  }

  Certificate* certificate_;
  const ModelTables* tables_;
  const ModelSets* sets_;
  const ProvedSet* deciding_;
  ModelWords words_;
  FrequencyUnits units_;
};

}  // namespace

void add_model_claims(Certificate& certificate) {
  ModelClaims claims(certificate);
  claims.add_told();
  claims.add_required();
}

}  // namespace veritrack::certificates

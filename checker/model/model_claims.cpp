#include "checker/model/model_claims.hpp"

#include <algorithm>
#include <cmath>

#include "checker/document/design_number.hpp"
#include "checker/model/false_lock.hpp"
#include "checker/model/gain/loop_verdicts.hpp"
#include "checker/model/gaussian_drift.hpp"
#include "checker/model/long_run.hpp"
#include "checker/model/start_capture.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

/// A start is followed on the amplitude, or the range for each sample, that the tracker has.
bool is_of_one_amplitude(const TubeFamily* family) {
  return family != nullptr && family->sets.size() == 1 && !family->sets.front().amplitudes;
}

/// Whether the sets bound a covariance: all or none do (model_certificate.cpp).
bool bound_covariance(const std::map<std::string, TubeFamily>& sets) {
  return !sets.empty() && bounds_covariance(sets.begin()->second.sets.front());
}

std::size_t first_level(const PhaseTube& /*tube*/) {
  return 0;
}

/// A whole number from 1 to `most` that the claim writes, or 0 where it writes none.
std::size_t whole_number(const Tree& claim, const char* name, std::size_t most) {
  const Ball value = written(claim, name);
  const double near = std::round(value.near());
  const bool is_whole =
      near >= 1.0 && near <= static_cast<double>(most) && certainly_equal(value, Ball(near));
  return is_whole ? static_cast<std::size_t>(near) : 0;
}

}  // namespace

ModelClaims::ModelClaims(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
                         const std::map<std::string, TubeFamily>& sets, std::int64_t& cells)
    : tree_(&certificate.at("design")),
      design_(&design),
      model_(&model),
      sets_(&sets),
      cells_(&cells),
      words_(*tree_, std::nullopt, bound_covariance(sets)),
      required_(certificate, design, deciding_name()) {
  Objections said_before;  // by the design
  units_ = FrequencyWords(tree_->at("assume"), said_before);
}

bool ModelClaims::is_lock(const TubeFamily& family, const Ball& error, const Part& part) const {
  const Ball half_distance = half_distance_to_false_lock(*model_, part ? part->lowest : design_->lowest,
                                                         part ? part->highest : design_->highest);
  return certainly_less(error, half_distance) && of(family).error_is_at_most(first_level, error);
}

ModelClaims::Part ModelClaims::part_of(const Tree& claim, Objections& objections) const {
  const Tree* from = claim.find("from");
  const Tree* to = claim.find("to");
  if (from == nullptr && to == nullptr) {
    return std::nullopt;
  }
  const Ball low = written(claim, "from");
  const Ball high = written(claim, "to");
  BandPart part{claim.at("from").text(), claim.at("to").text(), low * design_->band_unit,
                high * design_->band_unit};
  // An end of the band as the design writes it is a number and a double.
  const Tree& band = tree_->at("assume").at("frequency");
  const bool begins_inside =
      part.from == text_of(band.at(0)) || certainly_at_most(design_->lowest, part.lowest);
  const bool ends_inside =
      part.to == text_of(band.at(1)) || certainly_at_most(part.highest, design_->highest);
  if (!certainly_less(low, high) || !begins_inside || !ends_inside) {
    objections.emplace_back("from and to are no part of the assumed band");
  }
  return part;
}

bool ModelClaims::covers_all(const TubeFamily& family, const Part& part) const {
  return !family.sets.empty() && std::all_of(family.sets.begin(), family.sets.end(), [&](const TubeSet& set) {
    return part ? covers(set, part->lowest, part->highest) : covers(set, design_->lowest, design_->highest);
  });
}

const TubeFamily* ModelClaims::find(const std::string& name, const Part& part) const {
  const auto found = sets_->find(name);
  return found != sets_->end() && covers_all(found->second, part) ? &found->second : nullptr;
}

std::string ModelClaims::deciding_name() const {
  return sets_->contains("assumed") ? "assumed" : "starts";
}

const TubeFamily* ModelClaims::deciding_set(const Part& part) const {
  if (design_->deviation) {
    return nullptr;  // nothing holds for ever
  }
  const TubeFamily* set = find("assumed", part);
  if (set == nullptr && !design_->is_noisy() && !sets_->contains("assumed")) {
    set = find("starts", part);
  }
  const bool is_enough = set != nullptr && certainly_at_most(design_->noise, Ball(set->noise())) &&
                         certainly_at_most(design_->slew, Ball(set->slew()));
  return is_enough ? set : nullptr;
}

const TubeFamily* ModelClaims::long_run_set(const Part& part) const {
  return deciding_name() == "assumed" && deciding_set(part) != nullptr ? find(kLongRun, part) : nullptr;
}

std::vector<TubeSet> ModelClaims::reached_by(const TubeFamily& family, const Ball& sample) const {
  const TubeFamily* inner = long_run_set();  // of the same parts (check_same_parts)
  std::vector<TubeSet> reached;
  for (std::size_t k = 0; k < family.sets.size(); ++k) {
    reached.push_back(reached_by(family.sets[k], inner != nullptr ? &inner->sets.at(k) : nullptr, sample));
  }
  return reached;
}

TubeSet ModelClaims::reached_by(const TubeSet& set, const TubeSet* inner, const Ball& sample) const {
  const auto last_reached = [&](const TubeSet& tubes, const PhaseTube& tube, const Ball& before) {
    std::size_t reached = 0;
    while (reached < last_level(tube) &&
           certainly_at_most(before + samples_to_level(tubes, tube, reached + 1), sample)) {
      ++reached;
    }
    return reached;
  };
  TubeSet result = set;
  for (std::size_t i = 0; i < set.tubes.size(); ++i) {
    PhaseTube& tube = result.tubes[i];
    const Ball whole = samples_to_level(set, set.tubes[i], last_level(set.tubes[i]));
    const bool is_inside =
        inner != nullptr && certainly_at_most(whole + samples_to_long_run(inner->tubes[i]), sample);
    if (is_inside) {
      tube = inner->tubes[i];
    }
    const Ball before = is_inside ? whole + samples_to_long_run(tube) : zero;
    const std::size_t reached =
        is_inside ? last_reached(*inner, inner->tubes[i], before) : last_reached(set, set.tubes[i], zero);
    tube.levels = {tube.levels[reached]};
  }
  return result;
}

bool ModelClaims::settles(const TubeFamily& family) const {
  return std::all_of(family.sets.begin(), family.sets.end(), [](const TubeSet& set) {
    return std::all_of(set.tubes.begin(), set.tubes.end(),
                       [](const PhaseTube& tube) { return tube.levels.size() > 1; });
  });
}

const TubeFamily* ModelClaims::settling_set(const Part& part) const {
  const TubeFamily* set = find("starts", part);
  return set != nullptr && settles(*set) ? set : nullptr;
}

bool ModelClaims::contains_assumed_starts(const TubeFamily& family) const {
  return design_->start_within.empty() || of(family).contains_starts(design_->start_within);
}

Claim ModelClaims::bound() const {
  const TubeFamily* set = deciding_set();
  Claim found;
  found.statement = words_.assumed_tone(design_->moves()) + words_.assumed_noise(design_->is_noisy()) +
                    words_.assumed_start(deciding_name()) + ", " + required_.short_text(kErrorBound) + ".";
  found.verdict = proved_if(set != nullptr && contains_assumed_starts(*set) &&
                            of(*set).error_is_below(first_level, design_->frequency_error_below->value));
  return found;
}

Claim ModelClaims::settling() const {
  const TubeFamily* set = deciding_set();
  Claim found;
  found.statement = words_.assumed_tone(design_->moves()) + words_.assumed_noise(design_->is_noisy()) +
                    words_.assumed_start(deciding_name()) + ", " + required_.short_text(kSettlingTime) + ".";
  if (set != nullptr && contains_assumed_starts(*set)) {
    // The last levels that are reached in time.
    const std::vector<TubeSet> reached = reached_by(*set, design_->settles_within->value);
    found.verdict = proved_if(of(reached).error_is_below(first_level, design_->settled_below->value));
  }
  return found;
}

Claim ModelClaims::size(const Tree& claim) const {
  const std::string& id = claim.at("id").text();
  const Ball error = written(claim, "frequency_error");
  Claim found;
  // A set that is never left, and tolerates at least this much.
  const auto tolerates = [&](double (TubeFamily::*tolerated)() const, const Ball& required) {
    return std::any_of(sets_->begin(), sets_->end(), [&](const auto& set) {
      return set.first != kLongRun && !set.second.is_gaussian() && covers_all(set.second) &&
             certainly_at_most(required, Ball((set.second.*tolerated)())) && is_lock(set.second, error);
    });
  };
  if (id == kLargestNoise) {
    found.statement = words_.constant_tone();
    found.verdict = proved_if(tolerates(&TubeFamily::noise, design_->largest_noise->value));
  } else if (id == kLargestSlew) {
    found.statement = words_.tone_in_band() + ", without noise";
    found.verdict = proved_if(tolerates(&TubeFamily::slew, design_->largest_slew->value));
  } else {
    const TubeFamily* set = deciding_set();
    found.statement = words_.assumed_tone(design_->moves()) + words_.assumed_noise(design_->is_noisy());
    found.verdict =
        proved_if(set != nullptr && of(*set).contains_errors(design_->radius->value) && is_lock(*set, error));
  }
  found.statement += ", " + required_.short_text(id) + ".";
  return found;
}

Claim ModelClaims::long_run(const std::string& id) const {
  const TubeFamily* set = settling_set();
  Claim found;
  if (id == kBias) {
    const Ball& most = design_->bias->value;
    found.statement = words_.constant_tone() + ", without noise, " + words_.started_in("starts") +
                      ", the mean over the phase of the frequency error in the long run is at most " +
                      design_->bias->text + " in absolute value.";
    found.verdict = proved_if(set != nullptr && of(*set).mean_error_is_between(-most, most));
  } else {
    found.statement = words_.constant_tone() + ", without noise, " + words_.started_in("starts") +
                      ", the frequency error in the long run varies by at most " + design_->ripple->text +
                      " over the phase.";
    found.verdict = proved_if(set != nullptr && of(*set).error_varies_by_at_most(design_->ripple->value));
  }
  return found;
}

bool ModelClaims::is_seldom_left(const TubeFamily* set, const Ball& deviation, const Ball& probability,
                                 bool strictly) const {
  // In Gaussian noise the amplitude is one number (model_design.cpp).
  if (set == nullptr || set->sets.size() != 1 || !set->is_gaussian() ||
      !certainly_at_most(deviation, Ball(set->sets.front().gaussian->deviation))) {
    return false;
  }
  const GaussianTerms& terms = *set->sets.front().gaussian;
  const auto leaves = [&](const Ball& share) {
    return leaving_probability(terms, model_->recursion->samples(), design_->samples, share);
  };
  const auto is_enough = [&](const Ball& share) {
    return strictly ? certainly_less(leaves(share), probability)
                    : certainly_at_most(leaves(share), probability);
  };
  if (design_->start_within.empty()) {
    return is_enough(half);
  }
  // Approximately how deep inside starts have to be: they add exp(L (share^2 - 1)).
  const Ball left = (probability - (leaves(zero) - exp(-Ball(terms.exponent)))) * Ball(0.9999);
  if (!certainly_positive(left)) {
    return false;
  }
  const Ball squared = one + log(left) / Ball(terms.exponent);
  if (!certainly_positive(squared)) {
    return false;
  }
  const Ball share = min(Ball(sqrt(squared).lower_double()), one);
  return is_enough(share) && of(*set).contains_starts(design_->start_within, share);
}

Claim ModelClaims::required_lock(const Tree& claim) const {
  const TubeFamily* set = find("gaussian");
  Claim found;
  found.statement = words_.constant_tone() + words_.gaussian_noise() + words_.start_inside("gaussian") +
                    ", " + required_.short_text(kLosingLock) + ".";
  found.verdict = proved_if(is_seldom_left(set, *design_->deviation, design_->losing_lock->value, true) &&
                            is_lock(*set, written(claim, "frequency_error")));
  return found;
}

Claim ModelClaims::reported_lock(const Tree& claim) const {
  const bool is_lowest = claim.at("id").text() == kLowestSnr;
  const std::string name = is_lowest ? "lowest-snr" : "gaussian";
  const std::string decibels = is_lowest ? claim.at("snr_db").text() : std::string();
  Claim found;
  found.is_summary = true;
  if (!design_->deviation) {
    return found;
  }
  const TubeFamily* set = find(name);
  const Ball deviation =
      is_lowest ? deviation_at(written(claim, "snr_db")) * design_->amplitude : *design_->deviation;
  found.hypotheses = words_.constant_tone() + words_.gaussian_noise(decibels) + words_.start_inside(name);
  found.statement = found.hypotheses + ", the probability that the tracker loses its lock " +
                    words_.stretch_of_samples() + ", its frequency error exceeding " +
                    units_.at_most(claim.at("frequency_error").text()) + " at one of them, is at most " +
                    claim.at("probability").text() + ".";
  found.verdict = proved_if(is_seldom_left(set, deviation, written(claim, "probability"), false) &&
                            is_lock(*set, written(claim, "frequency_error")));
  return found;
}

Claim ModelClaims::guarantee(const Tree& claim, const Part& part) const {
  const TubeFamily* set = deciding_set(part);
  const ModelWords words(*tree_, part, bound_covariance(*sets_));
  const Ball bound = written(claim, "frequency_error");
  Claim found;
  found.is_summary = true;
  found.hypotheses = words.assumed_tone(design_->moves()) + words.assumed_noise(design_->is_noisy()) +
                     words.assumed_start(deciding_name());
  found.statement = found.hypotheses + ", the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text()) + " for ever";
  bool certain =
      set != nullptr && contains_assumed_starts(*set) && of(*set).error_is_at_most(first_level, bound);
  if (const Tree* settled = claim.find("settled_frequency_error")) {
    // cannot bind (bound): it decides only whether the sentence also states the claim, which is checked
    // below.
    if (certainly_less(written(claim, "settled_frequency_error"), bound)) {
      found.statement += ", and at or below " + units_.at_most(settled->text()) + " in the long run";
    }
    const TubeFamily* inner = long_run_set(part);
    certain = certain && (inner != nullptr || settles(*set)) &&
              of(inner != nullptr ? *inner : *set)
                  .error_is_at_most(last_level, written(claim, "settled_frequency_error"));
  }
  found.statement += ".";
  found.verdict = proved_if(certain);
  return found;
}

Claim ModelClaims::captured_in_time(const Tree& claim) const {
  constexpr double kMostSamples = 100'000.0;
  constexpr std::size_t kPhases = 16;
  const TubeFamily* set = deciding_set();
  // Whole samples that have passed by then. More than these do not help.
  const double samples = std::floor(std::min(design_->captured_within->value.lower_double(), kMostSamples));
  Claim found;
  found.statement = words_.constant_tone() + words_.assumed_noise(design_->is_noisy()) +
                    words_.started_exactly() + ", " + required_.short_text(kCaptureTime) + ".";
  found.verdict = proved_if(
      is_of_one_amplitude(set) && samples >= 1.0 && is_lock(*set, written(claim, "frequency_error")) &&
      is_captured(*model_, set->sets.front(),
                  {design_->start, design_->noise, static_cast<std::size_t>(samples), {}, kPhases, 1},
                  *cells_));
  return found;
}

Claim ModelClaims::capture(const Tree& claim, const Part& part) const {
  Claim found;
  found.is_summary = true;
  if (design_->start.empty()) {
    return found;  // there is no start to speak of
  }
  constexpr std::size_t kMostSamples = 100'000;
  constexpr std::size_t kMostParts = 1U << 14U;
  const TubeFamily* set = deciding_set(part);
  const ModelWords words(*tree_, part, bound_covariance(*sets_));
  StartClaim start{design_->start,
                   design_->noise,
                   whole_number(claim, "samples", kMostSamples),
                   {},
                   whole_number(claim, "phases", kMostParts),
                   whole_number(claim, "frequencies", kMostParts)};
  const Ball after = written(claim, "frequency_error");
  found.hypotheses =
      words.constant_tone() + words.assumed_noise(design_->is_noisy()) + words.started_exactly();
  found.statement = found.hypotheses + ", the tracker is in the set \"" + deciding_name() +
                    "\" of the certificate after at most " + claim.at("samples").text() + " samples";
  bool certain = is_of_one_amplitude(set) && is_lock(*set, after, part);
  if (const Tree* error = claim.find("frequency_error_before")) {
    found.statement += ", with a frequency error of at most " + units_.at_most(error->text()) + " until then";
    start.frequency_error = written(claim, "frequency_error_before");
    // Some are in the set before others.
    certain = certain && of(*set).error_is_at_most(first_level, *start.frequency_error);
  }
  found.statement += ", and the frequency error stays at or below " +
                     units_.at_most(claim.at("frequency_error").text()) + " for ever after.";
  found.verdict = proved_if(certain && is_captured(*model_, set->sets.front(), start, *cells_));
  return found;
}

const TubeFamily* ModelClaims::largest(std::initializer_list<const char*> names,
                                       double (TubeFamily::*tolerated)() const, const Ball& error,
                                       const Part& part) const {
  const TubeFamily* found = nullptr;
  for (const char* name : names) {
    const TubeFamily* set = find(name, part);
    if (set != nullptr && !set->is_gaussian() &&
        (set->*tolerated)() > (found != nullptr ? (found->*tolerated)() : 0.0) &&
        is_lock(*set, error, part)) {
      found = set;
    }
  }
  return found;
}

namespace {

std::string by_set(const TubeFamily* set, const std::string& usual) {
  return set == nullptr || set->name == usual ? std::string()
                                              : " (by the set \"" + set->name + "\" of the certificate)";
}

}  // namespace

Claim ModelClaims::limits(const Tree& claim, const Part& part) const {
  const TubeFamily* noise =
      largest({"noise", "assumed", "slew"}, &TubeFamily::noise, written(claim, "frequency_error"), part);
  const ModelWords words(*tree_, part, bound_covariance(*sets_));
  Claim found;
  found.is_summary = true;
  found.hypotheses = words.constant_tone();
  found.statement = found.hypotheses + ", the tracker tolerates noise up to " + claim.at("noise").text() +
                    by_set(noise, "noise") +
                    ": a certified invariant set exists in which the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text());
  const Ball tolerated = written(claim, "noise");
  bool certain =
      noise != nullptr && certainly_positive(tolerated) && certainly_at_most(tolerated, Ball(noise->noise()));
  if (const Tree* errors = claim.find("reach")) {
    found.statement += ", and without noise a certified invariant set in which it stays at or below " +
                       units_.at_most(claim.at("reach_frequency_error").text()) +
                       " contains frequency errors up to " + units_.at_least(errors->text()) +
                       " at every phase";
    certain =
        certain && contains_errors(written(claim, "reach"), written(claim, "reach_frequency_error"), part);
  }
  found.statement += ".";
  found.verdict = proved_if(certain);
  return found;
}

bool ModelClaims::contains_errors(const Ball& reach, const Ball& error, const Part& part) const {
  // A set for some noise is also one without noise.
  const auto contains = [&](const char* name) {
    const TubeFamily* set = find(name, part);
    return set != nullptr && !set->is_gaussian() && of(*set).contains_errors(reach) &&
           is_lock(*set, error, part);
  };
  return certainly_positive(reach) &&
         (contains("starts") || contains("assumed") || contains("noise") || contains("slew"));
}

Claim ModelClaims::reach(const Tree& claim, const Part& part) const {
  Claim found = reach_claim(claim, ModelWords(*tree_, part, bound_covariance(*sets_)), units_);
  found.verdict =
      proved_if(contains_errors(written(claim, "reach"), written(claim, "frequency_error"), part));
  return found;
}

Claim ModelClaims::slew_limit(const Tree& claim, const Part& part) const {
  const TubeFamily* set =
      largest({"slew", "assumed"}, &TubeFamily::slew, written(claim, "frequency_error"), part);
  const ModelWords words(*tree_, part, bound_covariance(*sets_));
  const Ball slew = written(claim, "slew");
  bool certain = set != nullptr && certainly_positive(slew) && certainly_at_most(slew, Ball(set->slew()));
  Claim found;
  found.is_summary = true;
  found.hypotheses = words.tone_in_band();
  if (const Tree* noise = claim.find("noise")) {
    const Ball together = written(claim, "noise");
    found.hypotheses += ", with noise of at most " + noise->text();
    certain = certain && certainly_positive(together) && certainly_at_most(together, Ball(set->noise()));
  } else {
    found.hypotheses += ", without noise";
  }
  found.statement = found.hypotheses + ", the tracker tolerates a slew up to " +
                    units_.slew(claim.at("slew").text()) + by_set(set, "slew") +
                    ": a certified invariant set exists in which the frequency error stays at or below " +
                    units_.at_most(claim.at("frequency_error").text()) + ".";
  found.verdict = proved_if(certain);
  return found;
}

Claim ModelClaims::steady_state(const Tree& claim, const Part& part) const {
  const TubeFamily* set = settling_set(part);
  const ModelWords words(*tree_, part, bound_covariance(*sets_));
  Claim found;
  found.is_summary = true;
  found.hypotheses = words.constant_tone() + ", without noise, " + words.started_in("starts");
  found.statement =
      found.hypotheses + ", the mean over the phase of the frequency error in the long run is between " +
      units_.between(claim.at("bias_low").text(), claim.at("bias_high").text()) +
      ", and the error varies by at most " + units_.at_most(claim.at("ripple").text()) + " over the phase.";
  found.verdict =
      proved_if(set != nullptr &&
                of(*set).mean_error_is_between(written(claim, "bias_low"), written(claim, "bias_high")) &&
                of(*set).error_varies_by_at_most(written(claim, "ripple")));
  return found;
}

Claim ModelClaims::check(const Tree& claim, Objections& objections) const {
  const std::string& id = claim.at("id").text();
  const std::vector<Requirement> asked = required();
  const bool is_told = id == kGuarantee || id == kCapture || id == kLimits || id == kReach ||
                       id == kSlewLimit || id == kSteadyState || id == kLock || id == kLowestSnr;
  const bool is_asked = std::any_of(asked.begin(), asked.end(),
                                    [&](const Requirement& requirement) { return requirement.claim == id; });
  if ((!is_told && !is_asked) || is_about_linear_loop(id)) {
    objections.emplace_back(is_asked ? "tubes do not decide this" : "[require] does not ask for this");
    return {};
  }
  const bool is_lock = id == kLock || id == kLowestSnr;
  const Part part = is_told && !is_lock ? part_of(claim, objections) : Part();
  Claim found = id == kGuarantee               ? guarantee(claim, part)
                : id == kCapture               ? capture(claim, part)
                : id == kLimits                ? limits(claim, part)
                : id == kReach                 ? reach(claim, part)
                : id == kSlewLimit             ? slew_limit(claim, part)
                : id == kSteadyState           ? steady_state(claim, part)
                : is_lock                      ? reported_lock(claim)
                : id == kLosingLock            ? required_lock(claim)
                : id == kErrorBound            ? bound()
                : id == kSettlingTime          ? settling()
                : id == kCaptureTime           ? captured_in_time(claim)
                : id == kBias || id == kRipple ? long_run(id)
                                               : size(claim);
  check_claim(claim, found, objections);
  return found;
}

}  // namespace veritrack::checker

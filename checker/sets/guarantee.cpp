#include "checker/sets/guarantee.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "checker/document/design_number.hpp"
#include "checker/document/evidence.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

const std::string kBound = "ekf/frequency-error-bound";
const std::string kSettling = "ekf/settling-time";
const std::string kSentence = "ekf/guarantee";
const std::string kNoise = "ekf/largest-noise";
const std::string kSlew = "ekf/largest-slew";
const std::string kReach = "ekf/frequency-error-radius";
const std::string kSet = "ekf/invariant-set";
const std::string kLimits = "ekf/limits";
const std::string kLosingLock = "ekf/probability-of-losing-lock";
const std::string kMeanSquare = "ekf/rms-frequency-error";
const std::string kLowestSnr = "ekf/lowest-snr";
const std::string kPerSample = " rad/sample";

/// For a number of any unit.
bool is_zero(const Tree& number) {
  const std::string& text = text_of(number);
  return certainly_equal(from_decimal(text.substr(0, text.find(' '))), zero);
}

Ball of(const std::optional<Ball>& value) {
  return value.value_or(Ball::everything());
}

/// " an SNR of at least ... dB": with the deviation that this is at amplitude 1.
std::string snr_words(const std::string& decibels, const Ball& deviation) {
  return "an SNR of at least " + decibels + " dB (a deviation of at most " + lower_decimal(deviation) +
         " of the amplitude in each channel)";
}

std::vector<Quantity> settling_evidence(const Promises& promises) {
  const Settled settled = promises.settled.value_or(Settled{Ball::everything(), Ball::everything()});
  return {{"settling_samples", settled.samples, Sense::bounds_above},
          {"settled_frequency_error", settled.frequency_error, Sense::bounds_above}};
}

}  // namespace

Guarantee::Number Guarantee::required_number(const std::string& name, const Tree& value, const Tree& assume,
                                             Objections& objections) {
  if (name == "largest_slew_at_least") {
    return {words_of(value, kPerSample + " per sample"), read_slew(value, assume, objections)};
  }
  if (name.find("frequency_error") != std::string::npos || name == "settled_below") {
    return {words_of(value, kPerSample), read_frequency(value, assume, name, objections)};
  }
  return {text_of(value), read_number(value, objections)};
}

void add_bounds(const Promises& promises, Derivation& found) {
  const auto add = [&](const char* name, const std::optional<Ball>& value, Sense sense) {
    found.quantities.push_back({name, of(value), sense});
  };
  add("ultimate_frequency_error", promises.ultimate, Sense::bounds_above);
  add("frequency_error_bound", promises.bound, Sense::bounds_above);
  add("largest_noise", promises.noise, Sense::bounds_below);
  add("largest_slew", promises.slew, Sense::bounds_below);
}

std::optional<Settled> settling_claim(const Tree& quantities) {
  const Tree* samples = quantities.find("settling_samples");
  const Tree* error = quantities.find("settled_frequency_error");
  if (samples == nullptr || error == nullptr) {
    return std::nullopt;
  }
  Settled claim{high_of(*samples), high_of(*error)};
  const bool sensible = certainly_not_negative(claim.samples) && certainly_positive(claim.frequency_error);
  return sensible ? std::optional(std::move(claim)) : std::nullopt;
}

Guarantee::Guarantee(const Tree& design, Wording wording, Objections& objections)
    : design_(design), wording_(std::move(wording)) {
  const std::array<std::pair<std::string, std::optional<Number>*>, 8> keys{
      {{"frequency_error_below", &frequency_error_below_},
       {"settles_within", &settles_within_},
       {"settled_below", &settled_below_},
       {"largest_noise_at_least", &noise_},
       {"largest_slew_at_least", &slew_},
       {"frequency_error_radius_at_least", &reach_},
       {"probability_of_losing_lock_below", &losing_lock_},
       {"rms_frequency_error_below", &rms_}}};
  for (const auto& member : design.at("require").members()) {
    const std::string& name = member.first;
    const Tree& value = member.second;
    const auto* key =
        std::find_if(keys.begin(), keys.end(), [&](const auto& known) { return known.first == name; });
    if (key == keys.end()) {
      objections.push_back("[require] has no key " + name);
      continue;
    }
    const std::size_t before = objections.size();
    const Number number = required_number(name, value, design.at("assume"), objections);
    if (objections.size() == before && !certainly_positive(number.value)) {
      objections.push_back(name + " must be positive");
    }
    *key->second = number;
  }
  if (settles_within_.has_value() != settled_below_.has_value()) {
    objections.emplace_back("settles_within and settled_below need each other");
    settles_within_.reset();
    settled_below_.reset();
  }
  const Tree& assume = design.at("assume");
  words_ = FrequencyWords(assume, objections);
  lock_limit_ = "3.14";
  if (!wording_.two_channels) {
    const Band band = read_band(assume, objections);
    lock_limit_ = lower_decimal(max(min(band.lowest, pi() - band.highest), zero));
  }
  const auto require = [&](bool asked, const std::string& id) {
    if (asked) {
      required_.push_back({id, short_text(id)});
    }
  };
  require(frequency_error_below_.has_value(), kBound);
  require(settles_within_.has_value(), kSettling);
  require(noise_.has_value(), kNoise);
  require(slew_.has_value(), kSlew);
  require(reach_.has_value(), kReach);
  require(losing_lock_.has_value(), kLosingLock);
  require(rms_.has_value(), kMeanSquare);
  const bool of_gaussian = losing_lock_.has_value() || rms_.has_value();
  const bool of_bounded =
      required_.size() > std::size_t{losing_lock_.has_value()} + std::size_t{rms_.has_value()};
  if (wording_.deviation ? of_bounded : of_gaussian) {
    objections.emplace_back(
        "[require] asks of Gaussian noise what is for bounded noise, or the other way round");
  }
  amplitude_ = read_number(assume.at("amplitude"), objections);
  assumed_noise_ = wording_.deviation ? Ball::everything() : read_number(assume.at("noise"), objections);
  start_error_ =
      read_frequency(assume.at("initial_frequency_error"), assume, "initial_frequency_error", objections);
}

bool Guarantee::is_lock(const std::optional<Ball>& frequency_error) const {
  return frequency_error && certainly_less(*frequency_error, from_decimal(lock_limit_));
}

bool Guarantee::is_guarantee(const std::string& id) {
  const std::array ids{kBound, kSettling, kSentence,   kNoise,      kSlew,     kReach,
                       kSet,   kLimits,   kLosingLock, kMeanSquare, kLowestSnr};
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::string Guarantee::assumed_disturbance() const {
  if (wording_.deviation) {
    return gaussian_disturbance();
  }
  const Tree& assume = design_.at("assume");
  const Tree& slew = assume.at("slew");
  std::string text = is_zero(slew) ? " and is constant"
                                   : " and changes by at most " + words_of(slew, kPerSample + " per sample");
  if (is_zero(assume.at("noise"))) {
    return text + ", without measurement noise";
  }
  text += ", with measurement noise of at most " + text_of(assume.at("noise"));
  return text + (wording_.two_channels ? " (the length of the error in both channels; " +
                                             lower_decimal(assumed_noise_ / sqrt(two)) + " in each is enough)"
                                       : "");
}

bool Guarantee::frequency_walks() const {
  const Tree* walk = design_.at("assume").find("frequency_walk");
  return walk != nullptr && !is_zero(*walk);
}

/// Rounding is bounded while the frequency is within a bound, which a walk leaves in the end.
std::string Guarantee::stretch_of_samples() const {
  const std::string& samples = text_of(design_.at("assume").at("samples"));
  return frequency_walks() ? "within " + samples + " samples"
                           : "within any " + samples + " successive samples, however late";
}

std::string Guarantee::gaussian_disturbance() const {
  const Tree& assume = design_.at("assume");
  const Tree& noise = assume.at("noise");
  std::string text = " and is constant";
  if (frequency_walks()) {
    text = " at the start and walks in independent Gaussian steps of mean zero and deviation at most " +
           words_of(assume.at("frequency_walk"), kPerSample);
  }
  text +=
      ", with Gaussian measurement noise of mean zero, independent from sample to sample and from channel to "
      "channel, and ";
  if (!other_snr_.empty()) {
    const Ball exponent = -(from_decimal(other_snr_) / Ball(20.0)) * log(Ball(10.0));
    return text + snr_words(other_snr_, exp(exponent) / sqrt(two));
  }
  if (const Tree* decibels = noise.find("snr_db")) {
    return text + snr_words(text_of(*decibels), *wording_.deviation);
  }
  return text + "a deviation of at most " + text_of(noise.at("deviation")) + " in each channel";
}

std::string Guarantee::disturbance_of(const Ball& noise, const Ball& slew) {
  std::string text = certainly_equal(slew, zero)
                         ? " and is constant"
                         : " and changes by at most " + lower_decimal(slew) + kPerSample + " per sample";
  return text.append(certainly_equal(noise, zero)
                         ? ", without measurement noise"
                         : ", with measurement noise of at most " + lower_decimal(noise) +
                               " of the amplitude (the length of the error in both channels)");
}

/// "In exact arithmetic, for a tone of constant amplitude 1 ...", with the assumed noise and slew.
std::string Guarantee::tone(bool disturbed) const {
  const Tree& assume = design_.at("assume");
  std::string text = std::string(wording_.arithmetic) + ", for a tone of constant amplitude " +
                     text_of(assume.at("amplitude")) + words_.sampled() + " whose frequency ";
  if (wording_.in_band) {
    const Tree& band = assume.at("frequency");
    text += "lies between " + text_of(band.at(0)) + " and " + words_of(band.at(1), kPerSample);
  } else {
    text += "is at most pi" + kPerSample;
  }
  return text + (disturbed ? assumed_disturbance() : "");
}

std::string Guarantee::hypotheses(const Promises& promises) const {
  return hypotheses(assumed_disturbance(), promises.covariance);
}

std::string Guarantee::hypotheses(const std::string& disturbance, const std::string& covariance) const {
  const Tree& assume = design_.at("assume");
  const auto words = [&](const char* name) { return text_of(assume.at(name)); };
  return tone(false) + disturbance + ", started within " +
         words_of(assume.at("initial_frequency_error"), kPerSample) + " of the true frequency, " +
         words("initial_phase_error") + " rad of the phase and " + words("initial_amplitude_error") +
         " of the amplitude" + (covariance.empty() ? "" : " " + covariance) + ", ";
}

/// The requirement in [require].
std::string Guarantee::short_text(const std::string& id) const {
  if (id == kBound) {
    return "the frequency error stays below " + frequency_error_below_->text + " for ever";
  }
  if (id == kSettling) {
    return "from sample " + settles_within_->text + " on, the frequency error stays below " +
           settled_below_->text;
  }
  if (id == kNoise) {
    return "at a constant frequency, the tracker tolerates noise up to " + noise_->text +
           ": a certified invariant set exists, in which the frequency error stays below " + lock_words();
  }
  if (id == kSlew) {
    return "without noise, the tracker tolerates a slew up to " + slew_->text +
           ": a certified invariant set exists, in which the frequency error stays below " + lock_words();
  }
  if (id == kLosingLock) {
    return "the probability of losing lock, a frequency error of " + lock_words() + " or more, is below " +
           losing_lock_->text + " " + stretch_of_samples();
  }
  if (id == kMeanSquare) {
    return "the root mean square of the frequency error in lock, in a certified set where it stays below " +
           lock_words() + ", is below " + rms_->text + " " + stretch_of_samples();
  }
  return "under the assumed noise and slew, a certified invariant set contains frequency errors up to " +
         reach_->text + " and none of " + lock_words() + " or more";
}

/// That the error stays below the limit. A start with that much error is allowed, and is not below.
Claim Guarantee::frequency_error(const Promises& promises) const {
  const Ball& limit = frequency_error_below_->value;
  const bool same = frequency_error_below_->text ==
                    words_of(design_.at("assume").at("initial_frequency_error"), kPerSample);
  const bool exceeded = same || certainly_at_most(limit, start_error_) ||
                        (promises.wrong_lock && certainly_at_most(limit, *promises.wrong_lock));
  Claim found;
  found.hypotheses = hypotheses(promises);
  found.statement = found.hypotheses + short_text(kBound) + ".";
  found.verdict = certainly_less(of(promises.bound), limit) ? Verdict::proved
                  : exceeded                                ? Verdict::refuted
                                                            : Verdict::undecided;
  found.evidence = {{"frequency_error_bound", of(promises.bound), Sense::bounds_above},
                    {"wrong_lock_frequency_error", of(promises.wrong_lock), Sense::bounds_below}};
  return found;
}

Claim Guarantee::settling(const Promises& promises) const {
  Claim found;
  found.statement = hypotheses(promises) + short_text(kSettling) + ".";
  found.evidence = settling_evidence(promises);
  found.verdict =
      proved_if(promises.settled && certainly_at_most(promises.settled->samples, settles_within_->value) &&
                certainly_less(promises.settled->frequency_error, settled_below_->value));
  return found;
}

Claim Guarantee::size(const std::string& id, const Promises& promises) const {
  Claim found;
  found.statement = tone(id == kReach) + ", " + short_text(id);
  if (id == kNoise) {
    // Noise is certified relative to the amplitude.
    found.verdict = proved_if(is_lock(promises.noise_error) &&
                              certainly_at_most(noise_->value, of(promises.noise) * amplitude_));
    found.evidence = {{"largest_noise", of(promises.noise), Sense::bounds_below}};
  } else if (id == kSlew) {
    found.verdict =
        proved_if(is_lock(promises.slew_error) && certainly_at_most(slew_->value, of(promises.slew)));
    found.evidence = {{"largest_slew", of(promises.slew), Sense::bounds_below}};
  } else {
    found.statement +=
        promises.about_steady_state ? ", measured from the steady state, which the leak biases" : "";
    found.verdict =
        proved_if(is_lock(promises.reach_error) && certainly_at_most(reach_->value, of(promises.reach)));
    found.evidence = {{"frequency_error_radius", of(promises.reach), Sense::bounds_below}};
  }
  found.statement += ".";
  return found;
}

/// The size of the set and, when it is the one with a rate, the rate at which errors in it shrink.
Claim Guarantee::invariant_set(const Tree& claim, const Promises& promises) const {
  const Tree& evidence = claim.at("evidence");
  const Ball reach = low_of(evidence.at("frequency_error_radius"));
  Claim found;
  found.is_summary = true;
  found.evidence = {{"frequency_error_radius", of(promises.reach), Sense::bounds_below},
                    {"contraction_rate", of(promises.rate), Sense::bounds_above}};
  found.verdict = proved_if(promises.reach && is_lock(promises.reach_error) && certainly_positive(reach));
  found.hypotheses = tone(true);
  found.statement =
      found.hypotheses + ", a certified invariant set contains frequency errors up to " +
      words_.at_least(reach) + " and none of " + lock_words() + " or more" +
      (promises.about_steady_state ? ", measured from the steady state, which the leak biases" : "");
  if (const Tree* rate = evidence.find("contraction_rate")) {
    found.statement +=
        std::string("; in it, ") +
        (promises.rate_window == 1 ? "each sample multiplies the error" : "the error is multiplied") +
        " by at most " + upper_decimal(high_of(*rate)) +
        (promises.rate_window == 1
             ? ""
             : " per sample on average over " + std::to_string(promises.rate_window) + " samples") +
        ", before noise and slew";
  }
  found.statement += ".";
  return found;
}

/// The tolerated noise and the tolerated slew, one at a time.
Claim Guarantee::limits(const Tree& claim, const Promises& promises) const {
  const Tree& evidence = claim.at("evidence");
  Claim found;
  found.is_summary = true;
  found.evidence = {{"largest_noise", of(promises.noise), Sense::bounds_below},
                    {"largest_slew", of(promises.slew), Sense::bounds_below}};
  found.verdict = proved_if(promises.noise && promises.slew && is_lock(promises.noise_error) &&
                            is_lock(promises.slew_error));
  found.hypotheses = tone(false);
  found.statement = found.hypotheses + ", at a constant frequency the tracker tolerates noise up to " +
                    lower_decimal(low_of(evidence.at("largest_noise"))) +
                    " of the amplitude, and without noise a slew up to " +
                    words_.slew(low_of(evidence.at("largest_slew"))) +
                    ": a certified invariant set exists for each, in which the frequency error stays below " +
                    lock_words() + ".";
  return found;
}

/// The guarantee: the error stays below the limit, the bound that it never exceeds, and the sample by which
/// it has settled.
Claim Guarantee::sentence(const Tree& claim, const Promises& promises) const {
  Claim found;
  if (frequency_error_below_) {
    found = frequency_error(promises);
    found.statement.pop_back();
  } else {
    found.hypotheses = hypotheses(promises);
    found.statement = found.hypotheses + "the tracker keeps its lock for ever";
    // The sentence names the bound that the error never exceeds.
    const Tree* named = claim.at("evidence").find("frequency_error_bound");
    found.verdict = named != nullptr && is_lock(promises.bound) && is_lock(high_of(*named)) ? Verdict::proved
                    : promises.wrong_lock                                                   ? Verdict::refuted
                                          : Verdict::undecided;
    found.evidence = {{"frequency_error_bound", of(promises.bound), Sense::bounds_above},
                      {"wrong_lock_frequency_error", of(promises.wrong_lock), Sense::bounds_below}};
  }
  found.is_summary = true;
  if (found.verdict != Verdict::proved) {
    found.statement += ".";
    return found;
  }
  const std::vector<Quantity> settling = settling_evidence(promises);
  found.evidence.insert(found.evidence.end(), settling.begin(), settling.end());
  found.evidence.push_back({"ultimate_frequency_error", of(promises.ultimate), Sense::bounds_above});
  // The statements of the evidence are checked beside this.
  const Tree& evidence = claim.at("evidence");
  const Tree* bound = evidence.find("frequency_error_bound");
  if (bound != nullptr) {
    found.statement += ": the frequency error never exceeds " + words_.at_most(high_of(*bound));
  }
  if (const auto settled = settling_claim(evidence)) {
    const std::string error = words_.at_most(settled->frequency_error);
    // A bound that is no smaller than the one never exceeded adds nothing.
    if (bound == nullptr || (certainly_less(settled->frequency_error, high_of(*bound)) &&
                             error != words_.at_most(high_of(*bound)))) {
      found.statement +=
          "; from sample " + upper_decimal(settled->samples) + " on it stays at or below " + error;
    }
  }
  if (const Tree* ultimate = evidence.find("ultimate_frequency_error")) {
    found.statement += "; in the long run it is at most " + words_.at_most(high_of(*ultimate));
  }
  found.statement += ".";
  return found;
}

Claim Guarantee::losing_lock(const Promises& promises) const {
  Claim found;
  found.statement = hypotheses(promises) + short_text(kLosingLock) + ".";
  found.verdict = proved_if(is_lock(promises.lock_reach) &&
                            certainly_less(of(promises.losing_lock), losing_lock_->value));
  found.evidence = {{"probability_of_losing_lock", of(promises.losing_lock), Sense::bounds_above}};
  return found;
}

Claim Guarantee::mean_square(const Promises& promises) const {
  Claim found;
  found.statement = hypotheses(promises) + short_text(kMeanSquare) + ".";
  found.verdict = proved_if(is_lock(promises.lock_reach) && certainly_less(of(promises.rms), rms_->value));
  found.evidence = {{"rms_frequency_error", of(promises.rms), Sense::bounds_above}};
  return found;
}

/// With Gaussian noise: the probability that the tracker loses lock, and the meaning of that.
Claim Guarantee::lock_sentence(const Tree& claim, const Promises& promises) const {
  const Tree& evidence = claim.at("evidence");
  Claim found;
  found.is_summary = true;
  // The bound named in the sentence also separates it from other locks.
  found.verdict = proved_if(promises.losing_lock.has_value() && is_lock(promises.lock_reach) &&
                            is_lock(high_of(evidence.at("lock_frequency_error"))));
  found.evidence = {{"probability_of_losing_lock", of(promises.losing_lock), Sense::bounds_above},
                    {"lock_frequency_error", of(promises.lock_reach), Sense::bounds_above}};
  found.hypotheses = hypotheses(promises);
  found.statement =
      found.hypotheses + "the probability that the tracker loses its lock " + stretch_of_samples() +
      ", its frequency error exceeding " + words_.at_most(high_of(evidence.at("lock_frequency_error"))) +
      " at one of them, is at most " + upper_decimal(high_of(evidence.at("probability_of_losing_lock")));
  if (const Tree* rms = evidence.find("rms_frequency_error")) {
    found.statement +=
        "; while it is in lock, the root mean square of its frequency error over them is at most " +
        words_.at_most(high_of(*rms));
    found.evidence.push_back({"rms_frequency_error", of(promises.rms), Sense::bounds_above});
    if (!promises.rms) {
      found.verdict = Verdict::undecided;
    }
  }
  found.statement += ".";
  return found;
}

/// The sentence at the lowest SNR for which there is a set.
Claim Guarantee::lowest_snr(const Tree& claim, const Promises& promises) const {
  constexpr int kDigits = 4;
  Guarantee there(*this);
  there.other_snr_ = upper_decimal(high_of(claim.at("evidence").at("lowest_snr")), kDigits);
  Promises at_lowest;
  at_lowest.losing_lock = promises.losing_lock_at_lowest_snr;
  at_lowest.lock_reach = promises.reach_at_lowest_snr;
  at_lowest.covariance = promises.covariance_at_lowest_snr;
  Claim found = there.lock_sentence(claim, at_lowest);
  if (!promises.lowest_snr) {
    found.verdict = Verdict::undecided;
  }
  found.evidence.push_back({"lowest_snr", of(promises.lowest_snr), Sense::bounds_above});
  return found;
}

Claim Guarantee::check(const Tree& claim, const Promises& promises, Objections& objections) const {
  const std::string& id = claim.at("id").text();
  const bool asked = id == kSentence || id == kSet || id == kLimits || id == kLowestSnr ||
                     std::any_of(required_.begin(), required_.end(),
                                 [&](const Requirement& requirement) { return requirement.claim == id; });
  if (!asked) {
    objections.emplace_back("[require] does not ask for this");
    return {};
  }
  if (wording_.deviation) {
    if (id != kSentence && id != kLosingLock && id != kMeanSquare && id != kLowestSnr) {
      objections.emplace_back("this is for noise with a bound");
      return {};
    }
    Claim gaussian = id == kSentence     ? lock_sentence(claim, promises)
                     : id == kLowestSnr  ? lowest_snr(claim, promises)
                     : id == kMeanSquare ? mean_square(promises)
                                         : losing_lock(promises);
    check_claim(claim, gaussian, objections);
    return gaussian;
  }
  if (id == kLowestSnr) {
    objections.emplace_back("this is for Gaussian noise");
    return {};
  }
  Claim found = id == kBound      ? frequency_error(promises)
                : id == kSettling ? settling(promises)
                : id == kSentence ? sentence(claim, promises)
                : id == kSet      ? invariant_set(claim, promises)
                : id == kLimits   ? limits(claim, promises)
                                  : size(id, promises);
  check_claim(claim, found, objections);
  return found;
}

}  // namespace veritrack::checker

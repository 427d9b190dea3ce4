#include "certificates/sets/guarantee_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/sets/kalman_filter_result.hpp"
#include "analysis/sets/lock_limit.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kDigits = 3;
constexpr const char* kGuarantee = "ekf/guarantee";

const Claim* find_claim(const Certificate& certificate, const std::string& id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const Claim& claim) { return claim.id == id; });
  return found == certificate.claims.end() ? nullptr : &*found;
}

/// Whether the radii are those of larger sets than the one with the rate.
bool has_sets_for_the_radius(const Certificate& certificate) {
  const theorems::Derivation* derivation = find_derivation(certificate, "contraction");
  return derivation != nullptr &&
         std::any_of(derivation->evidence.begin(), derivation->evidence.end(),
                     [](const theorems::Evidence& one) { return one.name == "frequency-error-radius"; });
}

bool is_zero(const Number& number) {
  return number.value == Interval(0.0);
}

/// Whether the settled error is below the bound at every sample, as sentences write the two. Otherwise naming
/// it adds nothing.
bool settles_below(const sets::StartResult& starts, const Interval& bound, const FrequencyUnits& units) {
  const theorems::Quantity& settled = starts.settled_frequency_error;
  return starts.settling_samples.applies() && settled.applies() && settled.value.upper() < bound.upper() &&
         units.at_most(settled.value, kDigits) != units.at_most(bound, kDigits);
}

/// The reason why the bound is true, and its value in the long run.
std::string ground(const sets::StartResult& starts) {
  const std::optional<theorems::Quantity>& captured = starts.capture_samples;
  std::string text = "All these starts lie in a certified invariant set.";
  if (captured && captured->applies() && captured->value.upper() > 0.0) {
    text = fmt::format(
        "Verified propagation shows that every such start enters a certified invariant set within {} "
        "samples.",
        rigor::upper_decimal(captured->value, kDigits));
  }
  return text;
}

/// The hypothesis that fails, by how much, and a repair.
std::string objection(const sets::StartResult& starts) {
  const theorems::Condition* refuted = starts.first_condition(Verdict::refuted);
  const theorems::Condition* failing = refuted != nullptr ? refuted : starts.first_open_condition();
  if (failing == nullptr) {
    return "An invariant set is certified, but the assumed start is not proved to lie in it.";
  }
  return failing->reason + (starts.proved_instead.empty() ? "" : " Proved instead: " + starts.proved_instead);
}

}  // namespace

std::string assumed_disturbance(const GuaranteeTerms& terms) {
  const Assumptions& assume = terms.assume;
  if (assume.gaussian) {
    return gaussian_disturbance(assume);
  }
  std::string text =
      is_zero(assume.slew) ? " and is constant" : " and changes by at most " + slew_words(assume.slew);
  if (is_zero(assume.noise)) {
    return text + ", without measurement noise";
  }
  text += ", with measurement noise of at most " + assume.noise.text;
  return text + (terms.two_channels
                     ? fmt::format(" (the length of the error in both channels; {} in each is enough)",
                                   rigor::lower_decimal(assume.noise.value / sqrt(Interval(2.0)), kDigits))
                     : "");
}

std::string lock_words(const GuaranteeTerms& terms) {
  std::string limit = "3.14";
  if (!terms.two_channels) {
    const rigor::UpwardRounding upward;
    const auto& [low, high] = terms.assume.frequency;
    limit = rigor::lower_decimal(rigor::max(rigor::min(low.value, rigor::pi() - high.value), Interval(0.0)),
                                 kDigits);
  }
  return FrequencyUnits(terms.assume.sample_rate).at_most(limit);
}

bool is_lock(const Interval& frequency_error, const GuaranteeTerms& terms) {
  const rigor::UpwardRounding upward;
  const auto& [low, high] = terms.assume.frequency;
  return terms.two_channels ? sets::excludes_other_locks(frequency_error)
                            : sets::excludes_other_locks(frequency_error, hull(low.value, high.value));
}

std::string disturbance_of(const std::string& noise, const std::string& slew) {
  return (slew.empty() ? " and is constant"
                       : fmt::format(" and changes by at most {} rad/sample per sample", slew)) +
         (noise.empty()
              ? ", without measurement noise"
              : fmt::format(", with measurement noise of at most {} of the amplitude (the length of "
                            "the error in both channels)",
                            noise));
}

std::string tone(const GuaranteeTerms& terms, bool disturbed) {
  const Assumptions& assume = terms.assume;
  std::string text =
      fmt::format("{}, for a tone of constant amplitude {}{} whose frequency ", terms.arithmetic,
                  assume.amplitude.text, FrequencyUnits(assume.sample_rate).sampled());
  text += terms.in_band ? fmt::format("lies between {} and {}", assume.frequency[0].text,
                                      frequency_words(assume.frequency[1]))
                        : "is at most pi rad/sample";
  return text + (disturbed ? assumed_disturbance(terms) : "");
}

std::string hypotheses(const GuaranteeTerms& terms) {
  return hypotheses(terms, assumed_disturbance(terms));
}

std::string hypotheses(const GuaranteeTerms& terms, const std::string& disturbance) {
  const Assumptions& assume = terms.assume;
  return fmt::format(
      "{}{}, started within {} of the true frequency, {} rad of the phase and {} of the "
      "amplitude{}{}, ",
      tone(terms, false), disturbance, frequency_words(assume.initial_frequency_error),
      assume.initial_phase_error.text, assume.initial_amplitude_error.text,
      terms.covariance.empty() ? "" : " ", terms.covariance);
}

Claim guarantee_claim(const Certificate& certificate, const GuaranteeTerms& terms) {
  const sets::StartResult& starts = certificate.contraction.value().starts;
  const std::optional<Interval> bound = starts.proved_bound();
  const FrequencyUnits units(terms.assume.sample_rate);
  const std::optional<Number>& required = terms.require.frequency_error_below;
  const Claim* requirement = find_claim(certificate, "ekf/frequency-error-bound");
  Claim claim;
  claim.id = kGuarantee;
  claim.hypotheses = hypotheses(terms);
  claim.statement =
      claim.hypotheses + (required ? requirement->requirement : "the tracker keeps its lock for ever");
  // Without a required bound the claim is that lock is kept.
  if (bound && (requirement == nullptr ? is_lock(*bound, terms) : requirement->verdict == Verdict::proved)) {
    claim.verdict = Verdict::proved;
    claim.statement += ": the frequency error never exceeds " + units.at_most(*bound, kDigits);
    claim.evidence = {starts.frequency_error_bound};
    if (settles_below(starts, *bound, units)) {
      claim.statement += fmt::format("; from sample {} on it stays at or below {}",
                                     rigor::upper_decimal(starts.settling_samples.value, kDigits),
                                     units.at_most(starts.settled_frequency_error.value, kDigits));
      claim.evidence.push_back(starts.settling_samples);
      claim.evidence.push_back(starts.settled_frequency_error);
    }
    if (starts.ultimate_frequency_error.applies()) {
      claim.statement +=
          "; in the long run it is at most " + units.at_most(starts.ultimate_frequency_error.value, kDigits);
      claim.evidence.push_back(starts.ultimate_frequency_error);
    }
    claim.reason = ground(starts);
  } else if (requirement != nullptr && (bound || requirement->verdict == Verdict::refuted)) {
    claim.verdict = requirement->verdict;
    claim.reason = requirement->reason;
  } else {
    claim.verdict = starts.loses_lock && !required ? Verdict::refuted : Verdict::undecided;
    claim.reason = objection(starts);
  }
  claim.statement += ".";
  return claim;
}

std::vector<Claim> set_claims(const Certificate& certificate, const GuaranteeTerms& terms) {
  const sets::KalmanFilterResult& found = certificate.contraction.value();
  const FrequencyUnits units(terms.assume.sample_rate);
  std::vector<Claim> claims;
  if (found.frequency_error_radius.applies() && found.contraction_rate.applies()) {
    Claim claim;
    claim.id = "ekf/invariant-set";
    claim.verdict = Verdict::proved;
    claim.hypotheses = tone(terms, true);
    claim.statement = fmt::format(
        "{}, a certified invariant set contains frequency errors up to {} and none of {} or more{}",
        claim.hypotheses, units.at_least(found.frequency_error_radius.value, kDigits), lock_words(terms),
        found.about_steady_state ? ", measured from the steady state, which the leak biases" : "");
    claim.evidence = {found.frequency_error_radius};
    if (!has_sets_for_the_radius(certificate)) {
      claim.statement += fmt::format(
          "; in it, {} by at most {}{}, before noise and slew",
          found.rate_window == 1 ? "each sample multiplies the error" : "the error is multiplied",
          rigor::upper_decimal(found.contraction_rate.value, kDigits),
          found.rate_window == 1 ? std::string()
                                 : fmt::format(" per sample on average over {} samples", found.rate_window));
      claim.evidence.push_back(found.contraction_rate);
    }
    claim.statement += ".";
    claims.push_back(std::move(claim));
  }
  if (found.largest_noise.applies() && found.largest_slew.applies()) {
    Claim claim;
    claim.id = "ekf/limits";
    claim.verdict = Verdict::proved;
    claim.hypotheses = tone(terms, false);
    claim.statement = fmt::format(
        "{}, at a constant frequency the tracker tolerates noise up to {} of the amplitude, and without "
        "noise a slew "
        "up to {}: a certified invariant set exists for each, in which the frequency error stays below {}.",
        claim.hypotheses, rigor::lower_decimal(found.largest_noise.value, kDigits),
        units.slew(found.largest_slew.value, kDigits), lock_words(terms));
    claim.evidence = {found.largest_noise, found.largest_slew};
    claims.push_back(std::move(claim));
  }
  return claims;
}

std::vector<const Claim*> guarantees(const Certificate& certificate) {
  std::vector<const Claim*> found;
  for (const char* id : {kGuarantee, "ekf/invariant-set", "ekf/limits", "ekf/lowest-snr"}) {
    if (const Claim* claim = find_claim(certificate, id)) {
      found.push_back(claim);
    }
  }
  return found;
}

}  // namespace veritrack::certificates

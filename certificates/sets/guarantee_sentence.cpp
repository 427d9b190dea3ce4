#include "certificates/sets/guarantee_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/decimal.hpp"
#include "analysis/sets/contraction_result.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"

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

bool is_zero(const Number& number) {
  return number.value == Interval(0.0);
}

/// "With measurement noise of at most 0.001 and a constant frequency, started within ..., "
std::string assumptions(const GuaranteeTerms& terms) {
  const Assumptions& assume = terms.assume;
  std::string text = is_zero(assume.noise) ? "Without measurement noise"
                                           : "With measurement noise of at most " + assume.noise.text;
  text += is_zero(assume.slew)
              ? " and at a constant frequency"
              : fmt::format(" and a frequency that changes by at most {} rad/sample per sample",
                            assume.slew.text);
  if (terms.in_band) {
    text += fmt::format(" between {} and {} rad/sample", assume.frequency[0].text, assume.frequency[1].text);
  }
  return text + fmt::format(
                    ", started within {} rad/sample of the true frequency, {} rad of the phase and {} of the "
                    "amplitude ({}), ",
                    assume.initial_frequency_error.text, assume.initial_phase_error.text,
                    assume.initial_amplitude_error.text, assume.amplitude.text);
}

/// Why the bound is true, and its value in the long run.
std::string ground(const sets::StartResult& starts) {
  const std::optional<theorems::Quantity>& captured = starts.capture_samples;
  std::string text = "All these starts lie in a certified invariant set. ";
  if (captured && captured->applies() && captured->value.upper() > 0.0) {
    text = fmt::format(
        "Verified propagation shows that every such start enters a certified invariant set within {} "
        "samples. ",
        rigor::upper_decimal(captured->value, kDigits));
  }
  const theorems::Quantity& ultimate = starts.ultimate_frequency_error;
  if (ultimate.applies()) {
    const theorems::Quantity& samples = starts.settling_samples;
    text += fmt::format("In the long run the frequency error is at most {} rad/sample",
                        rigor::upper_decimal(ultimate.value, kDigits));
    const bool takes_time = samples.applies() && samples.value.upper() > 0.0;
    text += takes_time ? fmt::format(", and at most twice that after {} samples.",
                                     rigor::upper_decimal(samples.value, kDigits))
                       : ".";
  }
  return text;
}

/// Which hypothesis fails, by how much, and what would repair it.
std::string objection(const sets::StartResult& starts) {
  const theorems::Condition* refuted = starts.first_condition(Verdict::refuted);
  const theorems::Condition* failing = refuted != nullptr ? refuted : starts.first_open_condition();
  if (failing == nullptr) {
    return "An invariant set is certified, but the assumed start is not proved to lie in it.";
  }
  return failing->reason + (starts.proved_instead.empty() ? "" : " What is PROVED: " + starts.proved_instead);
}

}  // namespace

Claim guarantee_claim(const Certificate& certificate, const GuaranteeTerms& terms) {
  const sets::StartResult& starts = certificate.contraction.value().starts;
  const std::optional<Interval> bound = starts.proved_bound();
  const std::optional<Number>& required = terms.require.frequency_error_below;
  const Claim* requirement = find_claim(certificate, "ekf/frequency-error-bound");
  Claim claim;
  claim.id = kGuarantee;
  claim.statement = assumptions(terms);
  claim.statement +=
      required ? fmt::format("the frequency error stays below {} rad/sample for ever", required->text)
      : bound  ? fmt::format("the frequency error never exceeds {} rad/sample",
                             rigor::upper_decimal(*bound, kDigits))
               : "the tracker keeps its lock for ever";
  if (bound && (requirement == nullptr || requirement->verdict == Verdict::proved)) {
    claim.verdict = Verdict::proved;
    claim.statement +=
        required ? fmt::format(": it never exceeds {} rad/sample", rigor::upper_decimal(*bound, kDigits))
                 : "";
    claim.reason = ground(starts);
    claim.evidence = {starts.frequency_error_bound};
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

std::string guarantee_section(const Certificate& certificate) {
  const Claim* claim = find_claim(certificate, kGuarantee);
  if (claim == nullptr) {
    return "";
  }
  std::string text = fmt::format("{}: {}\n\n{}: {}\n\n", markdown::verdict(claim->verdict), claim->statement,
                                 claim->verdict == Verdict::proved ? "Why" : "Why not", claim->reason);
  const sets::ContractionResult& found = certificate.contraction.value();
  if (found.frequency_error_radius.applies() && found.contraction_rate.applies()) {
    text += fmt::format(
        "- The largest certified invariant set, under the assumed noise and slew, contains frequency errors "
        "up to {} rad/sample{}; in it, {} by at most {}{}, before noise and slew.\n",
        rigor::lower_decimal(found.frequency_error_radius.value, kDigits),
        found.about_steady_state ? ", measured from the steady state, which the leak biases" : "",
        found.rate_window == 1 ? "each sample multiplies the error" : "the error is multiplied",
        rigor::upper_decimal(found.contraction_rate.value, kDigits),
        found.rate_window == 1 ? std::string()
                               : fmt::format(" per sample on average over {} samples", found.rate_window));
  }
  if (found.largest_noise.applies() && found.largest_slew.applies()) {
    text += fmt::format(
        "- Limits of this design: at a constant frequency, the tracker tolerates noise up to {} of the "
        "amplitude; without noise, it tolerates a slew up to {} rad/sample per sample. A certified invariant "
        "set exists for each.\n",
        rigor::lower_decimal(found.largest_noise.value, kDigits),
        rigor::lower_decimal(found.largest_slew.value, kDigits));
  }
  return text;
}

std::optional<std::string> proved_bound_headline(const Certificate& certificate) {
  const std::optional<Interval> bound = proved_frequency_bound(certificate);
  if (!bound) {
    return std::nullopt;
  }
  return fmt::format(
      "Nothing is required of this design; PROVED: the frequency error stays at or below {} rad/sample for "
      "ever",
      rigor::upper_decimal(*bound, kDigits));
}

}  // namespace veritrack::certificates

#include "certificates/sets/guarantee_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::applicable_quantity;

constexpr const char* kGuarantee = "ekf/guarantee";

const Claim* find_claim(const Certificate& certificate, const std::string& id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const Claim& claim) { return claim.id == id; });
  return found == certificate.claims.end() ? nullptr : &*found;
}

/// Of the derivation "contraction", which describes the certified set.
const theorems::Quantity* find_of_set(const Certificate& certificate, const std::string& name) {
  const theorems::Derivation* derivation = find_derivation(certificate, "contraction");
  return derivation == nullptr ? nullptr : applicable_quantity(*derivation, name);
}

std::string up(const Interval& value) {
  return rigor::to_decimal(value.upper(), 3, rigor::Direction::up);
}
std::string down(const Interval& value) {
  return rigor::to_decimal(value.lower(), 3, rigor::Direction::down);
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

/// Why the bound holds, and what it comes to in the long run.
std::string ground(const Certificate& certificate) {
  const theorems::Derivation& derivation = *deciding_derivation(certificate);
  std::string text;
  const auto* captured = applicable_quantity(derivation, "capture_samples");
  if (captured != nullptr && captured->value.upper() > 0.0) {
    text = fmt::format(
        "Every such start is followed, by verified propagation, into a set that the tracker never leaves: it "
        "is there after at most {} samples. ",
        up(captured->value));
  } else {
    text = "All these starts lie in a set that the tracker never leaves. ";
  }
  if (const auto* ultimate = applicable_quantity(derivation, "ultimate_frequency_error")) {
    text += fmt::format("In the long run the frequency error is at most {} rad/sample", up(ultimate->value));
    const auto* samples = applicable_quantity(derivation, "settling_samples");
    const bool takes_time = samples != nullptr && samples->value.upper() > 0.0;
    text += takes_time ? fmt::format(", and at most twice that after {} samples.", up(samples->value)) : ".";
  }
  return text;
}

/// Which hypothesis fails, by how much, and what would repair it.
std::string objection(const Certificate& certificate) {
  const theorems::Derivation& derivation = *deciding_derivation(certificate);
  for (const Verdict verdict : {Verdict::refuted, Verdict::undecided}) {
    for (const theorems::Condition& condition : derivation.conditions) {
      if (condition.verdict == verdict) {
        std::string text = condition.reason;
        for (const char* id : {"ekf/capture-at-reduced-noise", "ekf/capture-noise-free"}) {
          const Claim* weaker = find_claim(certificate, id);
          if (weaker != nullptr && weaker->verdict == Verdict::proved) {
            return text + " What is PROVED: " + weaker->statement;
          }
        }
        return text;
      }
    }
  }
  return "A set that is never left is certified, but not that the assumed start lies in it.";
}

}  // namespace

Claim guarantee_claim(const Certificate& certificate, const GuaranteeTerms& terms) {
  const std::optional<Number>& required = terms.require.frequency_error_below;
  const Claim* requirement = find_claim(certificate, "ekf/frequency-error-bound");
  const Claim* capture = find_claim(certificate, "ekf/capture");
  const std::optional<Interval> bound = proved_frequency_bound(certificate);
  const bool meets = requirement == nullptr || requirement->verdict == Verdict::proved;
  Claim claim;
  claim.id = kGuarantee;
  claim.statement = assumptions(terms);
  if (bound && meets) {
    claim.verdict = Verdict::proved;
    claim.statement += required ? fmt::format(
                                      "the frequency error stays below {} rad/sample for ever: it "
                                      "never exceeds {} rad/sample.",
                                      required->text, up(*bound))
                                : fmt::format("the frequency error never exceeds {} rad/sample.", up(*bound));
    claim.reason = ground(certificate);
    claim.evidence = {*applicable_quantity(*deciding_derivation(certificate), "frequency_error_bound")};
    return claim;
  }
  claim.statement +=
      required ? fmt::format("the frequency error stays below {} rad/sample for ever.", required->text)
               : "the tracker keeps its lock for ever.";
  if (requirement != nullptr && (bound || requirement->verdict == Verdict::refuted)) {
    claim.verdict = requirement->verdict;
    claim.reason = requirement->reason;
  } else {
    claim.verdict = capture != nullptr && capture->verdict == Verdict::refuted && !required
                        ? Verdict::refuted
                        : Verdict::undecided;
    claim.reason = objection(certificate);
  }
  return claim;
}

std::string guarantee_section(const Certificate& certificate) {
  const Claim* claim = find_claim(certificate, kGuarantee);
  if (claim == nullptr) {
    return "";
  }
  std::string text =
      fmt::format("{}: {}\n\n{}: {}\n\n", markdown::verdict(claim->verdict), claim->statement,
                  claim->verdict == Verdict::proved ? "Why" : "What stands in the way", claim->reason);
  const auto* radius = find_of_set(certificate, "frequency_error_radius");
  const auto* rate = find_of_set(certificate, "contraction_rate");
  const auto* noise = find_of_set(certificate, "largest_noise");
  const auto* slew = find_of_set(certificate, "largest_slew");
  const auto* bias = find_of_set(certificate, "bias_frequency");
  const bool off_the_truth = bias != nullptr && !(bias->value == Interval(0.0));
  if (radius != nullptr && rate != nullptr) {
    text += fmt::format(
        "- The largest certified set, under the assumed noise and slew, reaches to a frequency error of {} "
        "rad/sample{}; in it errors shrink to at most {} of themselves each sample, apart from what noise "
        "and "
        "slew add.\n",
        down(radius->value),
        off_the_truth ? " about the steady state, which the leak puts off the truth" : "", up(rate->value));
  }
  if (noise != nullptr && slew != nullptr) {
    text += fmt::format(
        "- Limits of this design: a set that is never left is certified for noise up to {} of the amplitude "
        "(at a constant frequency), and for a slew up to {} rad/sample per sample (without noise).\n",
        down(noise->value), down(slew->value));
  }
  return text;
}

std::optional<std::string> proved_bound_headline(const Certificate& certificate) {
  const std::optional<Interval> bound = proved_frequency_bound(certificate);
  if (!bound) {
    return std::nullopt;
  }
  return fmt::format(
      "Nothing is required of this design; PROVED of it: the frequency error stays at or below {} "
      "rad/sample for ever",
      up(*bound));
}

}  // namespace veritrack::certificates

#include "certificates/sets/required_claims.hpp"

#include <fmt/format.h>

#include "analysis/rigor/decimal.hpp"
#include "analysis/sets/kalman_filter_result.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The reason why the contraction certificate does not cover the assumptions, as a sentence.
std::string contraction_objection(const sets::StartResult& starts) {
  if (const theorems::Condition* open = starts.first_open_condition()) {
    return fmt::format("The contraction certificate does not cover this design and start ({}: {})", open->id,
                       open->reason);
  }
  return "The contraction certificate gives no bound for the assumed start.";
}

Claim frequency_error_claim(const sets::StartResult& starts, const GuaranteeTerms& terms) {
  const Assumptions& assume = terms.assume;
  const Number& required = *terms.require.frequency_error_below;
  const std::optional<Interval> bound = starts.proved_bound();
  const std::optional<theorems::Quantity>& wrong_lock = starts.wrong_lock_frequency_error;
  const FrequencyUnits units(assume.sample_rate);
  Claim claim =
      required_claim("ekf/frequency-error-bound",
                     fmt::format("the frequency error stays below {} for ever", frequency_words(required)),
                     hypotheses(terms), required);
  if (bound && rigor::certainly_less(*bound, required.value)) {
    claim.verdict = Verdict::proved;
    claim.reason = fmt::format("By contraction it stays at or below {}.", units.at_most(*bound));
    claim.evidence = {starts.frequency_error_bound};
  } else if (same_number(required, assume.initial_frequency_error) ||
             rigor::certainly_less_equal(required.value, assume.initial_frequency_error.value)) {
    claim.verdict = Verdict::refuted;
    claim.reason = fmt::format(
        "Witness: [assume] (initial_frequency_error) allows a start with a frequency error of {}, which is "
        "not "
        "below the bound at the first sample.",
        frequency_words(assume.initial_frequency_error));
  } else if (wrong_lock && wrong_lock->applies() &&
             rigor::certainly_less_equal(required.value, wrong_lock->value)) {
    claim.verdict = Verdict::refuted;
    claim.reason = contraction_objection(starts);
    claim.evidence = {*wrong_lock};
  } else if (bound) {
    claim.reason = fmt::format("The certified bound is {}, which is not below {}.", units.at_most(*bound),
                               required.text);
  } else {
    claim.reason = contraction_objection(starts);
  }
  return claim;
}

Claim settling_claim(const sets::StartResult& starts, const GuaranteeTerms& terms) {
  const Number& within = *terms.require.settles_within;
  const Number& below = *terms.require.settled_below;
  const bool covered = starts.verdict == Verdict::proved;
  const theorems::Quantity& samples = starts.settling_samples;
  const theorems::Quantity& error = starts.settled_frequency_error;
  Claim claim = required_claim("ekf/settling-time",
                               fmt::format("from sample {} on, the frequency error stays below {}",
                                           within.text, frequency_words(below)),
                               hypotheses(terms), within);
  if (covered && samples.applies() && error.applies()) {
    const bool settles = rigor::certainly_less_equal(samples.value, within.value) &&
                         rigor::certainly_less(error.value, below.value);
    claim.verdict = settles ? Verdict::proved : Verdict::undecided;
    claim.reason =
        fmt::format("By contraction it stays at or below {} from sample {} on{}.",
                    FrequencyUnits(terms.assume.sample_rate).at_most(error.value),
                    rigor::upper_decimal(samples.value), settles ? "" : ", which is not what is required");
    claim.evidence = {samples, error};
  } else if (covered) {
    claim.reason = samples.not_applicable.value_or("No settling time is certified.");
  } else {
    claim.reason = contraction_objection(starts);
  }
  return claim;
}

/// A key of [require] that requires a certified quantity of at least that size.
struct LeastSize {
  const char* claim;  ///< id
  const theorems::Quantity& certified;
  std::string statement;           ///< with {} for the number as written
  const char* largest;             ///< the words for the quantity, for the reason
  Interval scale;                  ///< from the quantity's unit to the requirement's
  bool under_assumptions = false;  ///< the assumed noise and slew are among the hypotheses
  const char* addition = "";       ///< to the sentence
  /// The number of the key as the statement has it; null: as written.
  std::string (*words)(const Number&) = nullptr;
};

Claim least_size_claim(const LeastSize& size, const GuaranteeTerms& terms, const Number& required) {
  const std::string tone_text = tone(terms, size.under_assumptions) + ", ";
  Claim claim = required_claim(
      size.claim,
      fmt::format(fmt::runtime(size.statement), size.words == nullptr ? required.text : size.words(required)),
      tone_text, required);
  claim.statement.insert(claim.statement.size() - 1, size.addition);
  if (!size.certified.applies()) {
    claim.reason = fmt::format("No {} could be certified.", size.largest);
    return claim;
  }
  const Interval value = size.certified.value * size.scale;
  claim.verdict = rigor::certainly_less_equal(required.value, value) ? Verdict::proved : Verdict::undecided;
  const FrequencyUnits units(terms.assume.sample_rate);
  const std::string shown = !units.has_hertz() || size.words == nullptr ? rigor::lower_decimal(value)
                            : size.words == slew_words                  ? units.slew(value)
                                                                        : units.at_least(value);
  claim.reason = fmt::format(
      "The largest certified {} is {}{}.", size.largest, shown,
      claim.verdict == Verdict::proved ? std::string() : fmt::format("; {} was required", required.text));
  claim.evidence = {size.certified};
  return claim;
}

}  // namespace

Claim required_claim(const char* id, std::string requirement, const std::string& hypotheses,
                     const Number& required) {
  Claim claim;
  claim.id = id;
  claim.statement = hypotheses + requirement + ".";
  claim.requirement = std::move(requirement);
  claim.required = true;
  claim.position = required.position;
  return claim;
}

void add_required_claims(Certificate& certificate, const GuaranteeTerms& terms) {
  const Assumptions& assume = terms.assume;
  const Requirements& require = terms.require;
  const sets::KalmanFilterResult& found = certificate.contraction.value();
  const std::string lock = lock_words(terms);
  const std::string in_lock =
      ": a certified invariant set exists, in which the frequency error stays below " + lock;
  const auto add_least_size = [&](const std::optional<Number>& required, const LeastSize& size) {
    if (required) {
      certificate.claims.push_back(least_size_claim(size, terms, *required));
    }
  };
  if (require.frequency_error_below) {
    certificate.claims.push_back(frequency_error_claim(found.starts, terms));
  }
  if (require.settles_within) {
    certificate.claims.push_back(settling_claim(found.starts, terms));
  }
  add_least_size(require.largest_noise_at_least,
                 {"ekf/largest-noise", found.largest_noise,
                  "at a constant frequency, the tracker tolerates noise up to {}" + in_lock,
                  "noise at a constant frequency", assume.amplitude.value});
  add_least_size(require.largest_slew_at_least,
                 {"ekf/largest-slew", found.largest_slew,
                  "without noise, the tracker tolerates a slew up to {}" + in_lock, "slew without noise",
                  Interval(1.0), false, "", slew_words});
  add_least_size(
      require.frequency_error_radius_at_least,
      {"ekf/frequency-error-radius", found.frequency_error_radius,
       "under the assumed noise and slew, a certified invariant set contains frequency errors up to {} and "
       "none of " +
           lock + " or more",
       "frequency error in an invariant set", Interval(1.0), true,
       found.about_steady_state ? ", measured from the steady state, which the leak biases" : "",
       frequency_words});
  conclude_requirements(certificate);
}

void conclude_requirements(Certificate& certificate) {
  std::vector<Verdict> verdicts;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      verdicts.push_back(claim.verdict);
    }
  }
  if (!verdicts.empty()) {
    certificate.verdict = rigor::conjunction(verdicts);
  }
}

}  // namespace veritrack::certificates

#include "certificates/quadrature/lock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/quadrature/gaussian/lock_answer.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/lowest_snr.hpp"
#include "certificates/quadrature/mean_square.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kShownDigits = 3;

/// The reason why nothing is certified.
std::string open_condition(const theorems::Derivation& derivation) {
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict != Verdict::proved) {
      return fmt::format("No probability is certified for this design and start ({}: {})", condition.id,
                         condition.reason);
    }
  }
  return "No probability is certified: design, noise or start are out of range.";
}

Claim probability_claim(const theorems::Derivation& derivation, const GuaranteeTerms& terms) {
  const Number& required = *terms.require.probability_of_losing_lock_below;
  const theorems::Quantity* probability =
      theorems::applicable_quantity(derivation, "probability_of_losing_lock");
  Claim claim;
  claim.id = "ekf/probability-of-losing-lock";
  claim.requirement =
      fmt::format("the probability of losing lock, a frequency error of {} or more, is below {} {}",
                  lock_words(terms), required.text, stretch_of_samples(terms.assume));
  claim.statement = hypotheses(terms) + claim.requirement + ".";
  claim.required = true;
  claim.position = required.position;
  if (probability == nullptr) {
    claim.reason = open_condition(derivation);
    return claim;
  }
  const theorems::Quantity* reach = theorems::applicable_quantity(derivation, "lock_frequency_error");
  const bool below = rigor::certainly_less(probability->value, required.value) && reach != nullptr &&
                     is_lock(reach->value, terms);
  claim.verdict = below ? Verdict::proved : Verdict::undecided;
  claim.reason = fmt::format("It is at most {}{}.", rigor::upper_decimal(probability->value, kShownDigits),
                             below ? "" : ", which is not below what is required");
  claim.evidence = {*probability};
  return claim;
}

}  // namespace

quadrature::LockQuestion lock_question(const QuadratureEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  const Interval& amplitude = assume.amplitude.value;
  quadrature::LockQuestion question;
  question.design = enclosed_at_unit_amplitude(tables);
  question.noise_deviation = deviation_at_unit_amplitude(assume);
  question.frequency_walk = assume.frequency_walk ? assume.frequency_walk->value : Interval(0.0);
  question.samples = assume.samples.value().value;
  question.starts = {assume.initial_amplitude_error.value / amplitude, assume.initial_phase_error.value,
                     assume.initial_frequency_error.value, start_covariance(tables)};
  question.signal.amplitude = amplitude;
  question.frequencies = hull(assume.frequency[0].value, assume.frequency[1].value);
  for (const Number& end : assume.frequency) {
    question.signal.largest_frequency =
        std::max(question.signal.largest_frequency, rigor::magnitude(end.value));
  }
  if (const auto& required = tables.require.probability_of_losing_lock_below) {
    question.probability = required->nearest;
  }
  return question;
}

Claim lock_guarantee(const theorems::Derivation& derivation, const GuaranteeTerms& terms,
                     const theorems::Quantity* rms) {
  const theorems::Quantity* probability =
      theorems::applicable_quantity(derivation, "probability_of_losing_lock");
  const theorems::Quantity* reach = theorems::applicable_quantity(derivation, "lock_frequency_error");
  Claim claim;
  claim.id = "ekf/guarantee";
  claim.hypotheses = hypotheses(terms);
  claim.statement = claim.hypotheses;
  if (probability == nullptr || reach == nullptr || !is_lock(reach->value, terms)) {
    claim.statement += "the tracker keeps its lock with a stated probability.";
    claim.reason = open_condition(derivation);
    return claim;
  }
  const FrequencyUnits units(terms.assume.sample_rate);
  claim.verdict = Verdict::proved;
  claim.statement += fmt::format(
      "the probability that the tracker loses its lock {}, its frequency error exceeding {} at one of "
      "them, is at most {}",
      stretch_of_samples(terms.assume), units.at_most(reach->value, kShownDigits),
      rigor::upper_decimal(probability->value, kShownDigits));
  if (rms != nullptr) {
    claim.statement += fmt::format(
        "; while it is in lock, the root mean square of its frequency error over them is at most {}",
        units.at_most(rms->value, kShownDigits));
  }
  claim.statement += ".";
  claim.reason =
      "All these starts lie in a set in which the expected value of a function of errors and covariance "
      "hardly "
      "rises from sample to sample, whatever the state; to leave the set it would have to become very large.";
  claim.evidence = {*probability, *reach};
  if (rms != nullptr) {
    claim.evidence.push_back(*rms);
  }
  return claim;
}

void add_lock(Certificate& certificate) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  QuadratureParticulars& particulars = quadrature_particulars(certificate);
  {
    const rigor::NearestRounding nearest;
    particulars.start_covariance = start_covariance_text(tables);
  }
  quadrature::LockQuestion question = lock_question(tables);
  const auto& required_rms = tables.require.rms_frequency_error_below;
  if (required_rms) {
    question.required_rms = required_rms->nearest;
    question.enough_rms =
        certificate.extent == Extent::everything ? std::nullopt : std::optional(required_rms->nearest);
  }
  quadrature::LockAnswer answer =
      quadrature::answer_lock(question, certificate.extent == Extent::everything || required_rms);
  quadrature::LockCertificate found = answer.lock;
  particulars.lock_sets = found.sets;
  if (!found.sets.empty()) {
    add_start_covariance(particulars.start_covariance, found.covariance_multiples, found.derivation);
  }
  const theorems::Derivation derivation = found.derivation;
  certificate.derivations.push_back(derivation);
  const GuaranteeTerms terms{tables.assume,
                             tables.require,
                             !tables.design.without_leak(),
                             true,
                             covariance_words(particulars.start_covariance, found.covariance_multiples),
                             kDoublePrecision};
  if (answer.mean_square) {
    add_mean_square(certificate, question, std::move(answer));
  }
  if (tables.require.probability_of_losing_lock_below) {
    certificate.claims.push_back(probability_claim(derivation, terms));
  }
  if (tables.require.rms_frequency_error_below) {
    certificate.claims.push_back(mean_square_claim(certificate, terms));
  }
  conclude_requirements(certificate);
  const theorems::Derivation* mean_square = find_derivation(certificate, "mean-square");
  certificate.claims.push_back(lock_guarantee(
      derivation, terms,
      mean_square == nullptr ? nullptr : theorems::applicable_quantity(*mean_square, "rms_frequency_error")));
  if (certificate.extent == Extent::everything) {
    add_lowest_snr(certificate, question, found, terms);
  }
}

std::string lock_section(const Certificate& certificate) {
  std::string text;
  for (const theorems::Derivation& derivation : derivations_of(certificate, "lock")) {
    text += fmt::format("## What is certified for it: the probability of losing lock, conditions {}\n\n",
                        markdown::satisfied(derivation.verdict));
    text += fmt::format("{}. The proof is in `{}` of the program's sources.\n\n", derivation.title,
                        derivation.quantities.front().source);
    text += markdown::conditions_table(derivation) + "\n" + markdown::quantities_table(derivation) + "\n" +
            (derivation.notes.empty() ? "" : markdown::notes_list(derivation) + "\n");
  }
  return text;
}

std::string lock_coverage_section() {
  return "## What this certificate covers, and what it does not\n"
         "\n"
         "- Covered: every signal and every start that satisfy the assumptions, and every noise that is "
         "independent, of mean zero and sub-Gaussian with the stated deviation: Gaussian noise, bounded "
         "noise, and the error of a quantiser with dither are such. Noise that is coloured, or has a mean, "
         "is not covered.\n"
         "- *Losing lock* means that the errors leave a set in which the frequency error is at most the "
         "stated bound. Outside nothing is claimed: the tracker may come back. A sample whose noise is "
         "beyond 30 deviations counts as a loss as well.\n"
         "- *Any successive samples, however late*: the bound is on the probability that the tracker is in "
         "lock when they begin and loses lock in them. For a frequency that walks, the bound is on the first "
         "samples only.\n"
         "- *The root mean square in lock*, where it is stated, is the root of the mean over those samples "
         "of "
         "the expected square of the frequency error, samples after a loss of lock counting as 0.\n"
         "- It covers a signal of constant amplitude.\n"
         "- Every constant was computed with outward-rounded interval arithmetic from the design values. "
         "UNDECIDED means that nothing could be shown.\n"
         "- The tracker is covered as it runs in double precision: IEEE 754, rounding to nearest, sine and "
         "cosine of the C library within 1 ulp, without -ffast-math. The rounding error of a step is bounded "
         "and is within the room that the inequality leaves (docs/gaussian.md, section 7).\n"
         "- Figures show one simulated run in double precision, which proves nothing.\n"
         "\n";
}

}  // namespace veritrack::certificates

#include "certificates/quadrature/mean_square.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/quadrature/falsifier/sampled_text.hpp"
#include "analysis/quadrature/gaussian/leaking_filter.hpp"
#include "analysis/quadrature/gaussian/linear_filter.hpp"
#include "analysis/quadrature/gaussian/mean_square_certificate.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown_derivation.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;

constexpr int kShownRmsDigits = 3;
constexpr const char* kId = "mean-square";
constexpr const char* kRms = "rms_frequency_error";

/// The root mean square of the linearised filter; with a leak the largest at the ends of the pieces of the
/// band.
std::optional<double> linear_rms(const trackers::ToneModel<double>& design, double deviation, double walk,
                                 const std::vector<quadrature::LockSet>& sets) {
  if (design.epsilon == 0.0) {
    const quadrature::LockSet& set = sets.front();
    const auto filter = quadrature::linear_filter(design, set.centre);
    return filter ? std::optional(std::sqrt(quadrature::frequency_variance(*filter, deviation, walk)))
                  : std::nullopt;
  }
  double largest = 0.0;
  for (const quadrature::LockSet& set : sets) {
    for (const double frequency : {set.lowest_frequency, set.highest_frequency}) {
      const auto filter = quadrature::leaking_filter(design, frequency);
      const auto square = filter ? quadrature::mean_square_frequency_error(*filter, deviation) : std::nullopt;
      if (!square) {
        return std::nullopt;
      }
      largest = std::max(largest, std::sqrt(*square));
    }
  }
  return largest;
}

/// The values of the linearised filter and of the best possible one.
void add_linear(const quadrature::LockQuestion& question, const std::vector<quadrature::LockSet>& sets,
                theorems::Derivation& derivation) {
  const rigor::NearestRounding nearest;
  const auto& d = question.design;
  const bool leaks = !(d.epsilon == rigor::Interval(0.0));
  const double deviation = question.noise_deviation.upper();
  const double walk = question.frequency_walk.upper();
  if (const auto rms = linear_rms({midpoint(d.q1), midpoint(d.q2), midpoint(d.r), midpoint(d.epsilon)},
                                  deviation, walk, sets)) {
    quadrature::add_sampled(
        derivation,
        {"linear_rms_frequency_error",
         leaks ? "the same of the filter linearised about its steady state, the bias included, the largest "
                 "over "
                 "the band, in floating point, rad/sample"
               : "the same of the filter linearised about lock, in floating point, rad/sample"},
        {"", "", "docs/gaussian.md"}, *rms);
  }
  const quadrature::LockSet& set = sets.front();
  if (set.frequency_walk > 0.0) {
    quadrature::add_sampled(
        derivation,
        {"least_rms_frequency_error",
         "the posterior Cramér-Rao bound: no tracker has less, in floating point, rad/sample"},
        {"", "", "docs/gaussian.md"}, std::sqrt(quadrature::least_frequency_variance(deviation, walk)));
  }
}

/// Whether the start or the noise decides the bound, and the bound without the start.
std::string shares_of(const theorems::Derivation& derivation) {
  const theorems::Quantity* rms = theorems::applicable_quantity(derivation, kRms);
  const theorems::Quantity* rest = theorems::applicable_quantity(derivation, quadrature::kRmsWithoutStart);
  if (rms == nullptr || rest == nullptr) {
    return {};
  }
  const double ratio = rest->value.upper() / rms->value.upper();
  const double share = 1.0 - ratio * ratio;
  return fmt::format(
      "{} dominates the root mean square: about {:.0f} % of its square come from the start and are spread "
      "over the samples, the rest comes from the noise at every sample. Without the start's share it would "
      "be at most {} rad/sample.\n\n",
      share > 0.5 ? "The start" : "The noise", 100.0 * share,
      rigor::upper_decimal(rest->value, kShownRmsDigits));
}

}  // namespace

void add_mean_square(Certificate& certificate, const quadrature::LockQuestion& question,
                     quadrature::LockAnswer answer) {
  quadrature::MeanSquareCertificate& mean_square = answer.mean_square.value();
  if (!answer.lock.sets.empty()) {
    add_linear(question, answer.lock.sets, mean_square.derivation);
  }
  quadrature_particulars(certificate).lock_mean_squares = std::move(mean_square.mean_squares);
  certificate.derivations.push_back(std::move(mean_square.derivation));
}

Claim mean_square_claim(const Certificate& certificate, const GuaranteeTerms& terms) {
  const Number& required = terms.require.rms_frequency_error_below.value();
  const theorems::Derivation* derivation = find_derivation(certificate, kId);
  const theorems::Quantity* rms =
      derivation == nullptr ? nullptr : theorems::applicable_quantity(*derivation, kRms);
  Claim claim;
  claim.id = "ekf/rms-frequency-error";
  claim.requirement = fmt::format(
      "the root mean square of the frequency error in lock, in a certified set where it stays below {}, is "
      "below {} {}",
      lock_words(terms), frequency_words(required), stretch_of_samples(terms.assume));
  claim.statement = hypotheses(terms) + claim.requirement + ".";
  claim.required = true;
  claim.position = required.position;
  if (rms == nullptr) {
    claim.reason = "No mean square is certified for this design and start";
    if (derivation != nullptr) {
      for (const theorems::Condition& condition : derivation->conditions) {
        if (condition.verdict != Verdict::proved) {
          claim.reason += fmt::format(" ({}: {})", condition.id, condition.reason);
          return claim;
        }
      }
    }
    claim.reason += ".";
    return claim;
  }
  const theorems::Derivation* lock = find_derivation(certificate, "lock");
  const theorems::Quantity* reach =
      lock == nullptr ? nullptr : theorems::applicable_quantity(*lock, "lock_frequency_error");
  const bool below =
      rigor::certainly_less(rms->value, required.value) && reach != nullptr && is_lock(reach->value, terms);
  claim.verdict = below ? Verdict::proved : Verdict::undecided;
  claim.reason = fmt::format("It is at most {}{}.",
                             FrequencyUnits(terms.assume.sample_rate).at_most(rms->value, kShownRmsDigits),
                             below ? "" : ", which is not below what is required");
  claim.evidence = {*rms};
  return claim;
}

std::string mean_square_section(const Certificate& certificate) {
  const theorems::Derivation* derivation = find_derivation(certificate, kId);
  if (derivation == nullptr) {
    return {};
  }
  return fmt::format("## The mean square of the frequency error in lock, conditions {}\n\n{}.\n\n",
                     markdown::satisfied(derivation->verdict), derivation->title) +
         markdown::conditions_table(*derivation) + "\n" + markdown::quantities_table(*derivation) + "\n" +
         shares_of(*derivation) + (derivation->notes.empty() ? "" : markdown::notes_list(*derivation) + "\n");
}

}  // namespace veritrack::certificates

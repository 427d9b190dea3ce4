#include "certificates/quadrature/leak_words.hpp"

#include <fmt/format.h>

#include <string>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;

std::string reason_of(const quadrature::SteadyStartFinding& found) {
  const quadrature::SteadyStart& start = found.start;
  if (start.reached && start.samples == 0) {
    return "every assumed start lies in the certified set around the steady state of its frequency.";
  }
  if (start.reached) {
    return fmt::format(
        "every assumed start enters the certified set around the steady state of its frequency within {} "
        "samples, with a frequency error of at most {} rad/sample on the way: followed in interval "
        "arithmetic, with the assumed noise.",
        start.samples, rigor::upper_decimal(Interval(start.frequency_error)));
  }
  const std::string failure = start.failure.empty() ? "" : ", and " + start.failure;
  if (start.level) {
    return fmt::format(
        "the assumed starts have level {}; the certified set has level 1, measured from the steady state, "
        "which is biased by up to {} rad/sample{}: a smaller leak epsilon, a narrower [assume] frequency or "
        "smaller start errors would help.",
        rigor::upper_decimal(Interval(*start.level)), rigor::upper_decimal(Interval(found.bias)), failure);
  }
  return fmt::format("{} is not proved to lie between the bounds of the certified set{}.",
                     found.covariance_range.empty() ? "the initial covariance" : found.covariance_range,
                     failure);
}

std::string advice_on_end(double ends_at) {
  const bool is_above = ends_at > 0.0;
  return fmt::format(
      "; restrict [assume] frequency to at {} {} rad/sample, or take a smaller leak epsilon or a larger q2, "
      "which extend the verified branch",
      is_above ? "most" : "least",
      rigor::to_decimal(ends_at, 4, is_above ? rigor::Direction::down : rigor::Direction::up));
}

void advise(const std::string& advice, theorems::Quantity& quantity) {
  if (quantity.not_applicable) {
    *quantity.not_applicable += advice;
  }
}

}  // namespace

void add_words(quadrature::LeakCertificate& found) {
  for (theorems::Condition& condition : found.derivation.conditions) {
    if (condition.id == "start-in-set" && found.start) {
      condition.statement = "|T (e - e^*)| \\le 1,\\ -\\Delta_{lo} \\le P - P^* \\le \\Delta_{hi}";
      condition.reason = reason_of(*found.start);
    }
  }
  if (found.branch_ends_at) {
    // Then each condition and each quantity says so, and nothing else.
    const std::string advice = advice_on_end(*found.branch_ends_at);
    for (theorems::Condition& condition : found.derivation.conditions) {
      condition.reason += advice;
    }
    for (theorems::Quantity& quantity : found.derivation.quantities) {
      advise(advice, quantity);
    }
    for (theorems::Quantity* quantity : sets::quantities_in(found.result)) {
      advise(advice, *quantity);
    }
  }
  found.result.starts.conditions = found.derivation.conditions;
}

}  // namespace veritrack::certificates

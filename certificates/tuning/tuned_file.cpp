#include "certificates/tuning/tuned_file.hpp"

#include <fmt/format.h>

#include <limits>

#include "certificates/tuning/trial_run.hpp"

namespace veritrack::certificates {

namespace {

double upper_of(const theorems::Quantity& quantity) {
  return quantity.applies() ? quantity.value.upper() : std::numeric_limits<double>::infinity();
}
double lower_of(const theorems::Quantity& quantity) {
  return quantity.applies() ? quantity.value.lower() : 0.0;
}

}  // namespace

CertifiedValues values_of(const sets::KalmanFilterResult& result, const Requirements& require) {
  CertifiedValues found;
  const sets::StartResult& starts = result.starts;
  if (starts.verdict == rigor::Verdict::proved) {
    found.long_run = upper_of(starts.ultimate_frequency_error);
    found.for_ever = upper_of(starts.frequency_error_bound);
    const auto& settled = require.settled_below;
    if (settled && upper_of(starts.settled_frequency_error) <= settled->nearest) {
      found.settles = upper_of(starts.settling_samples);
    }
  }
  found.radius = lower_of(result.frequency_error_radius);
  found.noise = lower_of(result.largest_noise);
  found.slew = lower_of(result.largest_slew);
  return found;
}

void add_simulated(const Design& design, const Assumptions& assume, const std::set<Objective>& needed,
                   CertifiedValues& found) {
  if (!needed.contains(Objective::simulated_rms)) {
    return;
  }
  if (const auto simulated = simulated_rms(design, assume)) {
    found.simulated_rms = simulated->rms;
    found.simulated_deviation = simulated->deviation;
  }
}

TuningResult tuned_file(const TuningProblem& problem, const TuningRequest& request,
                        const DesignEdits& edits) {
  const TuningOutcome outcome = search_values(problem, request);
  TuningResult result;
  // Unchanged values stay as they were written.
  result.design_text = outcome.chosen == problem.given
                           ? request.design_text
                           : with_design_values(request.design_text, edits(outcome.chosen));
  if (!result.design_text) {
    const DesignValues& found = outcome.chosen;
    result.reason = fmt::format(
        "q1 = {}, q2 = {}, r = {} and epsilon = {} were found, but [design] of the file is not a table with "
        "a line for each key, into which they could be written.",
        found.q1, found.q2, found.r, found.epsilon);
    return result;
  }
  result.notes = notes_of(problem, outcome);
  result.changes = outcome.changes;
  result.trade_off = outcome.trade_off;
  return result;
}

}  // namespace veritrack::certificates

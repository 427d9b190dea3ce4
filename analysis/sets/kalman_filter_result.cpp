#include "analysis/sets/kalman_filter_result.hpp"

#include <algorithm>
#include <utility>

#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::sets {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using theorems::Quantity;
using theorems::Sense;

namespace quantities {

namespace {

Quantity unset(const char* name, const char* symbol, const char* words, Sense sense) {
  return {name, symbol, "", "", Interval::empty(), "It was not evaluated.", sense, words};
}

}  // namespace

Quantity contraction_rate() {
  return unset("contraction_rate", "\\kappa", "largest factor of the error per sample, before noise and slew",
               Sense::at_most);
}
Quantity radius() {
  return unset("radius", "R", "radius of the certified set, in its metric", Sense::equal);
}
Quantity frequency_error_radius() {
  return unset("frequency_error_radius", "\\nu_R", "frequency errors in the set up to, rad/sample",
               Sense::at_least);
}
Quantity phase_error_radius() {
  return unset("phase_error_radius", "\\psi_R", "phase errors in the set up to, rad", Sense::at_least);
}
Quantity amplitude_error_radius() {
  return unset("amplitude_error_radius", "a_R", "amplitude errors in the set up to, relative",
               Sense::at_least);
}
Quantity frequency_error_bound() {
  return unset("frequency_error_bound", "\\sup_k |\\nu(k)|",
               "frequency error at every sample, from the assumed start on, rad/sample", Sense::at_most);
}
Quantity ultimate_frequency_error() {
  return unset("ultimate_frequency_error", "\\nu_\\infty", "frequency error in the long run, rad/sample",
               Sense::at_most);
}
Quantity settling_samples() {
  return unset("settling_samples", "k_s", "samples until the frequency error has settled", Sense::at_most);
}
Quantity settled_frequency_error() {
  return unset("settled_frequency_error", "\\nu_s", "frequency error from then on, rad/sample",
               Sense::at_most);
}
Quantity capture_samples() {
  return unset("capture_samples", "k_c", "samples until every assumed start is in the certified set",
               Sense::at_most);
}
Quantity wrong_lock_frequency_error() {
  return unset("wrong_lock_frequency_error", "\\liminf_k |\\nu(k)|",
               "frequency error at the wrong lock, rad/sample", Sense::at_least);
}
Quantity largest_noise() {
  return unset("largest_noise", "V_{max}",
               "largest certified noise (at constant frequency), relative to the amplitude", Sense::at_least);
}
Quantity largest_slew() {
  return unset("largest_slew", "W_{max}", "largest certified slew (without noise), rad/sample per sample",
               Sense::at_least);
}
Quantity bias_frequency() {
  return unset("bias_frequency", "\\nu^*", "steady-state frequency error due to the leak, rad/sample",
               Sense::enclosure);
}

}  // namespace quantities

std::optional<Interval> StartResult::proved_bound() const {
  const bool bounded =
      verdict == Verdict::proved && frequency_error_bound.applies() && is_finite(frequency_error_bound.value);
  return bounded ? std::optional(frequency_error_bound.value) : std::nullopt;
}

const Condition* StartResult::first_open_condition() const {
  const auto found = std::find_if(conditions.begin(), conditions.end(),
                                  [](const Condition& one) { return one.verdict != Verdict::proved; });
  return found == conditions.end() ? nullptr : &*found;
}

const Condition* StartResult::first_condition(Verdict wanted) const {
  const auto found = std::find_if(conditions.begin(), conditions.end(),
                                  [&](const Condition& one) { return one.verdict == wanted; });
  return found == conditions.end() ? nullptr : &*found;
}

std::vector<Quantity*> quantities_in(KalmanFilterResult& result) {
  StartResult& starts = result.starts;
  std::vector<Quantity*> all{&result.contraction_rate,       &result.radius,
                             &result.frequency_error_radius, &result.phase_error_radius,
                             &result.amplitude_error_radius, &starts.ultimate_frequency_error,
                             &starts.frequency_error_bound};
  if (starts.capture_samples) {
    all.push_back(&*starts.capture_samples);
  }
  all.push_back(&starts.settling_samples);
  all.push_back(&starts.settled_frequency_error);
  all.push_back(&result.largest_noise);
  all.push_back(&result.largest_slew);
  if (result.bias_frequency) {
    all.push_back(&*result.bias_frequency);
  }
  return all;
}

std::vector<Quantity> quantities_of(const KalmanFilterResult& result) {
  KalmanFilterResult copy = result;
  std::vector<Quantity> all;
  for (Quantity* quantity : quantities_in(copy)) {
    all.push_back(std::move(*quantity));
  }
  return all;
}

void conclude(theorems::Derivation& derivation, KalmanFilterResult& result) {
  std::vector<Quantity> all = quantities_of(result);
  std::move(derivation.quantities.begin(), derivation.quantities.end(), std::back_inserter(all));
  derivation.quantities = std::move(all);
  theorems::conclude(derivation);
  result.starts.conditions = derivation.conditions;
  result.starts.verdict = derivation.verdict;
}

}  // namespace veritrack::sets

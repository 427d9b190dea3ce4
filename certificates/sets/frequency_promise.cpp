#include "certificates/sets/frequency_promise.hpp"

#include <algorithm>
#include <string_view>

namespace veritrack::certificates {

FrequencyPromise ekf_frequency_promise(const Certificate& certificate, const Assumptions& assume,
                                       bool two_channels) {
  FrequencyPromise promise;
  promise.amplitude = assume.amplitude;
  promise.frequency = assume.frequency;
  promise.noise = assume.noise;
  promise.slew = assume.slew;
  promise.two_channels = two_channels;
  if (assume.gaussian) {
    promise.objection = "its noise is Gaussian, so that no bound on its frequency error is valid for ever";
    return promise;
  }
  const auto claim = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [](const Claim& one) { return one.id == "ekf/guarantee"; });
  if (claim == certificate.claims.end() || claim->verdict != rigor::Verdict::proved) {
    promise.objection = "its guarantee is not proved";
    return promise;
  }
  promise.sentence = claim->statement;
  const auto bound = [&](std::string_view name) -> std::optional<rigor::Interval> {
    const auto found = std::find_if(claim->evidence.begin(), claim->evidence.end(),
                                    [&](const theorems::Quantity& one) { return one.name == name; });
    return found != claim->evidence.end() && found->applies()
               ? std::optional(rigor::Interval(found->value.upper()))
               : std::nullopt;
  };
  promise.for_ever = bound("frequency_error_bound");
  promise.ultimate = bound("ultimate_frequency_error");
  const auto samples = bound("settling_samples");
  promise.settled_error = bound("settled_frequency_error");
  if (samples && promise.settled_error) {
    promise.settling_samples = samples->upper();
  } else {
    promise.settled_error.reset();
  }
  return promise;
}

}  // namespace veritrack::certificates

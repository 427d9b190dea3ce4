#include "certificates/model/model_noise_keys.hpp"

namespace veritrack::certificates {

std::optional<TableObjection> objection_to_noise(const ModelAssumptions& assume,
                                                 const ModelRequirements& require) {
  const Requirements& sets = require.sets;
  if (!assume.gaussian) {
    if (assume.samples) {
      return TableObjection{
          "assume",
          "samples goes with Gaussian noise; allowed: noise = { snr_db = ... } or { deviation "
          "= ... }, or no samples",
          {}};
    }
    return sets.probability_of_losing_lock_below
               ? std::optional(
                     TableObjection{"require",
                                    "probability_of_losing_lock_below goes with Gaussian noise: with a bound "
                                    "on the noise there "
                                    "are guarantees for ever; allowed: noise = { snr_db = ... } in [assume]",
                                    {}})
               : std::nullopt;
  }
  if (!assume.samples) {
    return TableObjection{"assume",
                          "with Gaussian noise samples is missing: for how many samples the probability of "
                          "losing lock is asked; allowed: a number from 1 to 1e15",
                          {}};
  }
  if (!(assume.slew.value == rigor::Interval(0.0))) {
    return TableObjection{"assume",
                          "a slew is not certified together with Gaussian noise; allowed: slew = 0, or noise "
                          "with a bound",
                          {}};
  }
  const bool asks_for_ever = sets.frequency_error_below || sets.settles_within ||
                             sets.largest_noise_at_least || sets.largest_slew_at_least ||
                             sets.frequency_error_radius_at_least;
  return asks_for_ever
             ? std::optional(TableObjection{
                   "require",
                   "no guarantee is valid for ever with Gaussian noise, which exceeds every bound some time; "
                   "allowed: probability_of_losing_lock_below, bias_below, ripple_below",
                   {}})
             : std::nullopt;
}

}  // namespace veritrack::certificates

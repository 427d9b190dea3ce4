// [require] and [simulate] of the trackers whose errors a contraction certificate bounds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "certificates/design/key_readers.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/set_keys.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

bool at_least_one(const Interval& x) {
  return rigor::certainly_less_equal(Interval(1.0), x);
}

bool between_zero_and_one(const Interval& x) {
  return positive(x) && rigor::certainly_less(x, Interval(1.0));
}

template <auto member, RealPredicate is_allowed>
void whole_number(const TomlValue& value, Owner<member>& target) {
  target.*member = value.whole_number(is_allowed);
}

void signal(const TomlValue& value, SimulationSettings& simulate) {
  choose(value, trackers::signal_names(), simulate.signal);
}

using Require = Requirements;
constexpr std::array kRequireKeys{
    Key<Require>{"frequency_error_below", kPositiveFrequency,
                 in_radians<&Require::frequency_error_below, positive>, kOptional, kLessFrequency},
    Key<Require>{"settles_within", "a whole number of samples, 1 or more",
                 whole_number<&Require::settles_within, at_least_one>, kOptional, kLessSamples},
    Key<Require>{"settled_below", kPositiveFrequency, in_radians<&Require::settled_below, positive>,
                 kOptional, kLessFrequency},
    Key<Require>{"largest_noise_at_least", kPositive, real<&Require::largest_noise_at_least, positive>,
                 kOptional, kMore},
    Key<Require>{"largest_slew_at_least", kPositiveSlew, slew<&Require::largest_slew_at_least, positive>,
                 kOptional, kMoreSlew},
    Key<Require>{"frequency_error_radius_at_least", kPositiveFrequency,
                 in_radians<&Require::frequency_error_radius_at_least, positive>, kOptional, kMoreFrequency},
    Key<Require>{"probability_of_losing_lock_below", "a number above 0 and below 1",
                 real<&Require::probability_of_losing_lock_below, between_zero_and_one>, kOptional, kLess},
    Key<Require>{"rms_frequency_error_below", kPositiveFrequency,
                 in_radians<&Require::rms_frequency_error_below, positive>, kOptional, kLessFrequency},
};

constexpr std::size_t kKeysOfGaussianNoise = 2;  // the last ones

using Simulate = SimulationSettings;

}  // namespace

std::span<const Key<Requirements>> require_keys() {
  return kRequireKeys;
}
std::span<const Key<Requirements>> require_keys_of_bounded_noise() {
  return require_keys().first(kRequireKeys.size() - kKeysOfGaussianNoise);
}

std::optional<TableObjection> objection_to(const Assumptions& assume, const Requirements& require) {
  if (!assume.gaussian) {
    if (assume.frequency_walk || assume.samples) {
      return TableObjection{
          "assume",
          "frequency_walk and samples go with Gaussian noise; allowed: noise = { snr_db = ... "
          "} or { deviation = ... }, or a slew without these keys"};
    }
    return require.probability_of_losing_lock_below || require.rms_frequency_error_below
               ? std::optional(TableObjection{
                     "require",
                     "probability_of_losing_lock_below and rms_frequency_error_below go with Gaussian noise: "
                     "with a bound on the noise there are guarantees for ever; allowed: noise = { snr_db = "
                     "... } in [assume]"})
               : std::nullopt;
  }
  if (!assume.samples) {
    return TableObjection{"assume",
                          "with Gaussian noise samples is missing: for how many samples the probability of "
                          "losing lock is asked; allowed: a number from 1 to 1e15"};
  }
  if (!(assume.slew.value == Interval(0.0))) {
    return TableObjection{"assume",
                          "slew is a bound, which is not certified together with Gaussian noise; allowed: "
                          "frequency_walk, the deviation of Gaussian steps of the frequency"};
  }
  const bool asks_for_ever = require.frequency_error_below || require.settles_within ||
                             require.largest_noise_at_least || require.largest_slew_at_least ||
                             require.frequency_error_radius_at_least;
  return asks_for_ever
             ? std::optional(TableObjection{
                   "require",
                   "no guarantee is valid for ever with Gaussian noise, which exceeds every bound some time; "
                   "allowed: probability_of_losing_lock_below, rms_frequency_error_below"})
             : std::nullopt;
}

std::optional<TableObjection> objection_to(const Requirements& require) {
  if (require.settles_within.has_value() == require.settled_below.has_value()) {
    return std::nullopt;
  }
  return TableObjection{
      "require",
      "settles_within (samples) and settled_below (rad/sample, the frequency error that counts as "
      "settled) need each other; allowed: both or neither"};
}

std::span<const Key<SimulationSettings>> simulate_keys() {
  static const std::string signals = fmt::format("\"{}\"", fmt::join(trackers::signal_names(), "\", \""));
  static const std::array keys{
      Key<Simulate>{"samples", "an integer from 1 to 10000000", integer<&Simulate::samples, 1, 10'000'000>,
                    defaults_to("1000"), kNoContract},
      Key<Simulate>{"seed", "an integer from 0 to 9223372036854775807",
                    integer<&Simulate::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1"),
                    kNoContract},
      Key<Simulate>{"signal", signals, signal, defaults_to("\"constant\""), kNoContract},
  };
  return keys;
}

}  // namespace veritrack::certificates

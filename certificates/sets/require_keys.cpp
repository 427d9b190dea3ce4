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

template <auto member, RealPredicate is_allowed>
void whole_number(const TomlValue& value, Owner<member>& target) {
  target.*member = value.whole_number(is_allowed);
}

void signal(const TomlValue& value, SimulationSettings& simulate) {
  choose(value, trackers::signal_names(), simulate.signal);
}

using Require = Requirements;
constexpr std::array kRequireKeys{
    Key<Require>{"frequency_error_below", kPositive, real<&Require::frequency_error_below, positive>,
                 kOptional},
    Key<Require>{"settles_within", "a whole number of samples, 1 or more",
                 whole_number<&Require::settles_within, at_least_one>, kOptional},
    Key<Require>{"settled_below", kPositive, real<&Require::settled_below, positive>, kOptional},
    Key<Require>{"largest_noise_at_least", kPositive, real<&Require::largest_noise_at_least, positive>,
                 kOptional},
    Key<Require>{"largest_slew_at_least", kPositive, real<&Require::largest_slew_at_least, positive>,
                 kOptional},
    Key<Require>{"frequency_error_radius_at_least", kPositive,
                 real<&Require::frequency_error_radius_at_least, positive>, kOptional},
};

using Simulate = SimulationSettings;

}  // namespace

std::span<const Key<Requirements>> require_keys() {
  return kRequireKeys;
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
                    defaults_to("1000")},
      Key<Simulate>{"seed", "an integer from 0 to 9223372036854775807",
                    integer<&Simulate::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1")},
      Key<Simulate>{"signal", signals, signal, defaults_to("\"constant\"")},
  };
  return keys;
}

}  // namespace veritrack::certificates

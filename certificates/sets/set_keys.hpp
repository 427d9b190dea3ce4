// The keys of [assume], [require] and [simulate] for the trackers whose errors a contraction certificate
// bounds.
#pragma once

#include <array>
#include <span>

#include "certificates/design/design_format.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// [assume], with noise that may be Gaussian.
[[nodiscard]] std::span<const Key<Assumptions>> assume_keys();
/// [assume] of a tracker whose frequency may also be a single number; its noise has a bound.
[[nodiscard]] std::span<const Key<Assumptions>> assume_keys_with_one_frequency();
/// [require], with and without the keys for Gaussian noise.
[[nodiscard]] std::span<const Key<Requirements>> require_keys();
[[nodiscard]] std::span<const Key<Requirements>> require_keys_of_bounded_noise();
/// [simulate]
[[nodiscard]] std::span<const Key<SimulationSettings>> simulate_keys();

/// The allowed values of `noise` when it may be Gaussian, and its reader: a bound, or the noise.
inline constexpr std::string_view kNoiseThatMayBeGaussian =
    "a number, 0 or more, or { bound = that number }, or Gaussian noise: { snr_db = a number from -200 to "
    "200 } or { deviation "
    "= a number above 0 }";
void read_noise(const TomlValue& value, Number& bound, std::optional<GaussianNoise>& gaussian);
/// More noise, or a lower ratio, is the harder question; a bound and Gaussian noise are different ones.
inline constexpr std::array kFormsOfNoise{MemberContract{"snr_db", Stronger::smaller},
                                          MemberContract{"deviation", Stronger::larger}};
inline constexpr KeyContract kContractOfNoise{Stronger::larger, Measure::plain, kFormsOfNoise};
/// The number of samples for which a probability is asked: from 1 to 1e15.
inline constexpr std::string_view kSamplesOfProbability = "a number from 1 to 1e15";
[[nodiscard]] bool is_number_of_samples(const rigor::Interval& x);

/// A rule that no single key of [require] can check: settling needs two keys.
[[nodiscard]] std::optional<TableObjection> objection_to(const Requirements& require);
/// Another such rule: keys for Gaussian noise do not go with a bound.
[[nodiscard]] std::optional<TableObjection> objection_to(const Assumptions& assume,
                                                         const Requirements& require);

}  // namespace veritrack::certificates

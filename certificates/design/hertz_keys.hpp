// Frequencies of a design file in rad/sample, or with a sample rate in Hz; times in samples or seconds.
#pragma once

#include <array>
#include <string_view>

#include "certificates/design/design_format.hpp"

namespace veritrack::certificates {

/// The allowed values of [assume] sample_rate.
inline constexpr std::string_view kSampleRate = "a number above 0, in Hz";
/// The allowed values of a frequency error, above 0, and 0 or more; and of a slew.
inline constexpr std::string_view kPositiveFrequency =
    "a number above 0, in rad/sample, or { hz = a number } with sample_rate in [assume]";
inline constexpr std::string_view kNotNegativeFrequency =
    "a number, 0 or more, in rad/sample, or { hz = a number } with sample_rate in [assume]";
inline constexpr std::string_view kPositiveSlew =
    "a number above 0, in rad/sample per sample, or { hz_per_second = a number } with sample_rate in "
    "[assume]";
inline constexpr std::string_view kNotNegativeSlew =
    "a number, 0 or more, in rad/sample per sample, or { hz_per_second = a number } with sample_rate in "
    "[assume]";
/// The allowed values of a time.
inline constexpr std::string_view kPositiveTime =
    "a number above 0, in samples, or { seconds = a number } with sample_rate in [assume]";

// Each reads x, in rad/sample, or { hz = x }, which is 2 pi x/sample_rate rad/sample: an enclosure, whose
// `text` is "x Hz". `is_allowed` receives rad/sample. Throws InputError, for Hz without a sample rate as
// well. Needs the upward rounding mode.

[[nodiscard]] Number read_frequency(const TomlValue& value, RealPredicate is_allowed);
/// [lowest, highest] or { hz = [lowest, highest] }, in this order for certain, or the same.
[[nodiscard]] std::array<Number, 2> read_band(const TomlValue& value, RealPredicate is_allowed);
/// x in rad/sample per sample, or { hz_per_second = x }: 2 pi x/sample_rate^2.
[[nodiscard]] Number read_slew(const TomlValue& value, RealPredicate is_allowed);
/// x in samples, or { seconds = x }: x sample_rate.
[[nodiscard]] Number read_time(const TomlValue& value, RealPredicate is_allowed);
/// Whether the value is one number, of either unit.
[[nodiscard]] bool is_one_frequency(const TomlValue& value);

}  // namespace veritrack::certificates

// The parts of the keys of all trackers: limits, defaults, and readers that store a value in a member.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "certificates/design/design_format.hpp"
#include "certificates/design/hertz_keys.hpp"

namespace veritrack::certificates::keys {

using rigor::Interval;

// ---- the assumption without a key

inline constexpr Absence kRequired{};
inline constexpr Absence kOptional{Absence::Rule::is_nothing, {}};
constexpr Absence defaults_to(std::string_view toml) {
  return {Absence::Rule::is_default, toml};
}

// ---- the role of a key in the contract

inline constexpr KeyContract kNoContract{Stronger::neither};
inline constexpr KeyContract kOnlyEqual{Stronger::only_equal};
inline constexpr KeyContract kMore{Stronger::larger};
inline constexpr KeyContract kLess{Stronger::smaller};
inline constexpr KeyContract kMoreFrequency{Stronger::larger, Measure::frequency};
inline constexpr KeyContract kLessFrequency{Stronger::smaller, Measure::frequency};
inline constexpr KeyContract kMoreSlew{Stronger::larger, Measure::slew};
inline constexpr KeyContract kMoreSamples{Stronger::larger, Measure::samples};
inline constexpr KeyContract kLessSamples{Stronger::smaller, Measure::samples};
inline constexpr KeyContract kWider{Stronger::wider};
inline constexpr KeyContract kWiderBand{Stronger::wider, Measure::frequency};

// ---- limits: true only when certain

inline bool any_number(const Interval& x) {
  return rigor::is_finite(x);
}
inline bool positive(const Interval& x) {
  return rigor::certainly_positive(x);
}
inline bool not_negative(const Interval& x) {
  return rigor::certainly_less_equal(Interval(0.0), x);
}

inline bool at_least_zero_below_one(const Interval& x) {
  return not_negative(x) && rigor::certainly_less(x, Interval(1.0));
}

inline constexpr std::string_view kPositive = "a number above 0";
inline constexpr std::string_view kNotNegative = "a number, 0 or more";
inline constexpr std::string_view kAtLeastZeroBelowOne = "a number, 0 or more and below 1";

// ---- how a key is read

template <typename Member>
struct OwnerOf;
template <typename Owner, typename Type>
struct OwnerOf<Type Owner::*> {
  using type = Owner;
};
template <auto member>
using Owner = typename OwnerOf<decltype(member)>::type;

template <auto member, RealPredicate is_allowed>
void real(const TomlValue& value, Owner<member>& target) {
  target.*member = value.real(is_allowed);
}

/// A frequency in rad/sample, or in Hz with a sample rate.
template <auto member, RealPredicate is_allowed>
void in_radians(const TomlValue& value, Owner<member>& target) {
  target.*member = read_frequency(value, is_allowed);
}
/// Its change, per sample or per second.
template <auto member, RealPredicate is_allowed>
void slew(const TomlValue& value, Owner<member>& target) {
  target.*member = read_slew(value, is_allowed);
}

template <auto member, std::int64_t lowest, std::int64_t highest>
void integer(const TomlValue& value, Owner<member>& target) {
  using Type = std::remove_reference_t<decltype(target.*member)>;
  target.*member = static_cast<Type>(value.integer(lowest, highest));
}

/// Stores a string out of a list of choices.
template <typename Choices>
void choose(const TomlValue& value, const Choices& choices, std::string& target) {
  if (!value.is_string()) {
    value.refuse_kind();
  }
  constexpr std::size_t kLongest = 100;
  const std::string text = value.line_of_text(kLongest);
  if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
    value.refuse(fmt::format("\"{}\"", text));
  }
  target = text;
}

}  // namespace veritrack::certificates::keys

// What the keys of all trackers are made of: limits, defaults, and readers that store a value in a member.
#pragma once

#include <string_view>

#include "certificates/design/design_keys.hpp"

namespace veritrack::certificates::keys {

using rigor::Interval;

// ---- what holds without a key

inline constexpr Absence kRequired{};
inline constexpr Absence kOptional{Absence::Rule::is_nothing, {}};
constexpr Absence defaults_to(std::string_view toml) {
  return {Absence::Rule::is_default, toml};
}

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

inline constexpr std::string_view kPositive = "a number above 0";
inline constexpr std::string_view kNotNegative = "a number, 0 or more";

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

}  // namespace veritrack::certificates::keys

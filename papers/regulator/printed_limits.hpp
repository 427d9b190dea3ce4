// The limiting controllers of Tables 5.1 and 5.2 of the thesis, and the ideal one, in the loop of section
// 5.4.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994, section 5.4. K = N/D: N has the parameters c_i - a_i, D the b_i. The factor 1.1133 of
// Table 5.1 stands in all six parameters and is left out of N and D, as it cancels in N/D.
#pragma once

#include <initializer_list>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "papers/regulator/frozen_loop.hpp"

namespace veritrack::regulator {

/// A number as printed, with four digits behind the point, or every number that is printed this way.
enum class Printed { exactly, rounded };

[[nodiscard]] inline Polynomial printed_polynomial(std::initializer_list<const char*> decimals,
                                                   Printed reading) {
  const rigor::Interval half_unit = rigor::parse_decimal("0.00005");
  Polynomial result;
  for (const char* decimal : decimals) {
    const rigor::Interval value = rigor::parse_decimal(decimal);
    result.push_back(reading == Printed::exactly ? value : hull(value - half_unit, value + half_unit));
  }
  return result;
}

/// omega = pi/6 rad/sample.
[[nodiscard]] inline rigor::Interval vibration() {
  return rigor::pi() / rigor::Interval(6.0);
}

/// A_2 = 1 - 2 cos(omega) q^-1 + q^-2; 2 cos(pi/6) is the root of 3.
[[nodiscard]] inline Polynomial vibration_factor() {
  return {rigor::Interval(1.0), -sqrt(rigor::Interval(3.0)), rigor::Interval(1.0)};
}

/// x_k = 0.5 x_{k-1} + 3 u_{k-1} under the controller N/D.
[[nodiscard]] inline FrozenLoop example_loop(Polynomial numerator, Polynomial denominator) {
  using rigor::Interval;
  return {{Interval(1.0), Interval(-0.5)}, {Interval(3.0)}, std::move(numerator), std::move(denominator)};
}

/// K = A_1 (2 cos(omega) - q^-1)/(3 A_2).
[[nodiscard]] inline FrozenLoop ideal_loop() {
  using rigor::Interval;
  return example_loop(product({Interval(1.0), Interval(-0.5)}, {sqrt(Interval(3.0)), -Interval(1.0)}),
                      product({Interval(3.0)}, vibration_factor()));
}

/// Table 5.1, "Estimated".
[[nodiscard]] inline FrozenLoop table_5_1_loop(Printed reading) {
  return example_loop(printed_polynomial({"1.7980", "-1.6164", "0.4802"}, reading),
                      printed_polynomial({"3.0000", "-5.1962", "3.0000"}, reading));
}

/// Table 5.2, "Estimated".
[[nodiscard]] inline FrozenLoop table_5_2_loop(Printed reading) {
  return example_loop(printed_polynomial({"2.2585", "-1.9837", "0.4610", "0.2449", "-0.0845"}, reading),
                      printed_polynomial({"2.9604", "-5.5496", "3.2754", "0.2984", "-0.4159"}, reading));
}

/// d with A_2 d printed as the denominator of Table 5.2: found by search, checked by its users.
[[nodiscard]] inline Polynomial table_5_2_cofactor() {
  return {rigor::parse_decimal("2.96044"), rigor::parse_decimal("-0.421976"),
          rigor::parse_decimal("-0.415882")};
}

}  // namespace veritrack::regulator

// Numbers as terms of Coq's real numbers: fractions of integers.
#pragma once

#include <string>
#include <string_view>

#include "analysis/rigor/interval.hpp"

namespace veritrack::certificates::coq {

/// The number that a decimal represents, e.g. "(23 / 10000)" for 0.0023. `text` as parse_decimal takes it,
/// and with underscores. Throws rigor::NumberFormatError.
[[nodiscard]] std::string decimal(std::string_view text);

/// The same as a decimal of Coq's, with at least one digit after the point: "0.0023", "1.0", "(-0.5)". Throws
/// rigor::NumberFormatError.
[[nodiscard]] std::string literal(std::string_view text);

/// The same as a fraction of type Q, "(23 # 10000)", which Coq recognises as equal to that of literal().
/// Throws rigor::NumberFormatError.
[[nodiscard]] std::string fraction(std::string_view text);

/// The number that a finite double is. Throws std::invalid_argument for NaN and infinities.
[[nodiscard]] std::string exactly(double value);

/// "lower <= term <= upper" with the 17-digit decimals, outward-rounded, that the certificate prints.
[[nodiscard]] std::string encloses(const rigor::Interval& value, const std::string& term);

}  // namespace veritrack::certificates::coq

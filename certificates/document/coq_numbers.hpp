// Numbers as terms of Coq's real numbers: fractions of integers.
#pragma once

#include <string>
#include <string_view>

#include "analysis/rigor/interval.hpp"

namespace veritrack::certificates::coq {

/// The number that a decimal represents, e.g. "(23 / 10000)" for 0.0023. `text` as parse_decimal takes it,
/// and with underscores. Throws rigor::NumberFormatError.
[[nodiscard]] std::string decimal(std::string_view text);

/// The same as a quotient of two integers even where the number is one: "(1 / 1)" for 1.0 and "/", and of
/// type Q for "#". Coq sees that the two are the same number. Throws rigor::NumberFormatError.
[[nodiscard]] std::string quotient(std::string_view text, std::string_view sign_between);

/// The number that a finite double is. Throws std::invalid_argument for NaN and infinities.
[[nodiscard]] std::string exactly(double value);

/// "lower <= term <= upper" with the 17-digit decimals, outward-rounded, that the certificate prints.
[[nodiscard]] std::string encloses(const rigor::Interval& value, const std::string& term);

}  // namespace veritrack::certificates::coq

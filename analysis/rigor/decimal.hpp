// Numbers as text: decimals and hexadecimal floats, read and written outward.
//
// None of these functions depends on the rounding mode (they work through MPFR); they may be called inside
// and outside an UpwardRounding scope.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// Thrown for text that is not one finite number in the range of double.
class NumberFormatError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The tightest interval with double endpoints that contains the decimal number in `text`. Its endpoints are
/// neighbours, so it also contains the double nearest to that number. Grammar: [+-] digits [. digits] [(e|E)
/// [+-] digits], with a digit on at least one side of the point. Throws NumberFormatError for anything else,
/// for NaN and infinities, and for magnitudes above the largest double.
[[nodiscard]] Interval parse_decimal(std::string_view text);

/// The double nearest to a decimal that parse_decimal accepts; NaN for other text. Holds its own rounding
/// mode.
[[nodiscard]] double nearest_double(std::string_view decimal);

/// The same for a C99 hexadecimal float, [+-] 0x digits [. digits] p [+-] digits in upper or lower case; a
/// point if 53 bits suffice.
[[nodiscard]] Interval parse_hexadecimal(std::string_view text);

/// The exact value as a C99 hexadecimal float, e.g. 0x1.8p+1; "nan", "inf" and "-inf" where that is the
/// value.
[[nodiscard]] std::string to_hexadecimal(double value);

enum class Direction { down, up };

/// `value` as a decimal with `digits` significant digits, rounded in the given direction: plain notation for
/// exponents from -5 to 9 and scientific (1.5e-12) beyond, without trailing zeros in the fraction; "nan",
/// "inf" and "-inf" where that is the value. Throws std::invalid_argument unless 1 <= digits <= 40.
[[nodiscard]] std::string to_decimal(double value, int digits, Direction direction);

/// The lower end rounded down, and the upper end rounded up: what an enclosed number is at least, and at
/// most.
[[nodiscard]] std::string lower_decimal(const Interval& value, int digits = 4);
[[nodiscard]] std::string upper_decimal(const Interval& value, int digits = 4);

/// "[lower, upper]", outward-rounded; "[empty]" when empty. A point that the digits represent exactly is
/// printed as
/// "[x, x]".
[[nodiscard]] std::string to_decimal(const Interval& value, int digits = 17);

}  // namespace veritrack::rigor

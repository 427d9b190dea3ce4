#include "certificates/document/coq_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates::coq {

namespace {

/// base^exponent: written out where that is readable and lets Coq's lra see a constant.
std::string power(int base, int exponent) {
  constexpr int kWrittenOut = 30;
  if (base == 10 && exponent <= kWrittenOut) {
    return "1" + std::string(static_cast<std::size_t>(exponent), '0');
  }
  return fmt::format("{} ^ {}", base, exponent);
}

/// digits base^exponent, with a sign.
std::string scaled(bool negative, const std::string& digits, int base, int exponent) {
  std::string term = digits;
  if (exponent < 0) {
    term = fmt::format("({} / {})", digits, power(base, -exponent));
  } else if (exponent > 0 && digits != "0") {
    term = fmt::format("({} * {})", digits, power(base, exponent));
  }
  return negative ? "(- " + term + ")" : term;
}

/// digits 10^exponent, with a sign; no digits for zero.
struct DecimalParts {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

/// Throws rigor::NumberFormatError.
DecimalParts parts_of(std::string_view text) {
  std::string plain(text);
  std::erase(plain, '_');
  static_cast<void>(rigor::parse_decimal(plain));  // throws for text that is not a decimal
  std::string digits;
  int exponent = 0;
  bool negative = false;
  bool after_point = false;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char at = plain[i];
    if (at == 'e' || at == 'E') {
      const char* first = plain.data() + i + 1;
      first += *first == '+' ? 1 : 0;
      int given = 0;
      if (std::from_chars(first, plain.data() + plain.size(), given).ec != std::errc()) {
        throw rigor::NumberFormatError("an exponent out of range");
      }
      exponent += given;
      break;
    }
    if (at == '.') {
      after_point = true;
    } else if (at == '-' || at == '+') {
      negative = at == '-';
    } else {
      digits += at;
      exponent -= after_point ? 1 : 0;
    }
  }
  digits.erase(0, digits.find_first_not_of('0'));
  while (digits.size() > 1 && digits.back() == '0' && exponent < 0) {
    digits.pop_back();
    ++exponent;
  }
  return {negative, digits, exponent};
}

/// digits / 10^decimals, with a sign, and at least one decimal.
struct FractionParts {
  bool negative = false;
  std::string digits;
  std::size_t decimals = 1;
};

/// Throws rigor::NumberFormatError.
FractionParts fraction_of(std::string_view text) {
  const DecimalParts parts = parts_of(text);
  if (parts.digits.empty()) {
    return {false, "0", 1};
  }
  const int zeros = std::max(parts.exponent + 1, 0);
  return {parts.negative, parts.digits + std::string(static_cast<std::size_t>(zeros), '0'),
          static_cast<std::size_t>(zeros - parts.exponent)};
}

}  // namespace

std::string decimal(std::string_view text) {
  const DecimalParts parts = parts_of(text);
  return parts.digits.empty() ? "0" : scaled(parts.negative, parts.digits, 10, parts.exponent);
}

std::string literal(std::string_view text) {
  const FractionParts parts = fraction_of(text);
  std::string digits = parts.digits;
  if (digits.size() <= parts.decimals) {
    digits.insert(0, parts.decimals + 1 - digits.size(), '0');
  }
  digits.insert(digits.size() - parts.decimals, ".");
  return parts.negative ? "(-" + digits + ")" : digits;
}

std::string fraction(std::string_view text) {
  const FractionParts parts = fraction_of(text);
  return fmt::format("({}{} # 1{})", parts.negative ? "-" : "", parts.digits,
                     std::string(parts.decimals, '0'));
}

std::string exactly(double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument("only finite numbers are terms of Coq");
  }
  if (value == 0.0) {
    return "0";
  }
  int exponent = 0;
  auto significand = static_cast<std::int64_t>(
      std::ldexp(std::frexp(std::fabs(value), &exponent), std::numeric_limits<double>::digits));
  exponent -= std::numeric_limits<double>::digits;
  while (significand % 2 == 0) {
    significand /= 2;
    ++exponent;
  }
  return scaled(value < 0.0, std::to_string(significand), 2, exponent);
}

std::string encloses(const rigor::Interval& value, const std::string& term) {
  constexpr int kDigits = 17;
  return fmt::format("{} <= {} <= {}",
                     decimal(rigor::to_decimal(value.lower(), kDigits, rigor::Direction::down)), term,
                     decimal(rigor::to_decimal(value.upper(), kDigits, rigor::Direction::up)));
}

}  // namespace veritrack::certificates::coq

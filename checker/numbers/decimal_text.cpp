#include "checker/numbers/decimal_text.hpp"

#include <mpfr.h>

#include <memory>
#include <utility>

namespace veritrack::checker {

namespace {

/// The digits of an exact ball, and the power of ten of the first one.
std::pair<std::string, long> digits_of(const Ball& exact, int digits, mpfr_rnd_t direction) {
  constexpr mpfr_prec_t kEnough = 8192;  // bits; an end of a ball has at most `precision()`
  mpfr_t number;
  mpfr_init2(number, kEnough);
  arf_get_mpfr(number, arb_midref(exact.raw()), MPFR_RNDN);
  mpfr_exp_t exponent = 0;
  const std::unique_ptr<char, void (*)(char*)> text(
      mpfr_get_str(nullptr, &exponent, 10, static_cast<std::size_t>(digits), number, direction),
      mpfr_free_str);
  mpfr_clear(number);
  std::string found = text.get();
  found.erase(0, found.starts_with('-') ? 1 : 0);
  return {found.substr(0, found.find_last_not_of('0') + 1), exponent - 1};
}

std::string decimal(const Ball& end, int digits, mpfr_rnd_t direction) {
  constexpr long kSmallestPlain = -5;
  constexpr long kLargestPlain = 9;
  if (certainly_equal(end, zero)) {
    return "0";
  }
  auto [text, power] = digits_of(end, digits, direction);
  const auto size = static_cast<long>(text.size());
  if (power < kSmallestPlain || power > kLargestPlain) {
    text = text.substr(0, 1) + (size > 1 ? "." + text.substr(1) : "") + "e" + std::to_string(power);
  } else if (power < 0) {
    text = "0." + std::string(static_cast<std::size_t>(-power - 1), '0') + text;
  } else if (size <= power + 1) {
    text += std::string(static_cast<std::size_t>(power + 1 - size), '0');
  } else {
    text.insert(static_cast<std::size_t>(power + 1), ".");
  }
  return (certainly_less(end, zero) ? "-" : "") + text;
}

}  // namespace

std::string upper_decimal(const Ball& value, int digits) {
  return value.finite() ? decimal(value.upper(), digits, MPFR_RNDU) : "inf";
}

std::string lower_decimal(const Ball& value, int digits) {
  return value.finite() ? decimal(value.lower(), digits, MPFR_RNDD) : "-inf";
}

}  // namespace veritrack::checker

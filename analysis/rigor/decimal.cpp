#include "analysis/rigor/decimal.hpp"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <memory>
#include <system_error>
#include <utility>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

namespace {

/// The number that the grammar check found: (-1)^negative * 0.DIGITS * base^scale, with a first digit that is
/// not zero. No digits mean zero.
struct Magnitude {
  bool negative = false;
  std::string digits;
  long scale = 0;  // in digits of the base; saturated at +-kScaleLimit
};

constexpr long kScaleLimit = 1'000'000'000;

/// No double has more than 767 significant decimal digits, so all doubles near a number lie on the grid of
/// its first kKeptDigits digits: cutting there, with one digit 1 for a non-zero rest, preserves the order
/// relative to every double.
constexpr std::size_t kKeptDigits = 1000;

constexpr int kDoublePrecision = 53;

bool is_digit(char c, int base) {
  const bool decimal = c >= '0' && c <= '9';
  const bool letter = (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  return decimal || (base == 16 && letter);
}

/// Reads the text from left to right.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text), rest_(text) {}

  /// Takes one character, when it is one of `choices`.
  char take_one_of(std::string_view choices) {
    if (rest_.empty() || choices.find(rest_.front()) == std::string_view::npos) {
      return '\0';
    }
    const char taken = rest_.front();
    rest_.remove_prefix(1);
    return taken;
  }

  std::string_view take_digits(int base) {
    std::size_t count = 0;
    while (count < rest_.size() && is_digit(rest_[count], base)) {
      ++count;
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  void require(bool condition, const char* what) const {
    if (!condition) {
      fail(what);
    }
  }

  void require_end() const { require(rest_.empty(), "not a number"); }

  [[noreturn]] void fail(const char* what) const {
    constexpr std::size_t kShown = 60;
    const std::string shown(text_.substr(0, kShown));
    throw NumberFormatError(std::string(what) + ": '" + shown + (text_.size() > kShown ? "...'" : "'"));
  }

 private:
  std::string_view text_;
  std::string_view rest_;
};

/// [+-] digits, saturated far beyond any exponent of a double.
long take_exponent(Reader& reader) {
  const bool negative = reader.take_one_of("+-") == '-';
  const std::string_view digits = reader.take_digits(10);
  reader.require(!digits.empty(), "an exponent without digits");
  long exponent = 0;
  for (const char digit : digits) {
    exponent = std::min(10 * exponent + (digit - '0'), kScaleLimit);
  }
  return negative ? -exponent : exponent;
}

/// Joins the digits before and after the point, without the zeros in front and beyond what can matter.
Magnitude normalised(bool negative, std::string_view whole, std::string_view fraction) {
  Magnitude result;
  result.negative = negative;
  result.scale = static_cast<long>(whole.size());
  bool rest_is_zero = true;
  for (const std::string_view part : {whole, fraction}) {
    for (const char digit : part) {
      if (result.digits.empty() && digit == '0') {
        --result.scale;
      } else if (result.digits.size() < kKeptDigits) {
        result.digits.push_back(digit);
      } else {
        rest_is_zero = rest_is_zero && digit == '0';
      }
    }
  }
  if (!rest_is_zero) {
    result.digits.push_back('1');
  }
  return result;
}

double round(const Magnitude& magnitude, int base, const std::string& exponent, mpfr_rnd_t direction) {
  MPFR_DECL_INIT(number, kDoublePrecision);
  const std::string text = (magnitude.negative ? "-0" : "0") + magnitude.digits + exponent;
  mpfr_strtofr(number, text.c_str(), nullptr, base, direction);
  // MPFR's own exponents are unbounded in effect. Where the number is below or above the normal range
  // of double this rounds a second time, in the same direction onto a coarser grid, which is the same as
  // rounding once.
  return mpfr_get_d(number, direction);
}

/// The tightest interval around (-1)^negative * DIGITS * (10 or 2)^written_exponent; `letter` introduces the
/// exponent.
Interval enclose(const Reader& reader, const Magnitude& magnitude, int base, char letter,
                 long written_exponent) {
  const NearestRounding mode;
  const std::string exponent = letter + std::to_string(written_exponent);
  const double lower = round(magnitude, base, exponent, MPFR_RNDD);
  const double upper = round(magnitude, base, exponent, MPFR_RNDU);
  Interval result = Interval::from_bounds(lower, upper);
  reader.require(is_finite(result), "larger than the largest double");
  return result;
}

}  // namespace

Interval parse_decimal(std::string_view text) {
  constexpr long kAboveRange = 320;
  constexpr long kBelowRange = -340;
  Reader reader(text);
  const bool negative = reader.take_one_of("+-") == '-';
  const std::string_view whole = reader.take_digits(10);
  const std::string_view fraction =
      reader.take_one_of(".") != '\0' ? reader.take_digits(10) : std::string_view{};
  reader.require(!whole.empty() || !fraction.empty(), "not a number");
  const long exponent = reader.take_one_of("eE") != '\0' ? take_exponent(reader) : 0;
  reader.require_end();

  const Magnitude magnitude = normalised(negative, whole, fraction);
  if (magnitude.digits.empty()) {
    return Interval(negative ? -0.0 : 0.0);
  }
  const long leading = magnitude.scale + exponent;
  reader.require(leading <= kAboveRange, "larger than the largest double");
  const long kept =
      std::max(leading, kBelowRange);  // a number below the range may be replaced by a larger such one
  return enclose(reader, magnitude, 10, 'e', kept - static_cast<long>(magnitude.digits.size()));
}

Interval parse_hexadecimal(std::string_view text) {
  constexpr long kAboveRange = 1040;
  constexpr long kBelowRange = -1100;
  Reader reader(text);
  const bool negative = reader.take_one_of("+-") == '-';
  const bool prefixed = reader.take_one_of("0") != '\0' && reader.take_one_of("xX") != '\0';
  reader.require(prefixed, "not a hexadecimal number");
  const std::string_view whole = reader.take_digits(16);
  const bool has_point = reader.take_one_of(".") != '\0';
  const std::string_view fraction = has_point ? reader.take_digits(16) : std::string_view{};
  reader.require(!whole.empty() && has_point == !fraction.empty(), "not a hexadecimal number");
  reader.require(reader.take_one_of("pP") != '\0', "a hexadecimal number without a binary exponent");
  const long exponent = take_exponent(reader);
  reader.require_end();

  const Magnitude magnitude = normalised(negative, whole, fraction);
  if (magnitude.digits.empty()) {
    return Interval(negative ? -0.0 : 0.0);
  }
  const long leading = 4 * magnitude.scale + exponent;
  reader.require(leading <= kAboveRange, "larger than the largest double");
  const long kept = std::max(leading, kBelowRange);
  return enclose(reader, magnitude, 16, 'p', kept - 4 * static_cast<long>(magnitude.digits.size()));
}

std::string to_hexadecimal(double value) {
  if (std::isnan(value)) {
    return "nan";
  }
  if (std::isinf(value)) {
    return value < 0.0 ? "-inf" : "inf";
  }
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.begin(), buffer.end(), std::fabs(value), std::chars_format::hex).ptr;
  return (std::signbit(value) ? "-0x" : "0x") + std::string(buffer.begin(), end);
}

namespace {

/// The digits of `value`, without a sign, and the exponent of 0.DIGITS * 10^exponent.
std::pair<std::string, long> significant_digits(double value, int digits, Direction direction) {
  const NearestRounding mode;
  MPFR_DECL_INIT(number, kDoublePrecision);
  mpfr_set_d(number, value, MPFR_RNDN);  // exact
  mpfr_exp_t exponent = 0;
  const std::unique_ptr<char, void (*)(char*)> text(
      mpfr_get_str(nullptr, &exponent, 10, static_cast<std::size_t>(digits), number,
                   direction == Direction::down ? MPFR_RNDD : MPFR_RNDU),
      mpfr_free_str);
  const std::string_view signed_digits = text.get();
  return {std::string(signed_digits.substr(signed_digits.starts_with('-') ? 1 : 0)), exponent};
}

void drop_trailing_zeros(std::string& digits) {
  while (digits.ends_with('0')) {
    digits.pop_back();
  }
}

std::string zeros(long count) {
  return std::string(static_cast<std::size_t>(count), '0');
}

/// 0.DIGITS * 10^scale in scientific notation.
std::string scientific(const std::string& digits, long scale) {
  std::string text = digits.substr(0, 1);
  if (digits.size() > 1) {
    text.append(".").append(digits, 1);
  }
  return text.append("e").append(std::to_string(scale - 1));
}

/// 0.DIGITS * 10^scale in plain notation.
std::string plain(const std::string& digits, long scale) {
  std::string text;
  if (scale <= 0) {
    return text.append("0.").append(zeros(-scale)).append(digits);
  }
  const auto count = static_cast<long>(digits.size());
  if (count <= scale) {
    return text.append(digits).append(zeros(scale - count));
  }
  const auto whole = static_cast<std::size_t>(scale);
  return text.append(digits, 0, whole).append(".").append(digits, whole);
}

}  // namespace

std::string to_decimal(double value, int digits, Direction direction) {
  constexpr long kSmallestPlainExponent = -5;
  constexpr long kLargestPlainExponent = 9;
  if (digits < 1 || digits > 40) {
    throw std::invalid_argument("to_decimal: between 1 and 40 significant digits");
  }
  if (!std::isfinite(value)) {
    return to_hexadecimal(value);
  }
  if (value == 0.0) {
    return "0";
  }
  auto [significand, scale] = significant_digits(value, digits, direction);
  drop_trailing_zeros(significand);
  const long exponent = scale - 1;  // of the first digit
  const bool is_plain = exponent >= kSmallestPlainExponent && exponent <= kLargestPlainExponent;
  const std::string magnitude = is_plain ? plain(significand, scale) : scientific(significand, scale);
  return (value < 0.0 ? std::string("-") : std::string()).append(magnitude);
}

std::string lower_decimal(const Interval& value, int digits) {
  return to_decimal(value.lower(), digits, Direction::down);
}

std::string upper_decimal(const Interval& value, int digits) {
  return to_decimal(value.upper(), digits, Direction::up);
}

std::string to_decimal(const Interval& value, int digits) {
  if (is_empty(value)) {
    return "[empty]";
  }
  std::string text = "[";
  text.append(to_decimal(value.lower(), digits, Direction::down)).append(", ");
  return text.append(to_decimal(value.upper(), digits, Direction::up)).append("]");
}

double nearest_double(std::string_view decimal) {
  const NearestRounding nearest;
  if (decimal.starts_with('+')) {
    decimal.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  if (error == std::errc::result_out_of_range) {
    return decimal.starts_with('-') ? -0.0 : 0.0;  // parse_decimal has refused what is too large
  }
  const bool read_whole = error == std::errc() && end == decimal.data() + decimal.size();
  return read_whole ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace veritrack::rigor

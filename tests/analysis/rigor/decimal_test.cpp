#include "analysis/rigor/decimal.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "tests/analysis/rigor/mpfr_oracle.hpp"
#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Direction;
using rigor::Interval;
using rigor::parse_decimal;
using rigor::parse_hexadecimal;
using rigor::to_decimal;
using rigor::to_hexadecimal;

namespace {

constexpr std::int64_t kDecimalCases = 200'000;

/// MPFR's own reading of a decimal, at 2000 bits, with the side on which it was rounded.
void read(Oracle& number, const std::string& text) {
  number.evaluate([&](mpfr_ptr result, mpfr_rnd_t mode) {
    return mpfr_strtofr(result, text.c_str(), nullptr, 10, mode);
  });
}

std::string random_digits(Random& random, std::uint64_t count) {
  std::string digits;
  while (count-- > 0) {
    digits.push_back(static_cast<char>('0' + random.below(10)));
  }
  return digits;
}

/// A decimal in the grammar, of any length and size that a double may hold.
std::string random_decimal(Random& random) {
  std::string text = random.below(2) == 0 ? "" : (random.below(2) == 0 ? "-" : "+");
  const std::uint64_t longest = random.below(50) == 0 ? 450 : 20;
  text += random_digits(random, 1 + random.below(longest == 450 ? 200 : longest));
  if (random.below(3) != 0) {
    text += "." + random_digits(random, random.below(longest));
  }
  if (random.below(3) != 0) {
    const std::uint64_t size = random.below(2) == 0 ? 30 : 340;
    const auto exponent = static_cast<int>(random.below(2 * size)) - static_cast<int>(size);
    text += (random.below(2) == 0 ? "e" : "E") + std::to_string(exponent);
  }
  return text;
}

bool is_tightest(const Oracle& number, const Interval& x) {
  return x.lower() == number.rounded_down() && x.upper() == number.rounded_up();
}

}  // namespace

TEST_CASE("decimals are read into the tightest interval, which holds the nearest double too") {
  Random random(30);
  Oracle number(2000);
  std::int64_t above_range = 0;
  std::int64_t wrong = 0;
  std::string first_wrong;
  for (std::int64_t round = effort(kDecimalCases); round > 0; --round) {
    const std::string text = random_decimal(random);
    read(number, text);
    const bool representable = number.is_at_least(-kLargest) && number.is_at_most(kLargest);
    bool right = false;
    try {
      const Interval parsed = parse_decimal(text);
      right = representable && is_tightest(number, parsed) &&
              rigor::contains(parsed, std::strtod(text.c_str(), nullptr));
    } catch (const rigor::NumberFormatError&) {
      right = !representable;
      ++above_range;
    }
    if (!right && wrong++ == 0) {
      first_wrong = text;
    }
  }
  CHECK_MESSAGE(wrong == 0, "first of ", wrong, ": ", first_wrong);
  CHECK(above_range > 0);
}

TEST_CASE("decimals next to doubles and half way between them are read exactly") {
  Operands operands(31);
  Oracle number(2400);
  Oracle other(2400);
  Misses misses;
  for (std::int64_t round = effort(kDecimalCases / 20); round > 0; --round) {
    const double value = operands.number();
    const double next = std::nextafter(value, 0.0);
    other = value;
    number = next;
    number.evaluate(mpfr_add, number.value(), other.value());
    other = 0.5;
    number.evaluate(mpfr_mul, number.value(), other.value());
    // 770 digits write a double, and the middle between two, in full; a digit more makes it differ by a hair.
    char buffer[900];
    mpfr_snprintf(buffer, sizeof buffer, "%.780Re", number.value());
    std::string text = buffer;
    misses.expect(is_tightest(number, parse_decimal(text)), "half way", value);
    text.insert(
        text.find('e'),
        "0000000000" + std::string(static_cast<std::size_t>(operands.random().below(400)), '0') + "7");
    read(other, text);
    misses.expect(is_tightest(other, parse_decimal(text)) || value == 0.0, "half way and a hair", value);
    mpfr_snprintf(buffer, sizeof buffer, "%.780Re", (other = value, other.value()));
    misses.expect(parse_decimal(buffer) == Interval(value), "a double written in full", value);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("a very long tail still matters, and costs little") {
  const std::string one_and_a_hair = "1." + std::string(1'000'000, '0') + "1";
  CHECK(identical(parse_decimal(one_and_a_hair), Interval::from_bounds(1.0, std::nextafter(1.0, 2.0))));
  CHECK(parse_decimal("1." + std::string(1'000'000, '0')) == Interval(1.0));
  CHECK(parse_decimal(std::string(100'000, '0') + "25e-2") == Interval(0.25));
  CHECK(parse_decimal("1" + std::string(100'000, '0') + "e-100000") == Interval(1.0));
  CHECK(parse_decimal("." + std::string(100'000, '0') + "1e100001") == Interval(1.0));
  CHECK(identical(parse_decimal("-0." + std::string(5'000, '3')),
                  Interval::from_bounds(-0x1.5555555555556p-2, -0x1.5555555555555p-2)));
}

TEST_CASE("small, zero and extreme decimals") {
  CHECK(identical(parse_decimal("0.1"), Interval::from_bounds(0x1.9999999999999p-4, 0x1.999999999999ap-4)));
  CHECK(identical(parse_decimal("1e-400"), Interval::from_bounds(0.0, kSmallest)));
  CHECK(identical(parse_decimal("-1e-99999999999999999999"), Interval::from_bounds(-kSmallest, 0.0)));
  CHECK(identical(parse_decimal("1.7976931348623157e308"),
                  Interval::from_bounds(std::nextafter(kLargest, 0.0), kLargest)));
  for (const char* zero : {"0", "-0", "+0.000", "0e99999999999999999999", ".0", "0.", "00e-5"}) {
    CHECK(parse_decimal(zero) == Interval(0.0));
  }
  for (const char* five : {"5", "+5", "5.", "5.0", "05", "0.5e1", ".5E+1", "50e-1", "500e-0002"}) {
    CHECK(parse_decimal(five) == Interval(5.0));
  }
}

TEST_CASE("what is not a finite decimal is refused") {
  for (const char* text : {"",
                           " ",
                           "+",
                           "-",
                           ".",
                           "e5",
                           ".e5",
                           "1e",
                           "1e+",
                           "1e-",
                           "1 ",
                           " 1",
                           "1.2.3",
                           "--1",
                           "+-1",
                           "1,5",
                           "0x10",
                           "0x1p3",
                           "1p3",
                           "nan",
                           "NaN",
                           "inf",
                           "-inf",
                           "infinity",
                           "1_000",
                           "1e5.0",
                           "1e 5",
                           "\xef\xbc\x91",
                           "1\n",
                           "1f",
                           "1e309",
                           "-1e309",
                           "1.7976931348623158e308",
                           "17976931348623157082e289",
                           "1e99999999999999999999"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS((void)parse_decimal(text), rigor::NumberFormatError);
  }
  CHECK_THROWS_AS((void)parse_decimal(std::string_view("1\0", 2)), rigor::NumberFormatError);
  CHECK_THROWS_AS((void)parse_decimal(std::string(400, '9')), rigor::NumberFormatError);
  try {
    (void)parse_decimal(std::string(100'000, 'x'));
  } catch (const rigor::NumberFormatError& error) {
    CHECK(std::string(error.what()).size() < 100);  // messages fit on a line
  }
}

TEST_CASE("hexadecimal floats go out and come back unchanged, and mean what strtod reads") {
  Operands operands(32);
  Misses misses;
  for (std::int64_t round = effort(kDecimalCases); round > 0; --round) {
    const double value = operands.number();
    const std::string text = to_hexadecimal(value);
    const Interval parsed = parse_hexadecimal(text);
    misses.expect(parsed == Interval(value) && std::signbit(parsed.lower()) == std::signbit(value),
                  "round trip", value);
    const double read_back = std::strtod(text.c_str(), nullptr);
    misses.expect(std::bit_cast<std::uint64_t>(read_back) == std::bit_cast<std::uint64_t>(value), "strtod",
                  value);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("hexadecimal floats: known texts") {
  CHECK(to_hexadecimal(3.0) == "0x1.8p+1");
  CHECK(to_hexadecimal(-0.0) == "-0x0p+0");
  CHECK(to_hexadecimal(kNaN) == "nan");
  CHECK(to_hexadecimal(kInfinity) == "inf");
  CHECK(to_hexadecimal(-kInfinity) == "-inf");
  CHECK(parse_hexadecimal("0X1.8P1") == Interval(3.0));
  CHECK(parse_hexadecimal("-0xff.8p-1") == Interval(-127.75));
  CHECK(parse_hexadecimal("0x0.0000000000001p-1022") == Interval(kSmallest));
  CHECK(identical(parse_hexadecimal("0x1.00000000000008p0"),
                  Interval::from_bounds(1.0, std::nextafter(1.0, 2.0))));
  CHECK(identical(parse_hexadecimal("0x1p-2000"), Interval::from_bounds(0.0, kSmallest)));
  CHECK(identical(parse_hexadecimal("-0x1.8p-1074"), Interval::from_bounds(-2 * kSmallest, -kSmallest)));
  for (const char* text : {"",         "1",       "0x",     "0x1",      "0x1.8",
                           "0x1p",     "0x1p+",   "0x.8p1", "0x1.p1",   "1.8p1",
                           "x1p1",     "00x1p1",  "0x1p1 ", "0x1p1024", "-0x1p99999999999999999999",
                           "0x1g.0p1", "0x1p0x1", "nan",    "inf",      "- 0x1p1"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS((void)parse_hexadecimal(text), rigor::NumberFormatError);
  }
}

TEST_CASE("decimals are written outward, and as closely as their digits allow") {
  Operands operands(33);
  Oracle number(2000);
  Oracle value(2000);
  Oracle error(2000);
  Misses misses;
  for (std::int64_t round = effort(kDecimalCases); round > 0; --round) {
    const double x = operands.number();
    const int digits = 1 + static_cast<int>(operands.random().below(40));
    const std::string down = to_decimal(x, digits, Direction::down);
    const std::string up = to_decimal(x, digits, Direction::up);
    const bool in_grammar = [&] {
      return down.find_first_not_of("-0123456789.e") == std::string::npos &&
             up.find_first_not_of("-0123456789.e") == std::string::npos;
    }();
    misses.expect(in_grammar, "characters", x);
    value = x;
    read(number, down);
    misses.expect(number.is_at_most(x), "downward", x, static_cast<double>(digits));
    error.evaluate(mpfr_sub, value.value(), number.value());
    const auto allowed = [&] { return std::fabs(x) * std::pow(10.0, 1 - digits) * 1.0000001 + kSmallest; };
    misses.expect(error.nearest() <= allowed(), "closeness downward", x, static_cast<double>(digits));
    read(number, up);
    misses.expect(number.is_at_least(x), "upward", x, static_cast<double>(digits));
    error.evaluate(mpfr_sub, number.value(), value.value());
    misses.expect(error.nearest() <= allowed(), "closeness upward", x, static_cast<double>(digits));
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("an interval written and read again holds the interval") {
  Operands operands(34);
  Misses misses;
  for (std::int64_t round = effort(kDecimalCases / 4); round > 0; --round) {
    const Interval x = operands.interval();
    if (!rigor::is_finite(x) || rigor::magnitude(x) > 1e308) {
      continue;
    }
    const int digits = 1 + static_cast<int>(operands.random().below(20));
    const std::string text = to_decimal(x, digits);
    const std::size_t comma = text.find(", ");
    REQUIRE((text.front() == '[' && text.back() == ']' && comma != std::string::npos));
    const Interval lower = parse_decimal(std::string_view(text).substr(1, comma - 1));
    const Interval upper = parse_decimal(std::string_view(text).substr(comma + 2, text.size() - comma - 3));
    misses.expect(lower.lower() <= x.lower() && x.upper() <= upper.upper(), "written interval", x);
    if (digits >= 17 && round % 8 == 0) {
      const Interval narrower =
          lower.upper() <= upper.lower() ? Interval::from_bounds(lower.upper(), upper.lower()) : x;
      misses.expect(
          is_subset(narrower, Interval::from_bounds(neighbour(x.lower(), -1), neighbour(x.upper(), 1))),
          "17 digits reach no farther than the next double", x);
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("decimals: known texts") {
  CHECK(to_decimal(0.5, 17, Direction::down) == "0.5");
  CHECK(to_decimal(0.1, 17, Direction::down) == "0.1");
  CHECK(to_decimal(0.1, 17, Direction::up) == "0.10000000000000001");
  CHECK(to_decimal(-0.1, 3, Direction::up) == "-0.1");
  CHECK(to_decimal(-0.1, 3, Direction::down) == "-0.101");
  CHECK(to_decimal(9.996, 3, Direction::up) == "10");
  CHECK(to_decimal(9.996, 3, Direction::down) == "9.99");
  CHECK(to_decimal(9999999999.0, 3, Direction::down) == "9990000000");
  CHECK(to_decimal(9999999999.0, 3, Direction::up) == "1e10");
  CHECK(to_decimal(1.25e-5, 2, Direction::down) == "0.000012");
  CHECK(to_decimal(1.5e-12, 2, Direction::up) == "1.6e-12");
  CHECK(to_decimal(0.0, 5, Direction::up) == "0");
  CHECK(to_decimal(-0.0, 5, Direction::up) == "0");
  CHECK(to_decimal(kInfinity, 5, Direction::up) == "inf");
  CHECK(to_decimal(-kInfinity, 5, Direction::down) == "-inf");
  CHECK(to_decimal(kNaN, 5, Direction::down) == "nan");
  CHECK(to_decimal(Interval()) == "[empty]");
  CHECK(to_decimal(Interval(0.25)) == "[0.25, 0.25]");
  CHECK(to_decimal(Interval::from_bounds(-1.0, kInfinity), 4) == "[-1, inf]");
  CHECK(to_decimal(Interval(1.0 / 3.0), 4) == "[0.3333, 0.3334]");
  CHECK_THROWS_AS((void)to_decimal(1.0, 0, Direction::up), std::invalid_argument);
  CHECK_THROWS_AS((void)to_decimal(1.0, 41, Direction::up), std::invalid_argument);
}

TEST_CASE("the ends of an interval are told outward") {
  const Interval third = Interval::from_bounds(0.33333333, 0.33333334);
  CHECK(lower_decimal(third) == "0.3333");
  CHECK(upper_decimal(third) == "0.3334");
  CHECK(lower_decimal(Interval(0.5), 2) == "0.5");
  CHECK(upper_decimal(Interval(0.5), 2) == "0.5");
  CHECK(lower_decimal(Interval::from_bounds(-0.33333334, 0.0)) == "-0.3334");
}

TEST_CASE("the rounding mode of the caller changes nothing, and comes back") {
  const rigor::UpwardRounding mode;
  CHECK(identical(parse_decimal("0.1"), Interval::from_bounds(0x1.9999999999999p-4, 0x1.999999999999ap-4)));
  CHECK(
      identical(parse_decimal("-0.1"), Interval::from_bounds(-0x1.999999999999ap-4, -0x1.9999999999999p-4)));
  CHECK(to_decimal(0.1, 3, Direction::down) == "0.1");
  CHECK(to_decimal(-0.1, 3, Direction::down) == "-0.101");
  CHECK(to_hexadecimal(0.1) == "0x1.999999999999ap-4");
  CHECK(rigor::rounding_is_upward());
}

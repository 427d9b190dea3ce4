#include "checker/document/design_number.hpp"

#include <stdexcept>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kLongest = 200;

/// Enough to distinguish decimals of this many characters from the doubles next to them.
constexpr slong kBits = 4096;

/// The end of a ball, rounded to a double away from the ball.
double outward(const Ball& end, arf_rnd_t direction) {
  return arf_get_d(arb_midref(end.raw()), direction);
}

constexpr std::string_view kHertz = " Hz";
constexpr std::string_view kHertzPerSecond = " Hz per second";
constexpr std::string_view kSeconds = " seconds";

/// A unit of time in its powers.
struct TimeUnit {
  std::string_view suffix;  ///< of the text
  int power;                ///< of the second
};

Ball read_in_unit(const Tree& number, const Tree& assume, const TimeUnit& unit, const std::string& name,
                  Objections& objections) {
  const std::string& text = text_of(number);
  if (!text.ends_with(unit.suffix)) {
    return read_not_negative(number, name, objections);
  }
  const Ball rate = read_positive(assume.at("sample_rate"), "sample_rate", objections);
  const Ball decimal = from_decimal(text.substr(0, text.size() - unit.suffix.size()));
  Ball value = unit.power == 1    ? decimal * rate
               : unit.power == -1 ? two * pi() * decimal / rate
                                  : two * pi() * decimal / rate / rate;
  const Ball low = low_of(number);
  const Ball high = high_of(number);
  constexpr double kCloseness = 0x1p-44;
  const bool is_enclosed = certainly_at_most(low, value) && certainly_at_most(value, high) &&
                           certainly_at_most(high - low, Ball(kCloseness) * high);
  if (!is_enclosed) {
    objections.push_back("[lo, hi] is no close enclosure of " + text);
  }
  if (!certainly_not_negative(value)) {
    objections.push_back(name + " must not be negative");
  }
  return value;
}

}  // namespace

Ball read_number(const Tree& number, Objections& objections) {
  const std::string& text = text_of(number);
  if (text.size() > kLongest) {
    throw std::invalid_argument("a decimal of more than 200 characters");
  }
  const Ball decimal = from_decimal(text, kBits);
  Ball low(outward(decimal.lower(kBits), ARF_RND_FLOOR));
  const Ball high(outward(decimal.upper(kBits), ARF_RND_CEIL));
  if (!low.finite() || !high.finite()) {
    throw std::invalid_argument("larger than the largest double: " + text);
  }
  if (!certainly_equal(low, low_of(number)) || !certainly_equal(high, high_of(number))) {
    objections.push_back("[lo, hi] is not the tightest enclosure of " + text);
  }
  if (certainly_equal(low, high)) {
    return low;
  }
  const Ball twice = decimal + decimal;
  if (certainly_less(twice, low + high)) {
    return Ball::from_end(low, decimal);
  }
  return certainly_less(low + high, twice) ? Ball::from_end(high, decimal) : Ball::hull(low, high);
}

Ball read_positive(const Tree& number, const std::string& name, Objections& objections) {
  Ball value = read_number(number, objections);
  if (!certainly_positive(value)) {
    objections.push_back(name + " must be positive");
  }
  return value;
}

Ball read_not_negative(const Tree& number, const std::string& name, Objections& objections) {
  Ball value = read_number(number, objections);
  if (!certainly_not_negative(value)) {
    objections.push_back(name + " must not be negative");
  }
  return value;
}

Ball read_frequency(const Tree& number, const Tree& assume, const std::string& name, Objections& objections) {
  return read_in_unit(number, assume, {kHertz, -1}, name, objections);
}

Ball read_slew(const Tree& number, const Tree& assume, Objections& objections) {
  return read_in_unit(number, assume, {kHertzPerSecond, -2}, "slew", objections);
}

Ball read_time(const Tree& number, const Tree& assume, const std::string& name, Objections& objections) {
  return read_in_unit(number, assume, {kSeconds, 1}, name, objections);
}

std::string words_of(const Tree& number, const std::string& unit) {
  const std::string& text = text_of(number);
  const bool has_unit = text.ends_with(kHertz) || text.ends_with(kHertzPerSecond) || text.ends_with(kSeconds);
  return has_unit ? text : text + unit;
}

Band read_band(const Tree& assume, Objections& objections) {
  const Tree& band = assume.at("frequency");
  if (band.elements().size() != 2) {
    objections.emplace_back("a band has two ends");
  }
  // A sentence names the unit once, behind both ends.
  if (text_of(band.at(0)).ends_with(kHertz) != text_of(band.at(1)).ends_with(kHertz)) {
    objections.emplace_back("the ends of a band are in the same unit");
  }
  Band ends{read_frequency(band.at(0), assume, "frequency", objections),
            read_frequency(band.at(1), assume, "frequency", objections)};
  const bool in_order =
      text_of(band.at(0)) == text_of(band.at(1)) || certainly_at_most(ends.lowest, ends.highest);
  if (!in_order || !certainly_less(ends.highest, pi())) {
    objections.emplace_back("the frequencies must go from low to high, and not beyond pi");
  }
  return ends;
}

const std::string& text_of(const Tree& number) {
  return number.at("text").text();
}

}  // namespace veritrack::checker

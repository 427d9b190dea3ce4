#include "checker/document/design_number.hpp"

#include <stdexcept>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kLongest = 200;

/// Enough for decimals of so many characters to be told from the doubles next to them.
constexpr slong kBits = 4096;

/// The end of a ball, rounded to a double away from the ball.
double outward(const Ball& end, arf_rnd_t direction) {
  return arf_get_d(arb_midref(end.raw()), direction);
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

Band read_band(const Tree& band, Objections& objections) {
  if (band.elements().size() != 2) {
    objections.emplace_back("a band has two ends");
  }
  Band ends{read_not_negative(band.at(0), "frequency", objections),
            read_not_negative(band.at(1), "frequency", objections)};
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

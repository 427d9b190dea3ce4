#include "checker/model/gain/exact_number.hpp"

#include <cmath>
#include <cstdlib>

namespace veritrack::checker {

namespace {

constexpr std::int64_t kLargestExact = kExactUnit << 15;

}  // namespace

std::optional<std::int64_t> exact_units(const Ball& value) {
  const double units = value.near() * static_cast<double>(kExactUnit);
  // cannot bind (value, near): only an exact number is equal to a double.
  if (!certainly_equal(value, Ball(value.near())) || std::floor(units) != units ||
      std::abs(units) >= static_cast<double>(kLargestExact)) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(units);
}

std::int64_t exact_product(std::int64_t x, std::int64_t y, int halves) {
  const std::int64_t product = x * y;  // below 2^62
  const std::int64_t unit = kExactUnit << halves;
  if (product % unit != 0 || std::llabs(product / unit) >= kLargestExact) {
    throw NotCovered("a product of exact numbers that is none");
  }
  return product / unit;
}

std::int64_t exact_sum(std::int64_t x, std::int64_t y) {
  if (std::llabs(x + y) >= kLargestExact) {
    throw NotCovered("a sum of exact numbers that is too large");
  }
  return x + y;
}

}  // namespace veritrack::checker

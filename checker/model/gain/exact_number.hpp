// Exact factors of waves (docs/gain-proof.md, section 2).
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// The rules of the frame do not cover a step: the method says nothing about it.
struct NotCovered : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An exact number, in units of 2^-16, times constants that are known by their numbers.
struct ConstantFactors {
  std::int64_t exact = 0;
  std::vector<int> named;  ///< in order
};
constexpr std::int64_t kExactUnit = 65'536;
/// The product in these units. Throws NotCovered unless it is one, below 2^15; of `halves` factors 1/2 more.
std::int64_t exact_product(std::int64_t x, std::int64_t y, int halves = 0);
/// Throws NotCovered if it is 2^15 or more.
std::int64_t exact_sum(std::int64_t x, std::int64_t y);
/// In these units, if it is a whole number of them, and below 2^15.
std::optional<std::int64_t> exact_units(const Ball& value);

}  // namespace veritrack::checker

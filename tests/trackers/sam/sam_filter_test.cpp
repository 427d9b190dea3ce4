#include "trackers/sam/sam_filter.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Subfilters = std::vector<MedianSubfilter<double>>;

Subfilters random_subfilters(Random& random, std::size_t window) {
  Subfilters result;
  while (result.size() < 4) {
    const auto inputs = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << window));
    if (std::popcount(inputs) % 2 == 1) {
      result.push_back({inputs, random.uniform(-1.0, 1.0)});
    }
  }
  return result;
}

TEST_CASE("threshold decomposition: the output is the sum over levels of weighted majorities") {
  Random random(471);
  for (int run = 0; run < 500; ++run) {
    const std::size_t window = 1 + static_cast<std::size_t>(random.below(12));
    const auto subfilters = random_subfilters(random, window);
    std::vector<double> inputs(window);
    for (auto& input : inputs) {
      input = static_cast<double>(random.below(8));
    }
    double expected = 0.0;
    for (int level = 1; level < 8; ++level) {
      for (const auto& subfilter : subfilters) {
        int above = 0;
        for (std::size_t j = 0; j < window; ++j) {
          above += (subfilter.inputs >> j & 1U) != 0 && inputs[j] >= level ? 1 : 0;
        }
        expected += 2 * above > std::popcount(subfilter.inputs) ? subfilter.weight : 0.0;
      }
    }
    CHECK(SamFilter<double>(window, subfilters).output(inputs) == doctest::Approx(expected));
  }
}

TEST_CASE("it commutes with scale, sign and, up to the sum of weights, offset") {
  Random random(472);
  for (int run = 0; run < 200; ++run) {
    const auto subfilters = random_subfilters(random, 7);
    const SamFilter<double> filter(7, subfilters);
    double weights = 0.0;
    for (const auto& subfilter : subfilters) {
      weights += subfilter.weight;
    }
    std::vector<double> inputs(7);
    std::vector<double> mapped(7);
    const double scale = random.uniform(-2.0, 2.0);
    for (std::size_t j = 0; j < 7; ++j) {
      inputs[j] = random.uniform(-1.0, 1.0);
      mapped[j] = scale * inputs[j] + 3.0;
    }
    CHECK(filter.output(mapped) == doctest::Approx(scale * filter.output(inputs) + 3.0 * weights));
  }
}

TEST_CASE(
    "single inputs make a linear filter, oldest first; the whole window removes impulses and keeps edges") {
  SamFilter<double> linear(3, {{1U, 0.5}, {2U, -1.0}, {4U, 2.0}});
  CHECK(linear.step(1.0) == 1.5);  // filled with the first sample
  CHECK(linear.step(5.0) == 0.5 - 1.0 + 10.0);
  CHECK(linear.step(2.0) == 0.5 - 5.0 + 4.0);
  auto median = median_filter<double>(5);
  std::vector<double> output;
  for (const double sample : {0.0, 0.0, 9.0, 0.0, -9.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0}) {
    output.push_back(median.step(sample));
  }
  for (std::size_t k = 0; k < output.size(); ++k) {
    CHECK(output[k] == (k < 10 ? 0.0 : 1.0));
  }
}

TEST_CASE("what is no odd subset of a window is refused") {
  CHECK_THROWS_AS(SamFilter<double>(0, {{1U, 1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(SamFilter<double>(33, {{1U, 1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(SamFilter<double>(3, {}), std::invalid_argument);
  CHECK_THROWS_AS(SamFilter<double>(3, {{3U, 1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(SamFilter<double>(3, {{8U, 1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(median_filter<double>(4), std::invalid_argument);
  CHECK_NOTHROW(SamFilter<double>(32, {{0x80000000U, 1.0}}));
}

}  // namespace
}  // namespace veritrack::trackers

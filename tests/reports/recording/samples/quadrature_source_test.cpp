#include "reports/recording/samples/quadrature_source.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "tests/reports/recording/recorded_tone.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("samples keep their numbers; without a quadrature part they are missing") {
  constexpr int kHalfLength = 31;
  for (const std::size_t block : {1U, 100U, 5000U}) {
    auto tone = test::recorded_tone(9000, 1, 0.0, [](std::size_t) { return 0.9; });
    tone[5000].is_present = false;
    const auto original = tone;
    QuadratureSource source(std::make_unique<test::MemorySource>(tone, 1), kHalfLength);
    CHECK(source.channels() == 2);
    std::vector<RecordedSample> read;
    std::vector<RecordedSample> part(block);
    for (std::size_t count = block; count == block;) {
      count = source.read(part);
      read.insert(read.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
    }
    REQUIRE(read.size() == original.size());
    const double gain = source.filter().gain(0.9);
    for (std::size_t k = 0; k < read.size(); ++k) {
      const bool at_the_ends = k < kHalfLength || k >= 9000 - kHalfLength;
      const bool at_the_gap = k >= 5000 - kHalfLength && k <= 5000 + kHalfLength;
      CHECK(read[k].is_present == !(at_the_ends || at_the_gap));
      if (read[k].is_present) {
        const double phase = 0.3 + 0.9 * static_cast<double>(k);
        CHECK(read[k].in_phase == original[k].in_phase);
        CHECK(std::fabs(read[k].quadrature - gain * std::sin(phase)) < 1e-9);
      }
    }
  }
}

TEST_CASE("a recording that is shorter than the filter is missing throughout") {
  QuadratureSource source(std::make_unique<test::MemorySource>(
                              test::recorded_tone(20, 1, 0.0, [](std::size_t) { return 0.9; }), 1),
                          31);
  std::vector<RecordedSample> block(100);
  CHECK(source.read(block) == 20);
  CHECK_FALSE(block[10].is_present);
}

}  // namespace
}  // namespace veritrack::reports

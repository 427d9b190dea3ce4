#include "reports/recording/samples/overheard_source.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/recorded_tone.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("the listener hears every sample once, in order, with its number, and the reader gets the same") {
  const auto tone = test::recorded_tone(1000, 2, 0.1, [](std::size_t) { return 0.7; });
  OverheardSource source(std::make_unique<test::MemorySource>(tone, 2));
  std::vector<double> heard;
  source.listen([&](std::int64_t index, const RecordedSample& sample) {
    CHECK(index == static_cast<std::int64_t>(heard.size()));
    heard.push_back(sample.quadrature);
  });
  std::vector<RecordedSample> block(300);
  std::size_t read = 0;
  while (const std::size_t count = source.read(block)) {
    CHECK(block.front().in_phase == tone[read].in_phase);
    read += count;
  }
  CHECK(read == 1000);
  REQUIRE(heard.size() == 1000);
  CHECK(heard[777] == tone[777].quadrature);
  CHECK(source.channels() == 2);
}

}  // namespace
}  // namespace veritrack::reports

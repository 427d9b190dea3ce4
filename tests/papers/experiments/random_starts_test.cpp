#include "papers/experiments/random_starts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

namespace veritrack::experiments {
namespace {

double count_of(const std::vector<double>& lost) {
  return std::accumulate(lost.begin(), lost.end(), 0.0);
}

TEST_CASE("random starts: the same for every design, more of them the same ones first, each 0 or 1") {
  const auto some = starts_without_lock({0.0023, 0.0023, 0.05, 0.0}, 50);
  const auto more = starts_without_lock({0.0023, 0.0023, 0.05, 0.0}, 80);
  REQUIRE(some.size() == 50);
  CHECK(std::equal(some.begin(), some.end(), more.begin()));
  CHECK(std::all_of(more.begin(), more.end(), [](double lost) { return lost == 0.0 || lost == 1.0; }));
}

TEST_CASE("a tracker that trusts nothing but its first frequency never locks; a fast one always does") {
  CHECK(count_of(starts_without_lock({1e-12, 1e-12, 1.0, 0.0}, 100)) > 90.0);
  CHECK(count_of(starts_without_lock({0.023, 0.0023, 0.05, 0.0}, 100)) == 0.0);
}

TEST_CASE("less noise on the signal's states than on the frequency loses starts, as lemma 1 has it") {
  const double equal = count_of(starts_without_lock({0.0005, 0.0005, 0.05, 0.0}, 300));
  const double less = count_of(starts_without_lock({0.00005, 0.0005, 0.05, 0.0}, 300));
  CHECK(equal > 40.0);
  CHECK(less > equal + 20.0);
}

}  // namespace
}  // namespace veritrack::experiments

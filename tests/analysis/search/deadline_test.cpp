#include "analysis/search/deadline.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace veritrack::search {
namespace {

TEST_CASE("without a limit nothing is ever over") {
  const Deadline never;
  CHECK_FALSE(never.is_set());
  CHECK_FALSE(never.is_over());
  CHECK_FALSE(never.has_struck());
}

TEST_CASE("a limit is over when its time has come, and strikes when somebody asks") {
  const Deadline far(1e6);
  CHECK(far.is_set());
  CHECK_FALSE(far.is_over());
  CHECK_FALSE(Deadline(1e300).is_over());
  const Deadline near(1e-3);
  const Deadline copy = near;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK_FALSE(near.has_struck());
  CHECK(near.is_over());
  CHECK(near.has_struck());
  CHECK(copy.has_struck());
}

TEST_CASE("a wish to stop is as good as a limit, for all copies") {
  std::atomic<bool> stop{false};
  for (const Deadline& both : {Deadline().or_when(stop), Deadline(1e6).or_when(stop)}) {
    stop = false;
    const Deadline copy = both;
    CHECK(both.is_set());
    CHECK_FALSE(both.is_over());
    stop = true;
    CHECK_FALSE(both.has_struck());
    CHECK(both.is_over());
    CHECK(copy.has_struck());
    stop = false;
    CHECK(copy.is_over());  // it stays over
  }
}

}  // namespace
}  // namespace veritrack::search

#include "analysis/search/deadline.hpp"

#include <doctest/doctest.h>

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

}  // namespace
}  // namespace veritrack::search

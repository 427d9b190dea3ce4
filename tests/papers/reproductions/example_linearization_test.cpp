#include "papers/reproductions/example_linearization.hpp"

#include <doctest/doctest.h>

#include <cstddef>

namespace veritrack::reports {
namespace {

TEST_CASE("the section says that F as printed locks in none of 20 seeds, whatever Q, leak and start") {
  const std::string text = linearization_section();
  CHECK(text.find("locks on both frequencies of Example 1 for none of these seeds, for either Q") !=
        std::string::npos);
  // Two readings of Q, two leaks, five starts.
  std::size_t rows = 0;
  for (std::size_t at = text.find("| 0 of 20 | "); at != std::string::npos;
       at = text.find("| 0 of 20 | ", at + 1)) {
    ++rows;
  }
  CHECK(rows >= 20);
}

}  // namespace
}  // namespace veritrack::reports

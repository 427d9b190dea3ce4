#include "certificates/model/tie/driver_text.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace veritrack::certificates::tie {

TEST_CASE("the name of a state may be that of an element of an array") {
  CHECK(expressions_of("pll.phase") == std::vector<std::string>{"pll.phase"});
  CHECK(expressions_of("past_2") == std::vector<std::string>{"past_2", "past[2]"});
  CHECK(expressions_of("m_1_2.x_10") == std::vector<std::string>{"m_1_2.x_10", "m[1][2].x[10]"});
  CHECK(expressions_of("x2.y_z") == std::vector<std::string>{"x2.y_z"});
}

TEST_CASE("paths are strings of C") {
  trackers::code::Listing listing;
  const std::string text = main_text(listing, "/a\"b/in", "/a\\b/out");
  CHECK(text.find(R"("/a\"b/in")") != std::string::npos);
  CHECK(text.find(R"("/a\\b/out")") != std::string::npos);
}

}  // namespace veritrack::certificates::tie

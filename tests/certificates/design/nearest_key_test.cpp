#include "certificates/design/nearest_key.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/random.hpp"

namespace {

using veritrack::certificates::edit_distance;
using veritrack::certificates::nearest_key;

/// The definition, word for word, without a table.
std::size_t defined_distance(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) {
    return a.size() + b.size();
  }
  const std::string shorter_a = a.substr(0, a.size() - 1);
  const std::string shorter_b = b.substr(0, b.size() - 1);
  std::size_t least = std::min({defined_distance(shorter_a, b) + 1, defined_distance(a, shorter_b) + 1,
                                defined_distance(shorter_a, shorter_b) + (a.back() == b.back() ? 0 : 1)});
  if (a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] && b.back() == a[a.size() - 2]) {
    least = std::min(least, defined_distance(a.substr(0, a.size() - 2), b.substr(0, b.size() - 2)) + 1);
  }
  return least;
}

}  // namespace

TEST_CASE("edit distances that are known") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("desing", "design") == 1);
  CHECK(edit_distance("ca", "abc") == 3);
}

TEST_CASE("the edit distance is the one defined") {
  veritrack::test::Random random;
  for (std::int64_t trial = 0; trial < veritrack::test::effort(300); ++trial) {
    std::string a(random.below(6), 'a');
    std::string b(random.below(6), 'a');
    for (std::string* word : {&a, &b}) {
      for (char& letter : *word) {
        letter = static_cast<char>('a' + random.below(3));
      }
    }
    CAPTURE(a);
    CAPTURE(b);
    CHECK(edit_distance(a, b) == defined_distance(a, b));
  }
}

TEST_CASE("the nearest key is sought by the path and by its last part") {
  const std::vector<std::string> known{"name", "design", "design.q1", "design.epsilon", "assume.noise"};
  CHECK(nearest_key("desing", known) == "design");
  CHECK(nearest_key("design.q2", known) == "design.q1");
  CHECK(nearest_key("epsilom", known) == "design.epsilon");
  CHECK(nearest_key("require.noise", known) == "assume.noise");
  CHECK(nearest_key(std::string(1'000'000, 'x'), known) == "name");
}

#include "certificates/code/harness/tree_nodes.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

namespace veritrack::certificates::code {

TEST_CASE("types are those behind typedefs, but for arrays, and without namespaces that have no name") {
  CHECK(type_of_node({{"type", {{"qualType", "real_t"}, {"desugaredQualType", "float"}}}}) == "float");
  CHECK(type_of_node({{"type", {{"qualType", "gains"}, {"desugaredQualType", "float[3]"}}}}) == "gains");
  CHECK(type_of_node({{"type", {{"qualType", "(anonymous namespace)::Loop *"}}}}) == "Loop *");
  CHECK(type_of_node({{"kind", "CompoundStmt"}}).empty());
}

TEST_CASE("the place of a macro is where it is used") {
  const nlohmann::json place = {{"file", "a.c"}, {"line", 3}, {"col", 7}};
  CHECK(place_of_node({{"loc", place}}).line == 3);
  CHECK(place_of_node({{"loc", {{"spellingLoc", {{"line", 1}}}, {"expansionLoc", place}}}}).column == 7);
  CHECK(place_of_node({{"kind", "NullStmt"}}).line == 0);
}

}  // namespace veritrack::certificates::code

#include "checker/document/json_tree.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace veritrack::checker;

TEST_CASE("a tree contains what the text says, in its order") {
  const Tree tree = read_json(R"({"b": [true, "x", 3, null], "a": {"c": false}})");
  CHECK(tree.kind() == Tree::Kind::object);
  REQUIRE(tree.members().size() == 2);
  CHECK(tree.members()[0].first == "b");
  const Tree& list = tree.at("b");
  REQUIRE(list.elements().size() == 4);
  CHECK(list.at(0).truth());
  CHECK(list.at(1).text() == "x");
  CHECK(list.at(2).kind() == Tree::Kind::integer);
  CHECK(list.at(2).integer() == 3);
  CHECK(list.at(3).kind() == Tree::Kind::nothing);
  CHECK(!tree.at("a").at("c").truth());
  CHECK(tree.find("d") == nullptr);
}

TEST_CASE("what is asked for as another type, or is not there, is malformed") {
  const Tree tree = read_json(R"({"text": "x", "list": [1]})");
  CHECK_THROWS_AS((void)tree.at("none"), Malformed);
  CHECK_THROWS_AS((void)tree.at("text").truth(), Malformed);
  CHECK_THROWS_AS((void)tree.at("text").integer(), Malformed);
  CHECK_THROWS_AS((void)tree.at("text").elements(), Malformed);
  CHECK_THROWS_AS((void)tree.at("list").members(), Malformed);
  CHECK_THROWS_AS((void)tree.at("list").at(1), Malformed);
  CHECK_THROWS_AS((void)tree.text(), Malformed);
}

TEST_CASE("no text has two meanings") {
  const std::string deep(100000, '[');
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[1,]"), std::string("[1] 2"),
        std::string(R"({"a": 1, "a": 1})"), std::string(R"({"a": {"b": 1, "b": 2}})"),
        std::string(R"({"a": 1, "\u0061": 2})"), std::string("[0.5]"), std::string("[1e3]"),
        std::string("[99999999999999999999]"), std::string("[NaN]"), std::string("\"\xff\""), deep}) {
    CHECK_THROWS_AS_MESSAGE((void)read_json(text), Malformed, text.substr(0, 40));
  }
  // The same name in different objects is not a duplicate.
  CHECK(read_json(R"([{"a": 1}, {"a": 2}])").elements().size() == 2);
}

TEST_CASE("a text is not read beyond so many values") {
  std::string text = "[";
  for (int k = 0; k < 4'000'001; ++k) {
    text += "0,";
  }
  text.back() = ']';
  CHECK_THROWS_WITH_AS((void)read_json(text), "more than 4000000 values", Malformed);
}

TEST_CASE("what is not read is named, and names that were read are not copied") {
  const Tree tree = read_json(R"({"a": {"b": ["x", {"c": true}], "d": {}}, "e": 1})");
  CHECK(tree.unread(10) == std::vector<std::string>{"a.b[0]", "a.b[1].c", "a.d", "e"});
  CHECK(tree.unread(2) == std::vector<std::string>{"a.b[0]", "a.b[1].c"});
  CHECK(tree.unread(0).empty());
  CHECK(tree.at("e").integer() == 1);
  CHECK(tree.at("a").at("b").at(0).text() == "x");
  CHECK(tree.unread(10) == std::vector<std::string>{"a.b[1].c", "a.d"});
  // Once for each name, a copy of the long one would take hours.
  std::string wide = "{\"" + std::string(1'000'000, 'n') + "\": [";
  for (int k = 0; k < 100'000; ++k) {
    wide += "[],";
  }
  wide.back() = ']';
  const Tree read = read_json(wide + "}");
  for (const Tree& each : read.members().front().second.elements()) {
    CHECK(each.elements().empty());
  }
  CHECK(read.unread(10).empty());
}

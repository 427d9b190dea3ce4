// Walks the table of checker/README.md: what each sentence rests on, where that is established, and a forgery
// in which it is false.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/golden.hpp"

namespace {

using namespace veritrack;

using Texts = std::vector<std::string>;

const std::string kCheckout = VERITRACK_SOURCE_DIR "/";

/// What stands between two marks, one after the other.
Texts between(const std::string& text, const std::string& open, const std::string& close) {
  Texts found;
  for (std::size_t begin = text.find(open); begin != std::string::npos; begin = text.find(open, begin)) {
    begin += open.size();
    const std::size_t end = text.find(close, begin);
    REQUIRE(end != std::string::npos);
    found.push_back(text.substr(begin, end - begin));
    begin = end + close.size();
  }
  return found;
}

struct Row {
  std::string line, claims, theorem, hypothesis, established, broken;
};

std::vector<Row> table() {
  const std::string document = test::read_file(kCheckout + "checker/README.md");
  const std::size_t begin = document.find("## What each sentence rests on\n");
  REQUIRE(begin != std::string::npos);
  std::istringstream section(document.substr(begin, document.find("\n## ", begin + 1) - begin));
  std::vector<Row> rows;
  for (std::string line; std::getline(section, line);) {
    if (!line.starts_with("| `")) {
      continue;
    }
    Texts cells;
    std::string rest = line.substr(2);
    for (std::size_t end = rest.find(" |"); end != std::string::npos; end = rest.find(" |")) {
      cells.push_back(rest.substr(0, end));
      rest = rest.substr(std::min(rest.size(), end + 3));
    }
    REQUIRE_MESSAGE(cells.size() == 5, line);
    rows.push_back({line, cells[0], cells[1], cells[2], cells[3], cells[4]});
  }
  return rows;
}

/// Identifiers of claims: quoted in the sources of the checker, and those that accepted certificates have.
std::set<std::string> known_claims() {
  const Texts kinds{"ekf/", "model/", "dft-block/", "kkl/", "regulator/", "recursion/", "proposition-"};
  std::set<std::string> claims;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kCheckout + "checker")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") {
      continue;
    }
    std::istringstream source(test::read_file(entry.path().string()));
    for (std::string line; std::getline(source, line);) {
      line = line.substr(0, line.find("//"));
      for (const std::string& kind : kinds) {
        for (std::size_t at = line.find('"' + kind); at != std::string::npos;
             at = line.find('"' + kind, at + 1)) {
          const std::string id = line.substr(at + 1, line.find('"', at + 1) - at - 1);
          if (id != kind && id.find_first_of(" .") == std::string::npos) {
            claims.insert(id);
          }
        }
      }
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(kCheckout + "tests/certificates/accepted")) {
    for (const nlohmann::json& claim :
         nlohmann::json::parse(test::read_file(entry.path().string())).at("claims")) {
      claims.insert(claim.at("id").get<std::string>());
    }
  }
  return claims;
}

}  // namespace

TEST_CASE("every claim that the checker knows has its hypotheses in the table") {
  Texts named;
  for (const Row& row : table()) {
    for (const std::string& id : between(row.claims, "`", "`")) {
      named.push_back(id);
    }
  }
  const std::set<std::string> claims = known_claims();
  CHECK(claims.size() > 50);
  for (const std::string& id : claims) {
    const bool is_named = std::any_of(named.begin(), named.end(), [&](const std::string& one) {
      return one == id || (one.ends_with('*') && id.starts_with(one.substr(0, one.size() - 1)));
    });
    CHECK_MESSAGE(is_named, id << " is not in the table of checker/README.md");
  }
}

TEST_CASE("the theorem of a sentence is in the document, and the check in the file") {
  const std::vector<Row> rows = table();
  CHECK(rows.size() > 40);
  for (const Row& row : rows) {
    CHECK_MESSAGE(row.hypothesis.size() > 10, row.line);
    const Texts documents = between(row.theorem, "(../docs/", ")");
    REQUIRE_MESSAGE(documents.size() == 1, row.line);
    const std::string text = test::read_file(kCheckout + "docs/" + documents.front());
    for (const std::string& number : between(row.theorem + " ", "section ", " ")) {
      CHECK_MESSAGE(text.find("\n## " + number + ".") != std::string::npos, row.line);
    }
    const Texts places = between(row.established, "`", "`");
    REQUIRE_MESSAGE((!places.empty() && places.size() % 2 == 0), row.line);
    for (std::size_t i = 0; i < places.size(); i += 2) {
      CHECK_MESSAGE(
          test::read_file(kCheckout + "checker/" + places[i + 1]).find(places[i] + "(") != std::string::npos,
          places[i] << " is not in " << places[i + 1]);
    }
  }
}

TEST_CASE("each hypothesis is false in a forgery that is refused for it") {
  for (const Row& row : table()) {
    const Texts names = between(row.broken, "`", "`");
    REQUIRE_MESSAGE(!names.empty(), row.line);
    for (const std::string& name : names) {
      const nlohmann::json forgery =
          nlohmann::json::parse(test::read_file(kCheckout + "tests/certificates/rejected/" + name + ".json"));
      const std::size_t words = row.broken.find("`" + name + "`: \"") + name.size() + 5;
      const std::string said = row.broken.substr(words, row.broken.find("\"; `", words) - words);
      const std::string objection = said.ends_with('"') ? said.substr(0, said.size() - 1) : said;
      CHECK_MESSAGE(forgery.at("objection").get<std::string>().find(objection) != std::string::npos,
                    name << ": " << objection);
      CHECK_MESSAGE(objection.size() > 10, row.line);
    }
  }
}

#include "certificates/help/explanation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <any>
#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/toml_source.hpp"
#include "certificates/help/design_template.hpp"
#include "certificates/help/texts.hpp"

namespace {

using namespace veritrack::certificates;  // NOLINT(google-build-using-namespace): the subject of this file

/// "tracker: table.key" of every key that a design file may have below its first lines.
std::set<std::string> known_keys() {
  std::set<std::string> keys;
  for (const DesignFormat* format : design_formats()) {
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      for (const BoundKey& key : table.keys) {
        keys.insert(std::string(table.name) + "." + std::string(key.name));
      }
    }
  }
  return keys;
}

std::string part(const Explanation& explanation, std::string_view heading) {
  const auto found = std::find_if(explanation.parts.begin(), explanation.parts.end(),
                                  [&](const auto& one) { return one.first == heading; });
  return found == explanation.parts.end() ? "" : found->second;
}

}  // namespace

TEST_CASE("every key of every tracker is explained, with what is allowed") {
  for (const DesignFormat* format : design_formats()) {
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      for (const BoundKey& key : table.keys) {
        const std::string name = std::string(table.name) + "." + std::string(key.name);
        INFO(format->tracker, ": ", name);
        const std::vector<Explanation> found = explain(name);
        const auto of_tracker =
            std::count_if(found.begin(), found.end(), [&](const Explanation& explanation) {
              return std::count(explanation.trackers.begin(), explanation.trackers.end(), format->tracker) ==
                         1 &&
                     part(explanation, "Allowed") == key.allowed && !part(explanation, "Meaning").empty();
            });
        CHECK(of_tracker == 1);
      }
    }
  }
}

TEST_CASE("no text explains a key that does not exist") {
  std::set<std::string> known = known_keys();
  known.insert({"name", "tracker", "source"});
  for (const EmbeddedText& text : explanation_texts()) {
    const TomlSource source(text.text, text.name, TomlSource::Origin::built_in);
    const toml::table* keys = source.root().get_as<toml::table>("key");
    for (const auto& [key, entry] : keys != nullptr ? *keys : toml::table{}) {
      INFO(text.name, ": ", key.str());
      CHECK(known.count(std::string(key.str())) == 1);
    }
  }
}

TEST_CASE("every claim says what it claims, how it is proved, under which hypotheses and where that stands") {
  std::set<std::string> names;
  for (const Explanation& explanation : explanations()) {
    if (!explanation.trackers.empty()) {
      continue;
    }
    INFO(explanation.name);
    CHECK(names.insert(explanation.name).second);
    for (const char* heading : {"Claim", "Proof", "Hypotheses", "Source"}) {
      CHECK(part(explanation, heading) != "");
    }
  }
  CHECK(names.size() > 50);
}

TEST_CASE("a word may be a claim, a key, a table, or a place of a proof") {
  CHECK(explain("ekf/guarantee").size() == 1);
  CHECK(explain("design.q1").size() == 2);
  CHECK(explain("q1").size() == 2);
  CHECK(explain("theorem_2_9").size() == 5);
  CHECK(explain("theorem-2.9/b_1").size() == 2);
  CHECK(explain("theorem-2.9/b_1/errata").size() == 1);
  CHECK(explain("frequency").size() > 2);
  CHECK(explain("").empty());
  CHECK(explain("q").size() == 1);
  CHECK(explain("desig").empty());
  CHECK(nearest_explained("slwe") == "slew");
  CHECK(nearest_explained("ekf/garantee") == "ekf/guarantee");
}

TEST_CASE("the keys of a column go before those that it shares") {
  for (const Explanation& explanation : explain("frequency_error_below")) {
    const bool is_continuous = explanation.trackers.front() == "kkl-observer";
    CHECK(part(explanation, "Unit").starts_with(is_continuous ? "rad/s" : "rad/sample"));
    CHECK((part(explanation, "Unit") == "rad/s") == is_continuous);
  }
}

TEST_CASE("every tracker has a design file to begin with, which the reader takes") {
  CHECK(templates_for().size() == design_formats().size());
  for (const std::string& tracker : templates_for()) {
    INFO(tracker);
    CHECK(read_design(design_template(tracker), "new.toml").tracker == tracker);
  }
  CHECK_THROWS_AS((void)design_template("no-such-tracker"), std::out_of_range);
}

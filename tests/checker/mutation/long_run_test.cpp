// Forged sets of a filter in the long run, and of one whose frequency moves.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/checker/mutation/changes.hpp"

using namespace veritrack;
using namespace veritrack::test;

namespace {

using Change = std::pair<std::string, std::function<void(Json&)>>;

/// The set of that name.
Json& set_in(Json& certificate, const std::string& name) {
  for (Json& set : certificate["tubes"]) {
    if (set["name"] == name) {
      return set;
    }
  }
  throw std::logic_error("no set " + name);
}
Json& cell_of(Json& certificate, const std::string& name) {
  return set_in(certificate, name)["cells"][0];
}
void scale_number(Json& number, double factor) {
  number = hexadecimal(factor * std::strtod(number.get<std::string>().c_str(), nullptr));
}
/// All coefficients of a list of series.
void scale_series(Json& list, double factor) {
  for (Json& series : list) {
    for (Json& harmonic : series) {
      for (Json& coefficient : harmonic) {
        scale_number(coefficient[0], factor);
        scale_number(coefficient[1], factor);
      }
    }
  }
}
void remove_set(Json& certificate, const std::string& name) {
  Json kept = Json::array();
  for (const Json& set : certificate["tubes"]) {
    if (set["name"] != name) {
      kept.push_back(set);
    }
  }
  certificate["tubes"] = kept;
}

void check_refused(const char* name, const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    Json certificate = accepted(name);
    change.second(certificate);
    CHECK_MESSAGE(!verified(certificate), change.first);
  }
}

}  // namespace

TEST_CASE("forged bounds of the covariance in the long run are refused" * doctest::test_suite("nightly")) {
  check_refused(
      "model-filter-long-run",
      {{"swapped",
        [](Json& c) {
          std::swap(cell_of(c, "long-run")["covariance_low"], cell_of(c, "long-run")["covariance_high"]);
        }},
       {"empty",
        [](Json& c) {
          cell_of(c, "long-run")["covariance_low"] = cell_of(c, "long-run")["covariance_high"];
        }},
       {"too narrow above", [](Json& c) { scale_series(cell_of(c, "long-run")["covariance_high"], 0.97); }},
       {"too narrow below", [](Json& c) { scale_series(cell_of(c, "long-run")["covariance_low"], 1.03); }},
       {"not around it", [](Json& c) { cell_of(c, "long-run")["entry"]["ratio"] = hexadecimal(1.0); }},
       {"reached sooner", [](Json& c) { cell_of(c, "long-run")["entry"]["margin"] = hexadecimal(0.05); }},
       {"no margin", [](Json& c) { cell_of(c, "long-run")["entry"]["margin"] = hexadecimal(0.0); }},
       {"no ratio", [](Json& c) { cell_of(c, "long-run")["entry"]["ratio"] = hexadecimal(0.5); }},
       {"without an entry", [](Json& c) { cell_of(c, "long-run").erase("entry"); }},
       {"an entry elsewhere",
        [](Json& c) { cell_of(c, "assumed")["entry"] = cell_of(c, "long-run")["entry"]; }}});
}

TEST_CASE("a long run that does not follow is refused" * doctest::test_suite("nightly")) {
  check_refused(
      "model-filter-long-run",
      {{"claimed without its set", [](Json& c) { remove_set(c, "long-run"); }},
       {"inside nothing", [](Json& c) { remove_set(c, "assumed"); }},
       {"for less noise", [](Json& c) { set_in(c, "long-run")["noise"] = hexadecimal(0.0); }},
       {"of another cell", [](Json& c) { scale_number(cell_of(c, "long-run")["half_width"], 1.01); }},
       {"as another set", [](Json& c) { set_in(c, "long-run")["name"] = "noise"; }},
       {"begun lower",
        [](Json& c) {
          Json& cell = cell_of(c, "long-run");
          cell["levels"].erase(0);
          cell["shrinking"].erase(0);
        }},
       {"ended lower", [](Json& c) {
          Json& levels = cell_of(c, "long-run")["levels"];
          scale_number(levels[levels.size() - 1], 0.7);
        }}});
}

TEST_CASE("a filter with a slew whose bounds of the covariance do not fit is refused" *
          doctest::test_suite("nightly")) {
  check_refused(
      "model-filter-moving",
      {{"without a margin", [](Json& c) { set_in(c, "assumed").erase("margin"); }},
       {"a margin of nothing", [](Json& c) { set_in(c, "assumed")["margin"] = hexadecimal(0.0); }},
       {"a margin that is not there", [](Json& c) { set_in(c, "assumed")["margin"] = hexadecimal(0.02); }},
       {"a margin that borders exceed", [](Json& c) { set_in(c, "assumed")["margin"] = hexadecimal(1e-12); }},
       {"bounds that are narrower in one cell",
        [](Json& c) { scale_series(cell_of(c, "assumed")["covariance_high"], 0.99); }},
       {"more slew", [](Json& c) { scale_number(set_in(c, "assumed")["slew"], 100.0); }}});
}

#include <doctest/doctest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "certificates/design/design_format.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/document/tuning.hpp"
#include "reports/tracker_reports.hpp"

using namespace veritrack;
using namespace veritrack::certificates;

TEST_CASE(
    "every kind of tracker has a format of its design file, what each certificate needs, and one name") {
  std::set<std::string> names;
  const auto kinds = tracker_kinds();
  const auto formats = design_formats();
  REQUIRE(kinds.size() == formats.size());
  REQUIRE_FALSE(kinds.empty());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    CAPTURE(kinds[i]->name);
    CHECK(names.insert(std::string(kinds[i]->name)).second);
    CHECK(kinds[i]->name == formats[i]->tracker);
    CHECK((kinds[i]->design_json != nullptr));
    CHECK((kinds[i]->certify != nullptr));
    CHECK((kinds[i]->summary != nullptr));
    CHECK((kinds[i]->sections != nullptr));
    std::any tables = formats[i]->empty_tables();
    CHECK_FALSE(formats[i]->bind_tables(tables).empty());
  }
}

TEST_CASE("what a kind of tracker does not have is answered with a sentence that names those that have it") {
  for (const TrackerKind* kind : tracker_kinds()) {
    CAPTURE(kind->name);
    Design design;
    design.tracker = kind->name;
    if (kind->tune == nullptr) {
      const TuningResult result = tune(design);
      CHECK_FALSE(result.design_text);
      CHECK(result.reason.find("kkl-observer") != std::string::npos);
    }
  }
  Design observer;
  observer.tracker = "kkl-observer";
  const reports::MapResult map = reports::write_map(observer, {}, "nowhere", {});
  CHECK_FALSE(map.picture);
  CHECK(map.sentence == "A map needs the tracker quadrature-ekf.");
}

TEST_CASE("a tracker that the registry does not know is an error, not another tracker") {
  Design design;
  design.tracker = "kalman-bucy";
  CHECK_THROWS_AS((void)kind_of(design), std::logic_error);
  CHECK_THROWS_AS((void)tables_of<int>(design), std::logic_error);
  CHECK(reports::tracker_reports().size() <= tracker_kinds().size());
}

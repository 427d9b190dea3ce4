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
    CHECK((kinds[i]->answers != nullptr));
    CHECK((kinds[i]->sections != nullptr));
    std::any tables = formats[i]->empty_tables();
    CHECK_FALSE(formats[i]->bind_tables(tables).empty());
  }
}

TEST_CASE("what a kind of tracker does not have is not asked of it, and those that have it are named") {
  for (const TrackerKind* kind : tracker_kinds()) {
    CAPTURE(kind->name);
    Design design;
    design.tracker = kind->name;
    CHECK(can_be_tuned(design) == (kind->tune != nullptr));
    if (kind->tune == nullptr) {
      CHECK_THROWS_AS((void)tune(design, {}), std::logic_error);
    }
  }
  CHECK(trackers_with_tuning() == "quadrature-ekf or kkl-observer or single-channel-ekf or model");
  Design observer;
  observer.tracker = "kkl-observer";
  CHECK_FALSE(reports::has_map(observer));
  CHECK_THROWS_AS((void)reports::write_map(observer, {}, "nowhere", {}), std::logic_error);
  CHECK(reports::trackers_with_map() == "quadrature-ekf or model or dft-block-ekf");
}

TEST_CASE("a tracker that the registry does not know is an error, not another tracker") {
  Design design;
  design.tracker = "kalman-bucy";
  CHECK_THROWS_AS((void)kind_of(design), std::logic_error);
  CHECK_THROWS_AS((void)tables_of<int>(design), std::logic_error);
  CHECK(reports::tracker_reports().size() <= tracker_kinds().size());
}

#include "papers/reproductions/reproduction.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "papers/reproductions/caption_report.hpp"
#include "papers/reproductions/observer_report.hpp"
#include "papers/reproductions/sonar_report.hpp"
#include "papers/reproductions/swept_tone_reports.hpp"
#include "papers/reproductions/vibration_report.hpp"
#include "papers/reproductions/zarchan_report.hpp"

namespace veritrack::reports {
namespace {

/// Each id once, with a place, in the document; figures that the document shows.
void check_findings(const Findings& findings, std::size_t entries) {
  CHECK(findings.entries.size() == entries);
  std::set<std::string> ids;
  for (const Entry& entry : findings.entries) {
    CAPTURE(entry.id);
    CHECK(ids.insert(entry.id).second);
    CHECK_FALSE(entry.place.empty());
    CHECK_FALSE(entry.what.empty());
    CHECK(findings.markdown.find('`' + entry.id + '`') != std::string::npos);
    CHECK((entry.verdict != EntryVerdict::cannot_be_compared || !entry.because.empty()));
  }
  for (const Figure& figure : with_pictures(findings.figures)) {
    CAPTURE(figure.file);
    CHECK(figure.svg.find("</svg>") != std::string::npos);
    CHECK(findings.markdown.find("(figures/" + figure.file + ")") != std::string::npos);
  }
  CHECK(findings.markdown.find("nan") == std::string::npos);
  CHECK(findings.markdown.find("prove nothing") != std::string::npos);
}

TEST_CASE("few runs: every entry has a row, and the same comes with one thread") {
  constexpr int kRuns = 4;
  const Findings table_1 = reproduce_table_1(kRuns, {});
  check_findings(table_1, 27);
  const Findings table_3_2 = reproduce_table_3_2(kRuns, {});
  check_findings(table_3_2, 8);
  const Findings tables_4 = reproduce_tables_4(kRuns, {});
  check_findings(tables_4, 15);
  const Findings tables_5 = reproduce_tables_5(kRuns, {});
  check_findings(tables_5, 34);
  const Findings zarchan = reproduce_zarchan(kRuns, {});
  check_findings(zarchan, 40);
  const Findings captions = reproduce_figures_1_6(kRuns, {});
  check_findings(captions, 13);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(reproduce_table_3_2(kRuns, {}).markdown == table_3_2.markdown);
  CHECK(reproduce_tables_4(kRuns, {}).markdown == tables_4.markdown);
  CHECK(reproduce_tables_5(kRuns, {}).markdown == tables_5.markdown);
  CHECK(reproduce_zarchan(kRuns, {}).markdown == zarchan.markdown);
  CHECK(reproduce_figures_1_6(kRuns, {}).markdown == captions.markdown);
}

TEST_CASE("four runs decide little, and the document says so at its top") {
  const Findings findings = reproduce_zarchan(4, {});
  const std::string warning = too_few_runs(findings.entries, 4);
  CHECK(warning.find("4 runs are too few for ") == 0);
  CHECK(findings.markdown.find("\n\n*" + warning + "*\n\n") != std::string::npos);
}

TEST_CASE("the adaptive observer's report, with one start of each search" * doctest::test_suite("nightly")) {
  check_findings(reproduce_figures_7_9(1, {}), 9);
}

TEST_CASE("reports are found by name, each name once") {
  std::set<std::string_view> names;
  for (const Reproduction& each : reproductions()) {
    CHECK(names.insert(each.name).second);
    CHECK(&find_reproduction(each.name) == &each);
    CHECK(each.runs > 0);
  }
  CHECK(names.size() == 9);
  CHECK_THROWS_AS((void)find_reproduction("nothing"), std::out_of_range);
}

}  // namespace
}  // namespace veritrack::reports

#include "reports/page/renderings.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace veritrack::reports::page {
namespace {

namespace fs = std::filesystem;

/// The files that staging and committing leaves, by their paths in the folder.
std::set<std::string> written(const Renderings& renderings) {
  const fs::path folder = fs::temp_directory_path() / "veritrack-renderings-test";
  fs::remove_all(folder);
  FigureTable first("run", {"x"});
  FigureTable second("levels", {"y"});
  Document document{"report", "# T\n\n![t](figures/a.svg)\n"};
  document.figure_folder = "figures/";
  document.figures = {{"a.svg", "", "", "t", {first, second}, "", "<svg/>"}};
  certificates::OutputFiles files;
  stage_document(files, folder, document, renderings);
  files.commit();
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.insert(entry.path().lexically_relative(folder).string());
    }
  }
  fs::remove_all(folder);
  return names;
}

TEST_CASE("what is asked for is written, and nothing else") {
  CHECK(written({}) == std::set<std::string>{"report.md", "figures/a.svg"});
  CHECK(written({true, false, false}) == std::set<std::string>{"report.md", "report.html", "figures/a.svg"});
  CHECK(written({false, true, false}) ==
        std::set<std::string>{"report.md", "figures/a.svg", "figures/a.csv", "figures/a-levels.csv"});
  CHECK(written({false, false, true}) ==
        std::set<std::string>{"report.md", "report-tables.tex", "figures/a.svg"});
}

}  // namespace
}  // namespace veritrack::reports::page

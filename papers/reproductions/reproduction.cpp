#include "papers/reproductions/reproduction.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "certificates/document/output_files.hpp"
#include "papers/reproductions/caption_report.hpp"
#include "papers/reproductions/example_report.hpp"
#include "papers/reproductions/limit_report.hpp"
#include "papers/reproductions/observer_report.hpp"
#include "papers/reproductions/sonar_report.hpp"
#include "papers/reproductions/swept_tone_reports.hpp"
#include "papers/reproductions/vibration_report.hpp"
#include "papers/reproductions/zarchan_report.hpp"

namespace veritrack::reports {

namespace {

/// Writes what a function of this kind finds.
template <Findings (*reproduce)(int, const ReproductionProgress&)>
WrittenReport write(int runs, const std::filesystem::path& directory, const page::Renderings& renderings,
                    const ReproductionProgress& progress) {
  return write_findings(reproduce(runs, progress), runs, directory, renderings);
}

template <Findings (*reproduce)(int, const ReproductionProgress&)>
constexpr Reproduction of(std::string_view name, std::string_view about, int runs) {
  return {name, about, runs, &write<reproduce>, reproduce};
}

constexpr std::array kReproductions{
    Reproduction{"bittanti-savaresi-2000", "examples of Bittanti and Savaresi (2000)", 200,
                 &write_example_report, &example_entries},
    Reproduction{"tracking-limits", "trackers compared with the Cramer-Rao bounds", 1000,
                 &write_limit_report},
    of<reproduce_table_1>("la-scala-bitmead-table-1", "Table I of La Scala and Bitmead (1996)", 1000),
    of<reproduce_table_3_2>("la-scala-table-3.2", "Table 3.2 and Figures 3.1 to 3.5 of La Scala's thesis",
                            1000),
    of<reproduce_tables_4>("la-scala-tables-4", "tables and figures of chapter 4 of La Scala's thesis", 200),
    of<reproduce_tables_5>("la-scala-tables-5", "tables and figures of chapter 5 of La Scala's thesis", 200),
    of<reproduce_figures_1_6>("praly-figures-1-6", "captions of Figures 1 to 6 of Praly, Marconi and Isidori",
                              200),
    of<reproduce_figures_7_9>("praly-figures-7-9",
                              "adaptive observer of Figures 7 to 9 of Praly, Marconi and Isidori", 8),
    of<reproduce_zarchan>("zarchan", "experiments of Zarchan's slides", 1000),
};

}  // namespace

WrittenReport write_findings(Findings findings, int runs, const std::filesystem::path& directory,
                             const page::Renderings& renderings) {
  page::Document document{"report", std::move(findings.markdown)};
  document.figure_folder = "figures/";
  document.figures = with_pictures(std::move(findings.figures));
  certificates::OutputFiles files;
  stage_document(files, directory, document, renderings);
  files.commit();
  return {directory / "report.md", too_few_runs(findings.entries, runs)};
}

std::span<const Reproduction> reproductions() {
  return kReproductions;
}

const Reproduction& find_reproduction(std::string_view name) {
  const auto* const found = std::find_if(kReproductions.begin(), kReproductions.end(),
                                         [&](const Reproduction& each) { return each.name == name; });
  if (found == kReproductions.end()) {
    throw std::out_of_range("there is no report " + std::string(name));
  }
  return *found;
}

}  // namespace veritrack::reports

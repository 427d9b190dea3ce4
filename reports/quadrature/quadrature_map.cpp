#include "reports/quadrature/quadrature_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/document/markdown.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "reports/page/renderings.hpp"
#include "reports/quadrature/region_map.hpp"

namespace veritrack::reports {

namespace {

std::string cells_csv(const quadrature::Region& region) {
  std::string text =
      "amplitude_error_low,amplitude_error_high,phase_error_low,phase_error_high,frequency_error_low,"
      "frequency_error_high,verdict,whole_cell,samples,outcome\n";
  const std::size_t looked_at = region.cells.size() - region.unfinished;
  for (std::size_t number = 0; number < region.cells.size(); ++number) {
    const quadrature::RegionCell& cell = region.cells[number];
    const quadrature::StartBox& starts = cell.starts;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{}\n", starts.amplitude_error.lower(), starts.amplitude_error.upper(),
        starts.phase_error.lower(), starts.phase_error.upper(), starts.frequency_error.lower(),
        starts.frequency_error.upper(), rigor::to_string(cell.verdict), cell.whole, cell.result.samples,
        number < looked_at ? quadrature::to_string(cell.result.outcome) : "not looked at");
  }
  return text;
}

/// How many cells have that verdict.
std::size_t count(const quadrature::Region& region, rigor::Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(region.cells.begin(), region.cells.end(),
                    [&](const quadrature::RegionCell& cell) { return cell.verdict == verdict; }));
}

std::string sentence_of(const certificates::RegionOfAttraction& found) {
  const std::size_t unfinished = found.region.unfinished;
  return fmt::format(
      "{} of the simulated basin is proved to be captured, {} cells{}", percent(found.shares.proved),
      found.region.cells.size(),
      unfinished > 0 ? fmt::format("; stopped before the end, {} of them not looked at", unfinished) : "");
}

}  // namespace

std::string quadrature_map_document(const certificates::Design& design,
                                    const certificates::RegionRequest& request,
                                    const certificates::RegionOfAttraction& found, const Figure& figure) {
  namespace markdown = certificates::markdown;
  using rigor::Verdict;
  const quadrature::Region& region = found.region;
  const std::size_t proved = count(region, Verdict::proved);
  std::string text = fmt::format("# {}\n\nWhich starts of {} are captured.\n\n", sentence_of(found),
                                 markdown::escaped(design.name));
  text += proved > 0 ? fmt::format("{}: {}\n\n", markdown::verdict(Verdict::proved),
                                   certificates::region_statement(design, request))
                     : "No cell is proved: nothing is said about these starts.\n\n";
  text += certificates::picture({figure.file, figure.title, figure.caption});
  text +=
      "## The cells\n\n" +
      markdown::table({"Shown", "Meaning", "Cells"},
                      {{"blue", "proved: every start in the cell is captured", std::to_string(proved)},
                       {"hatched",
                        "proved: the starts in the cell, or at least the one in its middle, lock at a wrong "
                        "frequency, a multiple of 2π rad/sample away",
                        std::to_string(count(region, Verdict::refuted))},
                       {"light", "undecided", std::to_string(count(region, Verdict::undecided))}});
  return text + fmt::format(
                    "\nThe map goes to ±{:.4g} rad/sample and ±{:.4g} rad. The outline, the basin, is "
                    "simulated without "
                    "noise, and proves nothing.\n\n## What is proved, and what is not\n\n"
                    "- Every frequency up to pi rad/sample, {}.\n"
                    "- Amplitude and initial covariance are as the sentence says.\n"
                    "- A start that is undecided may be captured or not.\n"
                    "- The proof: Taylor models in the start, followed sample by sample in outward-rounded "
                    "arithmetic, "
                    "into the set of `veritrack certify`. `veritrack-verify` does not check maps.\n\n"
                    "`region.csv` has a line for each cell.\n",
                    request.frequency_error, request.phase_error,
                    request.with_noise
                        ? "any noise and any change of frequency within the assumed bounds"
                        : "constant and without noise; with --noise the assumed noise and slew are "
                          "part of the proof");
}

MapResult write_quadrature_map(const certificates::Design& design, const MapRequest& request,
                               const std::filesystem::path& directory,
                               const certificates::CertifyProgress& progress) {
  const certificates::RegionRequest region{request.frequency_error.value_or(1.0),
                                           request.phase_error.value_or(1.5), request.with_noise,
                                           request.deadline};
  const certificates::RegionResult result =
      certificates::prove_region_of_attraction(design, region, progress);
  if (!result.found) {
    return {std::nullopt, result.reason};
  }
  const Figure figure = with_picture(draw_region_map(result.found->region, result.found->basin));
  page::Document document{"map", quadrature_map_document(design, region, *result.found, figure)};
  document.figures = {figure};
  certificates::OutputFiles files;
  stage_document(files, directory, document, {request.html, false, false});
  files.stage(directory / "region.csv", cells_csv(result.found->region));
  files.commit();
  return {directory / "map.md", sentence_of(*result.found)};
}

}  // namespace veritrack::reports

#include "reports/quadrature/quadrature_map.hpp"

#include <fmt/format.h>

#include "certificates/document/output_files.hpp"
#include "certificates/quadrature/region.hpp"
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

std::filesystem::path write_files(const certificates::RegionOfAttraction& region,
                                  const std::filesystem::path& directory) {
  std::filesystem::path picture = directory / "region.svg";
  certificates::OutputFiles files;
  files.stage(picture, with_title(draw_region_map(region.region, region.basin)).svg);
  files.stage(directory / "region.csv", cells_csv(region.region));
  files.commit();
  return picture;
}

}  // namespace

MapResult write_quadrature_map(const certificates::Design& design, const MapRequest& request,
                               const std::filesystem::path& directory,
                               const certificates::CertifyProgress& progress) {
  const certificates::RegionResult result = certificates::prove_region_of_attraction(
      design,
      {request.frequency_error.value_or(1.0), request.phase_error.value_or(1.5), request.with_noise,
       request.deadline},
      progress);
  if (!result.found) {
    return {std::nullopt, result.reason};
  }
  const std::size_t unfinished = result.found->region.unfinished;
  const std::string stopped =
      unfinished > 0 ? fmt::format("; stopped before the end, {} of them not looked at", unfinished) : "";
  return {write_files(*result.found, directory),
          fmt::format("{:.1f} % of the simulated basin is proved to be captured, {} cells{}",
                      100.0 * result.found->shares.proved, result.found->region.cells.size(), stopped)};
}

}  // namespace veritrack::reports

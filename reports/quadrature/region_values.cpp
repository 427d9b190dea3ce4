#include "reports/quadrature/region_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/rigor/verdict.hpp"

namespace veritrack::reports {

using quadrature::Region;
using quadrature::RegionCell;
using quadrature::SimulatedBasin;
using rigor::Verdict;

std::string region_values(const Region& region, const SimulatedBasin& basin) {
  enum Kind : std::size_t { captured, locked_elsewhere, middle_elsewhere, undecided };
  const bool has_amplitudes =
      std::any_of(region.cells.begin(), region.cells.end(), [](const RegionCell& cell) {
        return cell.starts.amplitude_error.lower() < cell.starts.amplitude_error.upper();
      });
  page::MapValues map;
  map.x = {basin.frequency_error.lower(), basin.frequency_error.upper()};
  map.y = {basin.phase_error.lower(), basin.phase_error.upper()};
  map.sentence = fmt::format(
      "Starts with a frequency error from {{x0}} to {{x1}} rad/sample, a phase error from {{y0}} to {{y1}} "
      "rad "
      "and {}: {{kind}}.",
      has_amplitudes ? "a relative amplitude error from {z0} to {z1}" : "the exact amplitude");
  map.kinds = {"proved to be captured within {samples} samples",
               "all of them are proved to lock at a wrong frequency",
               "the start in the middle is proved to lock at a wrong frequency", "undecided"};
  for (const RegionCell& cell : region.cells) {
    const quadrature::StartBox& starts = cell.starts;
    const Kind elsewhere = cell.whole ? locked_elsewhere : middle_elsewhere;
    map.cells.push_back({starts.frequency_error.lower(), starts.frequency_error.upper(),
                         starts.phase_error.lower(), starts.phase_error.upper(),
                         starts.amplitude_error.lower(), starts.amplitude_error.upper(),
                         cell.verdict == Verdict::proved    ? captured
                         : cell.verdict == Verdict::refuted ? elsewhere
                                                            : undecided,
                         static_cast<std::size_t>(cell.result.samples)});
  }
  return page::map_values_json(map, kRegionPlace, kRegionWidth, kRegionHeight);
}

FigureTable table_of_region(const Region& region) {
  FigureTable table("cells",
                    {"frequency error, low [rad/sample]", "frequency error, high [rad/sample]",
                     "phase error, low [rad]", "phase error, high [rad]", "amplitude error, low [relative]",
                     "amplitude error, high [relative]", "verdict", "samples"});
  for (const RegionCell& cell : region.cells) {
    const quadrature::StartBox& starts = cell.starts;
    table.add({starts.frequency_error.lower(), starts.frequency_error.upper(), starts.phase_error.lower(),
               starts.phase_error.upper(), starts.amplitude_error.lower(), starts.amplitude_error.upper(),
               std::string(rigor::to_string(cell.verdict)), static_cast<double>(cell.result.samples)});
  }
  return table;
}

}  // namespace veritrack::reports

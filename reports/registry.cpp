// The reports of the trackers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "certificates/design/request_error.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

#define VERITRACK_TRACKER(column) [[nodiscard]] const TrackerReports& column##_reports();
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER

namespace {

/// Null when reports/ has nothing for the tracker.
const TrackerReports* reports_of(std::string_view tracker) {
  const auto all = tracker_reports();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const TrackerReports* each) { return each->tracker == tracker; });
  return found != all.end() ? *found : nullptr;
}

/// The options that are given, as the command line calls them.
std::vector<std::string_view> given_options(const MapRequest& request) {
  std::vector<std::string_view> given;
  const auto add = [&](bool is_given, std::string_view option) {
    if (is_given) {
      given.push_back(option);
    }
  };
  add(request.frequency_error.has_value(), "--frequency");
  add(request.phase_error.has_value(), "--phase");
  add(request.at.has_value(), "--at");
  add(request.x.has_value(), "--x");
  add(request.y.has_value(), "--y");
  add(request.x_range.has_value(), "--x-range");
  add(request.y_range.has_value(), "--y-range");
  add(request.cells.has_value(), "--cells");
  add(request.over.has_value(), "--over");
  return given;
}

}  // namespace

std::span<const TrackerReports* const> tracker_reports() {
  static const std::array all{
#define VERITRACK_TRACKER(column) &column##_reports(),
#include "certificates/trackers.def"
#undef VERITRACK_TRACKER
  };
  return all;
}

std::vector<Figure> draw_figures(const certificates::Certificate& certificate) {
  const TrackerReports* reports = reports_of(certificate.design.tracker);
  return reports != nullptr && reports->figures != nullptr ? with_pictures(reports->figures(certificate))
                                                           : std::vector<Figure>{};
}

std::string trackers_with_map() {
  std::vector<std::string_view> able;
  for (const TrackerReports* each : tracker_reports()) {
    if (each->map != nullptr) {
      able.push_back(each->tracker);
    }
  }
  return fmt::format("{}", fmt::join(able, " or "));
}

bool has_map(const certificates::Design& design) {
  const TrackerReports* reports = reports_of(design.tracker);
  return reports != nullptr && reports->map != nullptr;
}

MapResult write_map(const certificates::Design& design, const MapRequest& request,
                    const std::filesystem::path& directory, const certificates::CertifyProgress& progress) {
  if (!has_map(design)) {
    throw std::logic_error("a design of the tracker " + design.tracker + " has no map");
  }
  const TrackerReports& reports = *reports_of(design.tracker);
  for (const std::string_view option : given_options(request)) {
    const auto& able = reports.map_options;
    if (std::find(able.begin(), able.end(), option) == able.end()) {
      throw certificates::RequestError(
          fmt::format("{} cannot be used with the tracker {}; allowed: {}, --noise", option, design.tracker,
                      fmt::join(able, ", ")),
          "tracker");
    }
  }
  return reports.map(design, request, directory, progress);
}

}  // namespace veritrack::reports

// The figures and maps of reports/ for a kind of tracker: one record for each, made in its column.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/search/deadline.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/tuning.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// The contents of a map, around the exact start; the kind chooses values that are not given.
struct MapRequest {
  std::optional<double> frequency_error;            ///< up to, rad/sample
  std::optional<double> phase_error;                ///< up to, rad
  std::optional<std::string> at;                    ///< frequency of the signal, rad/sample: a decimal
  std::optional<std::string> x, y;                  ///< states that deviate at the start
  std::optional<double> x_range, y_range;           ///< by how much at most
  std::optional<int> cells;                         ///< in each direction
  std::optional<certificates::FreeParameter> over;  ///< the modes over this parameter, in place of a map
  bool with_noise = false;         ///< with the noise (and slew) of [assume]; otherwise without
  search::Deadline deadline = {};  ///< cells not proved by then stay open
  bool html = false;               ///< map.html, too
};

/// The files of a map, or why there are none.
struct MapResult {
  std::optional<std::filesystem::path> file;  ///< the one to look at first
  std::string sentence;                       ///< what was found, or why nothing could be
};

struct TrackerReports {
  std::string_view tracker;  ///< as the key `tracker` of a design file names it
  /// Figures for the certificate; null when there are none. Not drawn yet.
  std::vector<Figure> (*figures)(const certificates::Certificate& certificate) = nullptr;
  /// The proved region of attraction, written into a folder; null when there is no such map. Throws
  /// certificates::OutputError, FigureError.
  MapResult (*map)(const certificates::Design& design, const MapRequest& request,
                   const std::filesystem::path& directory,
                   const certificates::CertifyProgress& progress) = nullptr;
  /// Which options of the command the map understands, beside --noise.
  std::vector<std::string_view> map_options = {};
};

/// All records (reports/registry.cpp).
[[nodiscard]] std::span<const TrackerReports* const> tracker_reports();

/// The names of the trackers that have a map, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string trackers_with_map();

[[nodiscard]] bool has_map(const certificates::Design& design);

/// The map of a design that has one, written into `directory`. Throws std::logic_error for another design,
/// certificates::RequestError for an option that this kind of map does not have or a value that does not fit,
/// certificates::OutputError, FigureError.
[[nodiscard]] MapResult write_map(const certificates::Design& design, const MapRequest& request,
                                  const std::filesystem::path& directory,
                                  const certificates::CertifyProgress& progress);

}  // namespace veritrack::reports

// A run over a recording as a folder: the document, the table, the picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/recording/track_document.hpp"

namespace veritrack::reports {

struct TrackFiles {
  std::filesystem::path document;  ///< track.md
  std::string missing_figure;      ///< one line: why there is no picture; empty when there is one
};

/// Writes track.md, track.csv and track.svg into `directory` (made when missing); each appears whole or not
/// at all. No output may be one of `inputs`. Throws certificates::OutputError.
[[nodiscard]] TrackFiles write_track_files(const TrackReport& report, const std::filesystem::path& directory,
                                           const std::vector<std::filesystem::path>& inputs);

}  // namespace veritrack::reports

// The results of a run over a recording, for people: Markdown, answer first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/design/design.hpp"
#include "reports/recording/recording_units.hpp"
#include "reports/recording/track_run.hpp"

namespace veritrack::reports {

/// A run and its inputs.
struct TrackReport {
  const certificates::Design* design = nullptr;
  std::string recording;  ///< the name of the file, without folders, or "standard input"
  certificates::SignalAssumptions assume;
  std::optional<double> sample_rate;  ///< Hz
  std::vector<std::string> notes;     ///< sentences about how the recording was read
  TrackResult result;
};

/// One line: lock, NIS, and whether the recording keeps to the assumptions; of a tracker in blocks the lock.
[[nodiscard]] std::string headline(const TrackReport& report);

/// `figure` is the name of the picture in the document's folder, `blocks_figure` that of the blocks; empty
/// when there is none. Throws nothing of
/// its own.
[[nodiscard]] std::string to_markdown(const TrackReport& report, const std::string& figure,
                                      const std::string& blocks_figure = {});

}  // namespace veritrack::reports

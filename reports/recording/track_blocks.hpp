// The lock of a tracker in blocks, by its own monitor: words, a table, a figure.
#pragma once

#include <string>

#include "reports/recording/track_document.hpp"

namespace veritrack::reports {

/// "Kept lock.", "The lock is false from block 21 on: ..." and so on, from the blocks; there must be some.
[[nodiscard]] std::string block_lock_sentence(const TrackResult& result, const RecordingUnits& units);

/// Whether all blocks but the first ones are in lock, and there are such.
[[nodiscard]] bool blocks_are_in_lock(const TrackResult& result);

/// The section of the document.
[[nodiscard]] std::string blocks_section(const TrackReport& report, const std::string& figure);

/// CSV, a row for each block.
[[nodiscard]] std::string blocks_table(const TrackResult& result);

/// SVG: the share of power that the estimate leaves unexplained, block by block. Throws FigureError.
[[nodiscard]] std::string draw_blocks(const TrackResult& result);

}  // namespace veritrack::reports

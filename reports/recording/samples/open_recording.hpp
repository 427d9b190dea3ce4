// A recording by its name: what kind of file it is, and which of its channels are wanted.
#pragma once

#include <memory>
#include <string>

#include "reports/recording/samples/csv_columns.hpp"
#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/samples/sound_source.hpp"

namespace veritrack::reports {

enum class RecordingFormat {
  by_content,  ///< of a file; standard input is CSV
  csv,
  sound
};

struct RecordingRequest {
  std::string path;  ///< "-": standard input
  RecordingFormat format = RecordingFormat::by_content;
  CsvColumns columns;
  SoundChannels sound;
};

/// Throws certificates::InputError.
[[nodiscard]] std::unique_ptr<SampleSource> open_recording(const RecordingRequest& request);

}  // namespace veritrack::reports

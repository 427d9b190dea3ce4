// The sentences that answer the questions to a run over a recording.
#pragma once

#include <string>
#include <vector>

#include "reports/recording/recording_units.hpp"
#include "reports/recording/track_document.hpp"

namespace veritrack::reports {

/// "Lost lock at sample 12; ..." and the like, with the frequency.
[[nodiscard]] std::string lock_sentence(const TrackResult& result, const RecordingUnits& units);
/// Whether the mean NIS is within its band, with all numbers.
[[nodiscard]] std::string nis_sentence(const TrackResult& result);
/// The same in a few words with a blank behind it; empty when there is nothing to say.
[[nodiscard]] std::string short_nis_sentence(const TrackResult& result);
/// How far the estimate is from the frequency of the fitted tone, with a blank behind it; empty where that is
/// chance or less than a thousandth.
[[nodiscard]] std::string bias_sentence(const TrackResult& result, const RecordingUnits& units);
/// The names of the findings in the recording, followed by a blank; empty when there are none.
[[nodiscard]] std::string findings_sentence(const TrackResult& result);
/// "1", or "0.5 to 2".
[[nodiscard]] std::string amplitude_words(const certificates::SignalAssumptions& assume);
/// Other things that must be said at once.
[[nodiscard]] std::vector<std::string> report_sentences(const TrackReport& report,
                                                        const RecordingUnits& units);

}  // namespace veritrack::reports

// The properties of a recording that do not depend on the tracker: tone, defects, remedies.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reports/recording/findings/block_fit.hpp"
#include "reports/recording/findings/finding.hpp"
#include "reports/recording/tone_search.hpp"
#include "reports/recording/track_series.hpp"

namespace veritrack::reports {

class RecordingExaminer {
 public:
  /// `channels` that were recorded and that the tracker takes; `sample_rate` in Hz.
  RecordingExaminer(const certificates::SignalAssumptions& assume, int channels,
                    std::optional<double> sample_rate);

  /// Every sample in its order, missing ones included, in the units of the recording.
  void push(std::int64_t index, const RecordedSample& sample);
  /// After the last sample.
  void finish();
  /// `scale` from the units of the recording to those of the design.
  [[nodiscard]] std::vector<Finding> findings(double scale) const;
  /// The frequency of the tone from stretch to stretch, rad/sample.
  [[nodiscard]] const Spread& frequency() const { return frequency_; }

 private:
  void look(bool at_end);
  void take(const FoundTone& found);
  void close_block();

  certificates::SignalAssumptions assume_;
  int channels_;
  std::optional<double> sample_rate_;
  Waveform waveform_;
  ToneSearch search_;
  BlockFit fit_;
  std::vector<std::unique_ptr<Detector>> detectors_;
  std::size_t longest_;
  std::size_t wanted_;
  FoundTone last_found_;
  std::int64_t next_ = 0;  ///< sample, the first one of `ahead_`
  std::vector<RecordedSample> ahead_;
  bool follows_ = false;
  std::vector<ToneStretch> stretches_;  ///< of the block
  std::vector<RecordedSample> block_;
  Spread frequency_;
  SampleRanges gaps_{1};
};

}  // namespace veritrack::reports

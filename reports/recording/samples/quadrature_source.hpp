// A recording with one channel as in-phase and quadrature samples.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"
#include "trackers/signals/hilbert_filter.hpp"

namespace veritrack::reports {

/// The quadrature part comes from a Hilbert filter. Samples keep their numbers. The first and the last
/// `delay` samples of the recording, and those that close to a gap, have no quadrature part and are missing.
class QuadratureSource : public SampleSource {
 public:
  /// `recording` has one channel.
  QuadratureSource(std::unique_ptr<SampleSource> recording, int half_length)
      : recording_(std::move(recording)), filter_(half_length) {}

  [[nodiscard]] int channels() const override { return 2; }
  [[nodiscard]] bool quadrature_is_derived() const override { return true; }
  [[nodiscard]] std::optional<double> sample_rate() const override { return recording_->sample_rate(); }
  std::size_t read(std::span<RecordedSample> block) override;
  [[nodiscard]] std::optional<double> progress() const override { return recording_->progress(); }
  [[nodiscard]] std::vector<std::string> notes() const override { return recording_->notes(); }
  [[nodiscard]] const trackers::HilbertFilter& filter() const { return filter_; }

 private:
  void refill();

  std::unique_ptr<SampleSource> recording_;
  trackers::HilbertFilter filter_;
  std::vector<RecordedSample> raw_;
  std::deque<RecordedSample> ready_;
  std::int64_t pushed_ = 0;  ///< samples of the recording; all but `delay` of them are ready or gone
  bool at_end_ = false;
};

}  // namespace veritrack::reports

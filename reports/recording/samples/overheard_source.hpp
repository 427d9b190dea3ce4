// A recording with a listener that gets each sample as it is read.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

class OverheardSource : public SampleSource {
 public:
  using Listener = std::function<void(std::int64_t, const RecordedSample&)>;

  explicit OverheardSource(std::unique_ptr<SampleSource> recording) : recording_(std::move(recording)) {}

  /// Who hears every sample that is read from now on, with its number.
  void listen(Listener listener) { listener_ = std::move(listener); }

  [[nodiscard]] int channels() const override { return recording_->channels(); }
  [[nodiscard]] bool quadrature_is_derived() const override { return recording_->quadrature_is_derived(); }
  [[nodiscard]] std::optional<double> sample_rate() const override { return recording_->sample_rate(); }
  std::size_t read(std::span<RecordedSample> block) override {
    const std::size_t count = recording_->read(block);
    for (const RecordedSample& sample : block.first(count)) {
      if (listener_) {
        listener_(next_, sample);
      }
      ++next_;
    }
    return count;
  }
  [[nodiscard]] std::optional<double> progress() const override { return recording_->progress(); }
  [[nodiscard]] std::vector<std::string> notes() const override { return recording_->notes(); }

 private:
  std::unique_ptr<SampleSource> recording_;
  Listener listener_;
  std::int64_t next_ = 0;
};

}  // namespace veritrack::reports

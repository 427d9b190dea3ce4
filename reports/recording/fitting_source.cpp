#include "reports/recording/fitting_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "reports/recording/samples/quadrature_source.hpp"

namespace veritrack::reports {

namespace {

/// The in-phase channel alone.
class InPhaseSource : public SampleSource {
 public:
  explicit InPhaseSource(std::unique_ptr<SampleSource> recording) : recording_(std::move(recording)) {}

  [[nodiscard]] int channels() const override { return 1; }
  [[nodiscard]] std::optional<double> sample_rate() const override { return recording_->sample_rate(); }
  std::size_t read(std::span<RecordedSample> block) override {
    const std::size_t count = recording_->read(block);
    for (RecordedSample& sample : block.first(count)) {
      sample.quadrature = 0.0;
    }
    return count;
  }
  [[nodiscard]] std::optional<double> progress() const override { return recording_->progress(); }
  [[nodiscard]] std::vector<std::string> notes() const override { return recording_->notes(); }

 private:
  std::unique_ptr<SampleSource> recording_;
};

}  // namespace

FittingSource fit_channels(std::unique_ptr<SampleSource> recording, int channels,
                           const certificates::SignalAssumptions& assume) {
  if (recording->channels() == channels) {
    return {std::move(recording), {}};
  }
  if (channels == 1) {
    return {std::make_unique<InPhaseSource>(std::move(recording)),
            "The tracker takes one channel: the quadrature channel was not used."};
  }
  // No filter of finite length turns a constant, or the highest frequency.
  constexpr double kEdge = 0.02;  // rad/sample
  constexpr double kTolerance = 1e-3;
  const double low = std::max(assume.frequency[0], kEdge);
  const double high = std::min(assume.frequency[1], std::numbers::pi - kEdge);
  const int half_length = trackers::hilbert_half_length(low, std::max(low, high), kTolerance);
  auto source = std::make_unique<QuadratureSource>(std::move(recording), half_length);
  std::string note = fmt::format(
      "The recording has one channel: its quadrature part is that of a Hilbert filter of {} coefficients, "
      "whose gain is within {:.2g} of 1 from {:.3g} to {:.3g} rad/sample. The first and the last {} samples, "
      "and those that close to a gap, have no quadrature part and are not tracked. The filter's noise is not "
      "white: the NIS is only a rough guide.",
      2 * half_length + 1, std::max(1e-6, source->filter().gain_error(low, std::max(low, high))), low, high,
      half_length);
  return {std::move(source), std::move(note)};
}

}  // namespace veritrack::reports

// Recordings made up for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::test {

/// Samples from memory, in blocks.
class MemorySource : public reports::SampleSource {
 public:
  MemorySource(std::vector<reports::RecordedSample> samples, int channels)
      : samples_(std::move(samples)), channels_(channels) {}
  [[nodiscard]] int channels() const override { return channels_; }
  [[nodiscard]] std::optional<double> sample_rate() const override { return std::nullopt; }
  std::size_t read(std::span<reports::RecordedSample> block) override {
    std::size_t count = 0;
    while (count < block.size() && next_ < samples_.size()) {
      block[count++] = samples_[next_++];
    }
    return count;
  }

 private:
  std::vector<reports::RecordedSample> samples_;
  int channels_;
  std::size_t next_ = 0;
};

/// A tone alone, which designs assume unless they say otherwise.
inline reports::Waveform tone_waveform(int channels) {
  return {std::vector<certificates::Harmonic>(1), channels};
}

/// A tone of amplitude 1 with this frequency at each sample, and Gaussian noise in each channel.
inline std::vector<reports::RecordedSample> recorded_tone(std::size_t samples, int channels, double deviation,
                                                          const std::function<double(std::size_t)>& frequency,
                                                          std::uint64_t seed = 1) {
  trackers::RandomStream random(seed);
  std::vector<reports::RecordedSample> recording;
  double phase = 0.3;
  for (std::size_t k = 0; k < samples; ++k) {
    recording.push_back({std::cos(phase) + deviation * random.normal(),
                         channels > 1 ? std::sin(phase) + deviation * random.normal() : 0.0, true});
    phase = std::remainder(phase + frequency(k), 2.0 * std::numbers::pi);
  }
  return recording;
}

}  // namespace veritrack::test

// A recording as a sound file: WAV, FLAC, Ogg Vorbis and what else libsndfile reads.
#pragma once

#include <sndfile.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

struct SoundChannels {
  std::optional<int> channel;  ///< from 1; none: the only one
  bool quadrature = false;     ///< channels 1 and 2 are in phase and quadrature
};

/// Integers are scaled to [-1, 1]; floating-point samples are taken as they are, and those that are not
/// finite are missing.
class SoundSource : public SampleSource {
 public:
  /// "-" is standard input. Throws certificates::InputError.
  SoundSource(const std::string& path, const SoundChannels& channels);

  [[nodiscard]] int channels() const override { return second_ ? 2 : 1; }
  [[nodiscard]] std::optional<double> sample_rate() const override { return sample_rate_; }
  std::size_t read(std::span<RecordedSample> block) override;
  [[nodiscard]] std::optional<double> progress() const override;

 private:
  struct Closing {
    void operator()(SNDFILE* file) const { (void)sf_close(file); }
  };

  std::string name_;
  std::unique_ptr<SNDFILE, Closing> file_;
  std::int64_t frames_ = 0;  ///< in the file; 0 when unknown
  std::int64_t taken_ = 0;
  double sample_rate_ = 0.0;
  std::size_t width_ = 0;  ///< channels of the file
  std::size_t first_ = 0;
  std::optional<std::size_t> second_;
  std::vector<double> buffer_;
};

}  // namespace veritrack::reports

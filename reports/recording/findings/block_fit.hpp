// Everything that a block of a recording consists of, by least squares: tone, constant, harmonics, hum,
// noise.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "reports/recording/findings/finding.hpp"

namespace veritrack::reports {

class BlockFit {
 public:
  /// `sample_rate` in Hz; without it no hum is looked for. The waveform has the channels of the recording.
  BlockFit(const Waveform& waveform, int channels, const certificates::SignalAssumptions& assume,
           std::optional<double> sample_rate);

  /// How many samples a block has at least: enough to distinguish 50 from 60 Hz, where possible.
  [[nodiscard]] std::size_t length() const { return length_; }

  /// Samples from that of the first stretch on; the stretches follow each other and have a tone. Nothing
  /// where the block is too short for its parts. The result refers to the samples and to this object until
  /// the next call.
  [[nodiscard]] std::optional<ExaminedBlock> fit(std::span<const ToneStretch> stretches,
                                                 std::span<const RecordedSample> samples);

 private:
  struct Part {
    enum class Kind { offset, harmonic, hum } kind;
    int order = 0;
    double hertz = 0.0;
    Eigen::Index column = 0;
  };

  void turn(std::span<const ToneStretch> stretches, std::size_t count);
  [[nodiscard]] std::vector<Part> parts_beside(double frequency, std::size_t count) const;
  void fill(const std::vector<Part>& parts, std::span<const RecordedSample> samples, double amplitude);
  [[nodiscard]] Eigen::Index width_of(const Part& part) const;

  static constexpr int kPolynomials = 4;
  Waveform waveform_;
  int channels_;
  std::array<double, 2> band_;
  std::optional<double> sample_rate_;
  std::size_t length_;
  std::vector<double> phases_;
  std::vector<std::complex<double>> tone_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd right_;
};

}  // namespace veritrack::reports

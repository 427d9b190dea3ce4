// Whether a recording keeps to what the certificate of a design assumes: estimates, stretch by stretch.
#pragma once

#include <cstdint>
#include <vector>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/sample_ranges.hpp"
#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/tone_fit.hpp"

namespace veritrack::reports {

/// The least and the largest of some numbers.
struct Extent {
  double least = 0.0;
  double largest = 0.0;
  bool is_empty = true;

  void add(double value) {
    least = is_empty || value < least ? value : least;
    largest = is_empty || value > largest ? value : largest;
    is_empty = false;
  }
};

/// The findings in the stretches that could be judged: those in lock and without gaps. All are estimates.
struct AssumptionFindings {
  std::int64_t judged = 0;        ///< samples
  Extent amplitude;               ///< signal units
  Extent frequency;               ///< rad/sample
  double noise_deviation = 0.0;   ///< of each channel, signal units
  double largest_residual = 0.0;  ///< distance of a sample from the fitted tone, signal units
  /// Distance of the samples from the tone of the assumed amplitude and the fitted phase: the noise in the
  /// certificate's sense.
  double distance_deviation = 0.0;  ///< root mean square for each channel, signal units
  double largest_distance = 0.0;    ///< signal units
  double largest_slew = 0.0;        ///< rad/sample per sample, from one stretch to the next
  double slew_deviation = 0.0;      ///< how uncertain that one is, for white noise
  double slew_root_mean_square = 0.0;
  /// The mean of the tracker's estimate less the fitted frequency, from stretch to stretch, rad/sample.
  double bias = 0.0;
  double bias_deviation = 0.0;      ///< of that mean
  SampleRanges noise_exceeded;      ///< beyond the bound, or more than the assumed deviation allows
  SampleRanges slew_exceeded;       ///< by more than five deviations of the estimate
  SampleRanges frequency_exceeded;  ///< outside of the band, likewise
  SampleRanges amplitude_exceeded;  ///< outside of the range, likewise

  /// Whether noise (in which an amplitude counts that is not assumed), slew and frequency are within bounds.
  [[nodiscard]] bool keeps() const {
    return noise_exceeded.count() + slew_exceeded.count() + frequency_exceeded.count() == 0;
  }
};

class AssumptionCheck {
 public:
  /// `length` of a stretch, samples; at least 16. `is_derived`: the quadrature channel is computed from the
  /// in-phase one.
  AssumptionCheck(const certificates::SignalAssumptions& assume, std::size_t length, int channels,
                  bool is_derived);

  /// The sample `index` in lock, in the units of the design, and the frequency that the tracker estimates
  /// with it, rad/sample.
  void push(std::int64_t index, const RecordedSample& sample, double frequency);
  /// Later samples are not connected with earlier ones.
  void interrupt();
  [[nodiscard]] AssumptionFindings findings() const;

 private:
  struct Stretch {
    FittedTone tone;
    std::int64_t first = -1;  ///< sample
  };

  void judge();
  void judge_noise(std::int64_t first);
  void judge_slew(const Stretch& current);

  certificates::SignalAssumptions assume_;
  std::size_t length_;
  int channels_;
  Waveform waveform_;
  ToneFit fit_;
  std::vector<RecordedSample> samples_;
  double frequency_sum_ = 0.0;
  std::int64_t first_ = 0;
  Stretch previous_;
  AssumptionFindings findings_;
  double noise_squares_ = 0.0;
  double distance_squares_ = 0.0;
  double slew_squares_ = 0.0;
  double differences_ = 0.0;
  double difference_squares_ = 0.0;
  std::int64_t stretches_ = 0;
  std::int64_t slews_ = 0;
};

}  // namespace veritrack::reports

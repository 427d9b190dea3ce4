// A design's tracker run on samples, one after the other, in double precision, for `veritrack track`, and the
// assumptions with which it compares a recording. Nothing here is proved.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace veritrack::certificates {

/// A tone at one sample.
struct ToneAtSample {
  double amplitude = 1.0;  ///< signal units
  double phase = 0.0;      ///< rad; the in-phase part is amplitude cos(phase)
  double frequency = 0.0;  ///< rad/sample
};

/// The output of a tracker after a sample. NaN for values that it does not give.
struct TrackerOutput {
  double frequency;                  ///< the estimate with this sample, rad/sample
  double frequency_deviation;        ///< of the estimate, by the tracker's own covariance, rad/sample
  std::array<double, 2> innovation;  ///< sample minus prediction for each channel, signal units
  /// The normalised innovation squared, v' S^-1 v with the innovation v and its covariance S as the tracker
  /// believes: chi-squared with as many degrees of freedom as channels when the belief is right.
  double nis;
};

/// A block of samples that a block tracker has processed.
struct TrackedBlock {
  enum class State { settling, lock, false_lock, no_tone };
  std::int64_t samples;      ///< of the block
  double frequency;          ///< the estimate with this block, rad/sample
  double unexplained_share;  ///< share of the power of its bins that the estimate does not explain: 0 in lock
                             ///< without noise
  double last_blocks_share;  ///< the same over the last blocks
  double best_frequency;     ///< the frequency near the tracker's bins that explains most of them, rad/sample
  double best_share;         ///< the share that it explains
  State state;
};

class TrackerRun {
 public:
  TrackerRun() = default;
  virtual ~TrackerRun() = default;
  TrackerRun(const TrackerRun&) = delete;
  TrackerRun& operator=(const TrackerRun&) = delete;
  TrackerRun(TrackerRun&&) = delete;
  TrackerRun& operator=(TrackerRun&&) = delete;

  /// 1, or 2: in phase and quadrature.
  [[nodiscard]] virtual int channels() const = 0;
  /// Whether innovation and NIS are numbers.
  [[nodiscard]] virtual bool has_innovation() const = 0;
  /// Restarts in the state that the tracker has when it has followed this tone; `first` is the tone at the
  /// next sample. Nearest rounding.
  virtual void start(const ToneAtSample& first) = 0;
  /// One sample, `channels()` values in signal units. Nearest rounding.
  [[nodiscard]] virtual TrackerOutput step(std::span<const double> sample) = 0;
  /// One missing sample: the prediction, or empty when this tracker cannot continue without the sample.
  /// Nearest rounding.
  [[nodiscard]] virtual std::optional<TrackerOutput> predict() = 0;
  /// All blocks so far, for a tracker that takes samples in blocks; empty for another.
  [[nodiscard]] virtual std::span<const TrackedBlock> blocks() const { return {}; }
};

/// A part of a periodic signal of amplitude 1: value e^{i order phi} of both channels together, or the real
/// part of that with one channel.
struct Harmonic {
  int order = 1;
  std::complex<double> value = 1.0;
};

/// A design's assumptions on its signal, in doubles: for a comparison with a recording.
struct SignalAssumptions {
  std::array<double, 2> amplitude{1, 1};  ///< [least, largest], signal units
  bool amplitude_varies = false;          ///< from sample to sample; otherwise it is constant
  std::array<double, 2> frequency{0, 0};  ///< [lowest, highest], rad/sample
  std::optional<double> noise;            ///< |v(k)| at most, signal units
  std::optional<double> noise_deviation;  ///< of each channel, signal units; where the noise is Gaussian
  std::optional<double> slew;             ///< rad/sample per sample, at most; none with a `frequency_walk`
  std::optional<double> sample_rate;      ///< Hz; where the design gives it
  std::optional<double> samples;          ///< the number for which a probability is asked
  std::vector<Harmonic> signal = std::vector<Harmonic>(1);  ///< a tone, or that of the design's formulas
  bool has_signal_key = false;                              ///< whether the design file could give formulas
  std::vector<std::string> start;                           ///< the assumptions on the start, a phrase each
};

/// Thrown for a design whose tracker cannot be run on samples: what() names what is missing.
class NotTrackable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A tracker and the assumptions of its design.
struct TrackerOnSamples {
  std::unique_ptr<TrackerRun> tracker;
  SignalAssumptions assume;
};

}  // namespace veritrack::certificates

// The findings in a recording beside its tone, and their detectors. Nothing here is proved.
#pragma once

#include <complex>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/recording_units.hpp"
#include "reports/recording/sample_ranges.hpp"
#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"

namespace veritrack::reports {

/// A defect, where it is, and what helps.
struct Finding {
  std::string name;  ///< "DC offset"
  std::string sees;  ///< a sentence with numbers
  SampleRanges where;
  std::string remedy;       ///< one or two sentences
  bool is_signal = false;   ///< the recording has another signal than the one that the design assumes
  bool is_slew = false;     ///< the frequency moves faster than assumed
  bool is_missing = false;  ///< samples are missing, or carry no signal
};

/// A short stretch of the recording, in which the tone was looked for by itself.
struct ToneStretch {
  std::int64_t first = 0;  ///< sample
  std::int64_t length = 0;
  double frequency = 0.0;  ///< rad/sample
  double amplitude = 0.0;  ///< in the middle, units of the recording
  double phase = 0.0;      ///< likewise, rad
  double share = 0.0;      ///< of the power, in [0, 1]
  double root_mean_square = 0.0;
  bool has_tone = false;
  bool follows = false;  ///< the previous stretch ends where this one begins, and also has a tone
};

/// An estimate with its deviation in white noise.
struct FittedPart {
  int order = 0;           ///< of a harmonic
  double hertz = 0.0;      ///< of mains hum
  double size = 0.0;       ///< amplitude or offset, units of the recording
  double deviation = 0.0;  ///< of each of its two parts (of an offset with one channel, of its one part)
  std::complex<double> value = 0.0;  ///< against the phase of the tone
};

/// A longer stretch, with a fit of everything by least squares.
struct ExaminedBlock {
  std::int64_t first = 0;
  std::span<const RecordedSample> samples;
  std::span<const std::complex<double>> tone;  ///< fitted, sample by sample, without its harmonics
  double amplitude = 0.0;                      ///< of the tone, units of the recording
  double frequency = 0.0;                      ///< mean, rad/sample
  double noise_deviation = 0.0;                ///< of each channel: of what no part explains
  FittedPart offset;
  std::vector<FittedPart> harmonics;
  std::vector<FittedPart> hum;         ///< and the lines at 40 and 70 Hz beside it
  std::vector<FittedPart> amplitudes;  ///< of the tone, at a few places

  [[nodiscard]] std::int64_t last() const { return first + static_cast<std::int64_t>(samples.size()) - 1; }
};

/// The data from which a finding is put into words.
struct FindingContext {
  const certificates::SignalAssumptions& assume;
  const Waveform& waveform;
  RecordingUnits units;
  double scale = 1.0;  ///< from the units of the recording to those of the design
  int channels = 1;    ///< that were recorded
};

/// Looks for one kind of defect. A test is exceeded in white noise with a probability of at most 1e-6 a
/// block.
class Detector {
 public:
  Detector() = default;
  virtual ~Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  Detector(Detector&&) = delete;
  Detector& operator=(Detector&&) = delete;

  /// Every sample, in short stretches.
  virtual void see(const ToneStretch& stretch, std::span<const RecordedSample> samples) {
    (void)stretch;
    (void)samples;
  }
  /// Blocks with a tone. False: the samples are spoilt for those that come after in the list.
  virtual bool judge(const ExaminedBlock& block) {
    (void)block;
    return true;
  }
  [[nodiscard]] virtual std::optional<Finding> finding(const FindingContext& context) const = 0;
};

/// How sure a test is: two parts of an estimate in white noise, normalised, have a squared sum above this
/// with a probability of exp(-15) = 3e-7; one part alone lies beyond 5 deviations with 6e-7.
inline constexpr double kSureSquares = 30.0;
inline constexpr double kSureDeviations = 5.0;
/// Components below this share of the tone's amplitude are omitted.
inline constexpr double kSmallestPart = 3e-3;

/// Whether an estimate of two parts (with one channel, an offset has one) is there, by the tests above, and
/// is a part of the tone that counts.
[[nodiscard]] inline bool is_there(const FittedPart& part, double amplitude, int parts) {
  const double normalised = part.size / part.deviation;
  return part.size >= kSmallestPart * amplitude &&
         (parts > 1 ? normalised * normalised > kSureSquares : normalised > kSureDeviations);
}

}  // namespace veritrack::reports

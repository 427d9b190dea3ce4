// Tones with a defect, made up for tests, and what the examiner makes of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "reports/recording/findings/recording_examiner.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::test {

inline constexpr double kRate = 8000.0;  // Hz

[[nodiscard]] inline double radians(double hertz) {
  return 2.0 * std::numbers::pi * hertz / kRate;
}

/// 300 to 1200 Hz at 8 kHz, a slew of 10 Hz per second.
[[nodiscard]] inline certificates::SignalAssumptions audio_assumptions() {
  certificates::SignalAssumptions assume;
  assume.frequency = {radians(300.0), radians(1200.0)};
  assume.noise = 0.1;
  assume.slew = 1e-6;
  return assume;
}

/// How a recording is made: a tone of amplitude 1, what is added to it, white noise, and what is done to
/// that.
struct MadeTone {
  int channels = 1;
  std::size_t samples = 40000;
  std::uint64_t seed = 1;
  double decibels = 40.0;  ///< the tone's power over the noise's, of all channels together
  std::function<double(std::size_t)> hertz = [](std::size_t) { return 440.0; };
  std::function<double(std::size_t)> amplitude = [](std::size_t) { return 1.0; };
  std::function<double(std::size_t, double)> added;  ///< to both channels, from sample and phase
  std::function<void(std::size_t, reports::RecordedSample&)> distorted;  ///< behind the noise
};

[[nodiscard]] inline std::vector<reports::RecordedSample> made(const MadeTone& made) {
  trackers::RandomStream random(made.seed);
  const double deviation = std::pow(10.0, -made.decibels / 20.0) / std::numbers::sqrt2;
  std::vector<reports::RecordedSample> recording;
  double phase = 0.3;
  for (std::size_t k = 0; k < made.samples; ++k) {
    const double more = made.added ? made.added(k, phase) : 0.0;
    const double size = made.amplitude(k);
    reports::RecordedSample sample;
    sample.in_phase = size * std::cos(phase) + more + deviation * random.normal();
    if (made.channels > 1) {
      sample.quadrature = size * std::sin(phase) + more + deviation * random.normal();
    }
    if (made.distorted) {
      made.distorted(k, sample);
    }
    recording.push_back(sample);
    phase = std::remainder(phase + radians(made.hertz(k)), 2.0 * std::numbers::pi);
  }
  return recording;
}

[[nodiscard]] inline std::vector<reports::Finding> examined(
    const std::vector<reports::RecordedSample>& recording, int channels,
    const certificates::SignalAssumptions& assume = audio_assumptions(), std::optional<double> rate = kRate) {
  reports::RecordingExaminer examiner(assume, channels, rate);
  for (std::size_t k = 0; k < recording.size(); ++k) {
    examiner.push(static_cast<std::int64_t>(k), recording[k]);
  }
  examiner.finish();
  return examiner.findings(1.0);
}

/// "hum, gaps", or "nothing".
[[nodiscard]] inline std::string names(const std::vector<reports::Finding>& findings) {
  std::string text;
  for (const reports::Finding& each : findings) {
    text += (text.empty() ? "" : ", ") + each.name;
  }
  return text.empty() ? "nothing" : text;
}

/// Both numbers of channels, and several ratios of signal to noise.
inline void for_each_kind(const std::function<void(int, double)>& test) {
  for (const int channels : {1, 2}) {
    for (const double decibels : {15.0, 25.0, 40.0, 200.0}) {
      test(channels, decibels);
    }
  }
}

}  // namespace veritrack::test

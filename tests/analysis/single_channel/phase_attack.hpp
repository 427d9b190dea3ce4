// Runs of the paper's filter, in extended precision, in which noise and slew are chosen to push the frequency
// error out. Shares no code with the certificate.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "tests/trackers/textbook_single_channel_ekf.hpp"

namespace veritrack::test {

struct Attack {
  double q, r;         ///< Q = q I
  double phase;        ///< of the signal at the start, rad
  double frequency;    ///< of the signal at the start, rad/sample
  double low, high;    ///< the band of frequencies
  double noise, slew;  ///< bounds
  double amplitude_error, phase_error, frequency_error;
  int samples;
  /// P(0|0), the same in the frame of the filter; none: the steady state.
  std::optional<TextbookSingleChannelEkf<long double>::Matrix3> start_covariance = std::nullopt;
};

using Filter = TextbookSingleChannelEkf<long double>;

/// The covariance on a tone of that frequency that comes to that phase, in the frame of the filter.
inline Filter::Matrix3 steady_covariance(double q, double r, double frequency, double phase) {
  using Vector3 = Filter::Vector3;
  constexpr int kSettling = 600;
  const long double start = static_cast<long double>(phase) - kSettling * static_cast<long double>(frequency);
  Filter filter{Filter::Matrix3(Vector3::Constant(q).asDiagonal()), r, 0.0L,
                Vector3(std::cos(start), std::sin(start), frequency),
                Filter::Matrix3(Vector3::Constant(r).asDiagonal())};
  for (int k = 1; k <= kSettling; ++k) {
    filter.step(std::cos(start + k * static_cast<long double>(frequency)));
  }
  return filter.P;
}

/// The frequency errors, estimate less truth, from the start on.
inline std::vector<double> attacked_errors(const Attack& attack) {
  using Vector3 = Filter::Vector3;
  long double phase = attack.phase;
  long double frequency = attack.frequency;
  const double seen = attack.phase + attack.phase_error;
  const long double amplitude = 1.0L + attack.amplitude_error;
  Filter filter{
      Filter::Matrix3(Vector3::Constant(attack.q).asDiagonal()), attack.r, 0.0L,
      Vector3(amplitude * std::cos(static_cast<long double>(seen)),
              amplitude * std::sin(static_cast<long double>(seen)), frequency + attack.frequency_error),
      attack.start_covariance ? *attack.start_covariance
                              : steady_covariance(attack.q, attack.r, attack.frequency, seen)};
  std::vector<double> errors;
  errors.reserve(static_cast<std::size_t>(attack.samples) + 1);
  errors.push_back(static_cast<double>(filter.x(2) - frequency));
  for (int k = 0; k < attack.samples; ++k) {
    const long double direction = filter.x(2) >= frequency ? 1.0L : -1.0L;
    phase += frequency;
    frequency = std::clamp(frequency - direction * attack.slew, static_cast<long double>(attack.low),
                           static_cast<long double>(attack.high));
    const auto after = [&](long double noise) {
      Filter next = filter;
      next.step(std::cos(phase) + noise);
      return next;
    };
    const Filter up = after(attack.noise);
    const Filter down = after(-attack.noise);
    const bool up_is_worse = std::fabs(up.x(2) - frequency) >= std::fabs(down.x(2) - frequency);
    filter = up_is_worse ? up : down;
    errors.push_back(static_cast<double>(filter.x(2) - frequency));
  }
  return errors;
}

}  // namespace veritrack::test

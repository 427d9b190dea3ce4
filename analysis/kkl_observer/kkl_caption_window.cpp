#include "analysis/kkl_observer/kkl_caption_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/running_statistics.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::kkl_observer {

namespace {

/// A filter's response to a sinusoid, -lambda xi + a sin(w t + p), in steady state: gain sin(w t + shift).
struct FilterResponse {
  FilterResponse(double rate, double amplitude, double rotation, double phase)
      : gain(amplitude / std::hypot(rate, rotation)),
        frequency(rotation),
        shift(phase - std::atan2(rotation, rate)) {}
  [[nodiscard]] double at(double time) const { return gain * std::sin(frequency * time + shift); }
  double gain, frequency, shift;
};

SteadyStatistics steady_part(const search::RunningStatistics& statistics) {
  return {statistics.mean(), statistics.deviation()};
}

}  // namespace

long section_v_steps(double disturbance_frequency) {
  constexpr double kStepsADisturbance = 40.0;
  constexpr double kFewest = 4000.0;
  return std::lround(std::max(kFewest, kStepsADisturbance * disturbance_frequency));
}

CaptionWindow drawn_caption_window(std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  trackers::RandomStream random(seed);
  const double begin = 5.0 + 10.0 * random.uniform();
  const double length = 15.0 + 10.0 * random.uniform();
  return {begin, begin + length, 2.0 * std::numbers::pi * random.uniform()};
}

CaptionStatistics caption_statistics(const Eigen::Vector4d& lambda, double ell, double disturbance_frequency,
                                     const CaptionWindow& window) {
  const rigor::NearestRounding nearest;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto responses = [&lambda](double amplitude, double frequency, double phase) {
    const auto of = [&](int i) { return FilterResponse(lambda(i), amplitude, frequency, phase); };
    return std::array{of(0), of(1), of(2), of(3)};
  };
  const auto signal = responses(kSectionVAmplitude, kSectionVFrequency, 0.0);
  const auto disturbance = responses(kSectionVDisturbance, disturbance_frequency, window.phase);
  const trackers::KklObserverDesign<double, 4> design{lambda, ell};
  const double length = window.end - window.begin;
  const auto steps = static_cast<long>(std::ceil(
      length / (2.0 * std::numbers::pi) * static_cast<double>(section_v_steps(disturbance_frequency))));
  search::RunningStatistics amplitude;
  search::RunningStatistics frequency;
  search::RunningStatistics some_amplitude;
  search::RunningStatistics some_frequency;
  CaptionStatistics result;
  result.largest_ell = std::numeric_limits<double>::infinity();
  for (long k = 0; k <= steps; ++k) {
    const double time = window.begin + length * static_cast<double>(k) / static_cast<double>(steps);
    Eigen::Vector4d filters;
    for (int i = 0; i < 4; ++i) {
      const auto filter = static_cast<std::size_t>(i);
      filters(i) = signal.at(filter).at(time) + disturbance.at(filter).at(time);
    }
    result.largest_ell =
        std::min(result.largest_ell,
                 2.0 * trackers::kkl_excitation<double, 4>(filters, lambda) / filters.squaredNorm());
    const auto x = trackers::kkl_inverse<double, 4>(filters, design);
    if (x(2) > 0.0) {
      const auto estimate = trackers::in_engineering_units(x);
      amplitude.add(estimate.amplitude);
      frequency.add(estimate.frequency);
      some_amplitude.add(estimate.amplitude);
      some_frequency.add(estimate.frequency);
    } else {
      amplitude.add(kNone);
      frequency.add(kNone);
    }
  }
  result.amplitude = steady_part(amplitude);
  result.frequency = steady_part(frequency);
  result.amplitude_where_any = steady_part(some_amplitude);
  result.frequency_where_any = steady_part(some_frequency);
  result.without_estimate = 1.0 - some_frequency.count() / frequency.count();
  return result;
}

}  // namespace veritrack::kkl_observer

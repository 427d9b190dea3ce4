#include "certificates/sets/gaussian_noise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::certificates {

using rigor::Interval;

Interval deviation_at_unit_amplitude(const Assumptions& assume) {
  const GaussianNoise& noise = assume.gaussian.value();
  if (noise.deviation) {
    return noise.deviation->value / assume.amplitude.value;
  }
  // sigma^2 = 10^(-snr/10)/2.
  const Interval exponent = -(noise.snr_db->value / Interval(20.0)) * rigor::log(Interval(10.0));
  return rigor::exp(exponent) / rigor::sqrt(Interval(2.0));
}

double nearest_deviation(const Assumptions& assume) {
  const GaussianNoise& noise = assume.gaussian.value();
  return noise.deviation ? noise.deviation->nearest / assume.amplitude.nearest
                         : std::sqrt(0.5) * std::pow(10.0, -noise.snr_db->nearest / 20.0);
}

bool frequency_walks(const Assumptions& assume) {
  return assume.frequency_walk && !(assume.frequency_walk->value == Interval(0.0));
}

std::string stretch_of_samples(const Assumptions& assume) {
  return frequency_walks(assume)
             ? fmt::format("within {} samples", assume.samples.value().text)
             : fmt::format("within any {} successive samples, however late", assume.samples.value().text);
}

std::string gaussian_disturbance(const Assumptions& assume) {
  constexpr int kDigits = 3;
  const GaussianNoise& noise = assume.gaussian.value();
  std::string text = frequency_walks(assume)
                         ? fmt::format(
                               " at the start and walks in independent Gaussian steps of mean zero and "
                               "deviation at most {} rad/sample",
                               assume.frequency_walk->text)
                         : " and is constant";
  text +=
      ", with Gaussian measurement noise of mean zero, independent from sample to sample and from channel to "
      "channel, and ";
  text += noise.snr_db
              ? fmt::format(
                    "an SNR of at least {} dB (a deviation of at most {} of the amplitude in each channel)",
                    noise.snr_db->text, rigor::lower_decimal(deviation_at_unit_amplitude(assume), kDigits))
              : fmt::format("a deviation of at most {} in each channel", noise.deviation->text);
  return text;
}

}  // namespace veritrack::certificates

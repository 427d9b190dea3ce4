#include "certificates/sets/gaussian_noise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

using rigor::Interval;

namespace {

constexpr const char* kGaussian =
    ", with Gaussian measurement noise of mean zero, independent from sample to sample and from channel to "
    "channel, and ";

}  // namespace

Interval deviation_at_unit_amplitude(const GaussianNoise& noise, const Number& amplitude) {
  if (noise.deviation) {
    return noise.deviation->value / amplitude.value;
  }
  // sigma^2 = 10^(-snr/10)/2.
  const Interval exponent = -(noise.snr_db->value / Interval(20.0)) * rigor::log(Interval(10.0));
  return rigor::exp(exponent) / rigor::sqrt(Interval(2.0));
}

Interval deviation_at_unit_amplitude(const Assumptions& assume) {
  return deviation_at_unit_amplitude(assume.gaussian.value(), assume.amplitude);
}

GaussianNoise noise_of_snr(const std::string& decibels) {
  Number number;
  number.value = rigor::parse_decimal(decibels);
  number.tight = number.value;
  number.text = decibels;
  {
    const rigor::NearestRounding nearest;
    number.nearest = midpoint(number.value);
  }
  return {number, std::nullopt};
}

double nearest_deviation(const GaussianNoise& noise, const Number& amplitude) {
  return noise.deviation ? noise.deviation->nearest / amplitude.nearest
                         : std::sqrt(0.5) * std::pow(10.0, -noise.snr_db->nearest / 20.0);
}

double nearest_deviation(const Assumptions& assume) {
  return nearest_deviation(assume.gaussian.value(), assume.amplitude);
}

bool frequency_walks(const Assumptions& assume) {
  return assume.frequency_walk && !(assume.frequency_walk->value == Interval(0.0));
}

std::string stretch_of_samples(const Assumptions& assume) {
  return frequency_walks(assume)
             ? fmt::format("within {} samples", assume.samples.value().text)
             : fmt::format("within any {} successive samples, however late", assume.samples.value().text);
}

std::string gaussian_words(const std::string& snr_db, const Interval& unit_deviation) {
  constexpr int kDigits = 3;
  return fmt::format(
      "{}an SNR of at least {} dB (a deviation of at most {} of the amplitude in each channel)", kGaussian,
      snr_db, rigor::lower_decimal(unit_deviation, kDigits));
}

std::string gaussian_words(const GaussianNoise& noise, const Number& amplitude) {
  return noise.snr_db
             ? gaussian_words(noise.snr_db->text, deviation_at_unit_amplitude(noise, amplitude))
             : fmt::format("{}a deviation of at most {} in each channel", kGaussian, noise.deviation->text);
}

std::string gaussian_disturbance(const Assumptions& assume) {
  const std::string text = frequency_walks(assume)
                               ? fmt::format(
                                     " at the start and walks in independent Gaussian steps of mean zero and "
                                     "deviation at most {}",
                                     frequency_words(*assume.frequency_walk))
                               : " and is constant";
  return text + gaussian_words(assume.gaussian.value(), assume.amplitude);
}

}  // namespace veritrack::certificates

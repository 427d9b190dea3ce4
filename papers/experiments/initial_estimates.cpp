#include "papers/experiments/initial_estimates.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "papers/experiments/sonar_pass.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::experiments {

InitialEstimates initial_estimates(double offset, double decibels, int runs) {
  // The tone has the size 1 in the middle of its bin, where rho/2 is: variance 2 sigma^2/(T rho^2) in each
  // part.
  const double variance = 2.0 / kSonarSamples * std::pow(10.0, -0.1 * decibels);
  const double deviation = std::sqrt(variance);
  std::array<trackers::DftBin<double>, kSonarBins> clean{};
  double values = 0.0, products = 0.0, slopes = 0.0;
  for (int i = 0; i < kSonarBins; ++i) {
    const double d = kSonarHalfWidth - i + offset;
    const double angle = std::numbers::pi * d;
    const auto sinc = trackers::detail::sinc_with_slope(d, std::sin(angle), std::cos(angle));
    clean.at(static_cast<std::size_t>(i)) = {sinc.value * std::cos(angle), sinc.value * std::sin(angle)};
    values += sinc.value * sinc.value;
    products += sinc.value * sinc.slope;
    slopes += sinc.slope * sinc.slope;
  }
  const auto errors = repeat(runs, [&](std::uint64_t seed) {
    trackers::RandomStream random(seed);
    std::array<trackers::DftBin<double>, kSonarBins> bins = clean;
    for (trackers::DftBin<double>& bin : bins) {
      bin.real += deviation * random.normal();
      bin.imaginary += deviation * random.normal();
    }
    return trackers::dft_block_start<double>(std::span<const trackers::DftBin<double>>(bins)).offset - offset;
  });
  return {summary_of(errors), std::sqrt(variance / (slopes - products * products / values))};
}

}  // namespace veritrack::experiments

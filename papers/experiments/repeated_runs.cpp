#include "papers/experiments/repeated_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace veritrack::experiments {

Summary summary_of(std::span<const double> values) {
  if (values.empty()) {
    throw std::invalid_argument("a summary needs a value");
  }
  const rigor::NearestRounding nearest;
  const double count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) {
    mean += value / count;
  }
  double second = 0.0;
  double fourth = 0.0;
  for (const double value : values) {
    const double square = (value - mean) * (value - mean);
    second += square / count;
    fourth += square * square / count;
  }
  const double variance = second * count / (count - 1.0);  // NaN of one value: 0 by 0
  const double deviation = std::sqrt(variance);
  // The variance of a sample variance is about (m4 - m2^2) / n.
  const double spread = std::sqrt(std::max(fourth - second * second, 0.0) / count);
  return {mean, deviation / std::sqrt(count), deviation,
          deviation > 0.0 ? spread / (2.0 * deviation) : deviation};
}

double quantile_of(std::span<const double> values, double share) {
  if (values.empty()) {
    throw std::invalid_argument("a quantile needs a value");
  }
  std::vector<double> sorted(values.begin(), values.end());
  for (double& value : sorted) {
    value = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  }
  std::sort(sorted.begin(), sorted.end());
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::clamp(std::round(share * last), 0.0, last))];
}

Median median_of(std::span<const double> values) {
  const double ranks = 0.5 / std::sqrt(static_cast<double>(values.size()));
  const double value = quantile_of(values, 0.5);
  if (values.size() == 1) {
    return {value, std::numeric_limits<double>::quiet_NaN()};
  }
  return {value, 0.5 * (quantile_of(values, 0.5 + ranks) - quantile_of(values, 0.5 - ranks))};
}

}  // namespace veritrack::experiments

#include "analysis/regulator/inverse_filter.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::regulator {

namespace {

using rigor::Interval;

constexpr std::size_t kMostCoefficients = 20'000;

/// The impulse response of 1/A in doubles, until it is lost in rounding. Proposed, not proved.
std::vector<double> propose_response(const std::vector<Interval>& coefficients) {
  const rigor::NearestRounding nearest;
  constexpr double kNegligible = 1e-17;
  std::vector<double> response;
  double largest = 0.0;
  std::size_t small = 0;
  while (response.size() < kMostCoefficients && small < coefficients.size()) {
    double next = response.empty() ? 1.0 : 0.0;
    for (std::size_t i = 1; i < coefficients.size() && i <= response.size(); ++i) {
      next -= midpoint(coefficients[i]) * response[response.size() - i];
    }
    next /= midpoint(coefficients[0]);
    response.push_back(next);
    largest = std::max(largest, std::fabs(next));
    small = std::fabs(next) <= kNegligible * largest ? small + 1 : 0;
  }
  return response;
}

}  // namespace

InverseFilter::InverseFilter(const std::vector<Interval>& coefficients)
    : response_(propose_response(coefficients)) {
  const auto weight = [](std::size_t i) { return Interval(static_cast<double>(i + 1)); };
  Interval residual(0.0);
  Interval weighted_residual(0.0);
  Interval size(0.0);
  Interval weighted_size(0.0);
  const std::size_t last = response_.size() + coefficients.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {
    Interval sum(k == 0 ? -1.0 : 0.0);
    for (std::size_t i = 0; i < coefficients.size() && i <= k; ++i) {
      if (k - i < response_.size()) {
        sum += coefficients[i] * Interval(response_[k - i]);
      }
    }
    residual += abs(sum);
    weighted_residual += weight(k) * abs(sum);
  }
  for (std::size_t i = 0; i < response_.size(); ++i) {
    size += abs(Interval(response_[i]));
    weighted_size += weight(i) * abs(Interval(response_[i]));
  }
  const Interval rest = Interval(1.0) - residual;
  const Interval weighted_rest = Interval(1.0) - weighted_residual;
  stable_ = rigor::certainly_positive(rest) && rigor::certainly_positive(weighted_rest) &&
            rigor::is_finite(weighted_size);
  if (stable_) {
    // A little more than that, for a checker with another arithmetic and another h.
    constexpr double kRoom = 1.0 + 0x1p-30;
    norm_ = Interval(kRoom) * size / rest;
    weighted_norm_ = Interval(kRoom) * weighted_size / weighted_rest;
    error_ = norm_ * residual;
    peak_ = Interval(0.0);
    for (const double value : response_) {
      peak_ = max(peak_, abs(Interval(value)));
    }
    peak_ = Interval(kRoom) * (peak_ + error_);
  }
}

Interval InverseFilter::tail(std::size_t first) const {
  Interval sum = error_;  // empty unless stable
  for (std::size_t i = first; i < response_.size(); ++i) {
    sum += abs(Interval(response_[i]));
  }
  return sum;
}

}  // namespace veritrack::regulator

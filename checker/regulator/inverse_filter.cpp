#include "checker/regulator/inverse_filter.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker {

namespace {

/// A finite filter that may do for the inverse: any would, nothing rests on it.
std::vector<double> proposed(const std::vector<Ball>& coefficients) {
  constexpr std::size_t kLongest = 20'000;
  constexpr double kNothing = 1e-18;
  const double first = coefficients[0].near();
  std::vector<double> response{1.0 / first};
  std::size_t quiet = 0;
  while (response.size() < kLongest && quiet < coefficients.size()) {
    double sum = 0.0;
    for (std::size_t i = 1; i < coefficients.size() && i <= response.size(); ++i) {
      sum -= coefficients[i].near() * response[response.size() - i];
    }
    response.push_back(sum / first);
    quiet = std::fabs(sum) <= kNothing * std::fabs(first * response[0]) ? quiet + 1 : 0;
  }
  return response;
}

}  // namespace

InverseFilter::InverseFilter(const std::vector<Ball>& coefficients) : response_(proposed(coefficients)) {
  // The product with the coefficients, less 1.
  std::vector<Ball> rest(response_.size() + coefficients.size() - 1, zero);
  rest[0] = -one;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    for (std::size_t k = 0; k < response_.size(); ++k) {
      rest[i + k] += coefficients[i] * Ball(response_[k]);
    }
  }
  Ball residual = zero;
  Ball delayed_residual = zero;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    residual += abs(rest[i]);
    delayed_residual += Ball(static_cast<double>(i + 1)) * abs(rest[i]);
  }
  Ball size = zero;
  Ball delayed = zero;
  for (std::size_t i = 0; i < response_.size(); ++i) {
    size += abs(Ball(response_[i]));
    delayed += Ball(static_cast<double>(i + 1)) * abs(Ball(response_[i]));
  }
  stable_ = certainly_less(residual, one) && certainly_less(delayed_residual, one) && delayed.finite();
  if (stable_) {
    norm_ = size / (one - residual);
    off_ = norm_ * residual;
    double largest = 0.0;
    for (const double each : response_) {
      largest = std::max(largest, std::fabs(each));
    }
    peak_ = Ball(largest) + off_;
    delay_norm_ = delayed / (one - delayed_residual);
  }
}

Ball InverseFilter::tail(std::size_t first) const {
  Ball sum = off_;
  for (std::size_t i = first; i < response_.size(); ++i) {
    sum += abs(Ball(response_[i]));
  }
  return sum;
}

}  // namespace veritrack::checker

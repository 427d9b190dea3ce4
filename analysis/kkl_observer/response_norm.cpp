#include "analysis/kkl_observer/response_norm.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::kkl_observer {

using rigor::Interval;

template <int M>
ResponseNorm<M>::ResponseNorm(const Coefficients& lambda, const Interval& frequency) {
  constexpr double kPerGrowth = 32.0;  // cells while the period grows by a factor e
  constexpr int kFewest = 16;
  constexpr double kMost = 1000.0;
  const double longest = (Interval(1.0) / frequency).upper();
  double fastest = lambda[0].upper();
  for (const Interval& rate : lambda) {
    fastest = std::max(fastest, rate.upper());
  }
  // Dense at first, where the responses of fast filters still change: a proposal, as every partition is
  // valid.
  const double bend = 1.0 / fastest;
  const double growth = std::log1p(longest / bend);
  const int cells = kFewest + static_cast<int>(std::min(kPerGrowth * growth, kMost));
  double begin = 0.0;
  for (int k = 1; k <= cells; ++k) {
    const double proposed = k == cells ? longest : bend * std::expm1(growth * k / cells);
    const double end = std::min(std::max(proposed, begin), longest);
    const Interval period = Interval::from_bounds(begin, end);
    const Interval middle(rigor::midpoint(period));
    Cell cell;
    cell.half_width = Interval(rigor::magnitude(period - middle));
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Interval x = lambda[i] * middle;
      const Interval squared = square(x) + Interval(1.0);  // |lambda r + j|^2
      cell.value.real[i] = x * middle / squared;
      cell.value.imaginary[i] = -(middle / squared);
      cell.slope.real[i] = (x + x) / square(squared);
      cell.slope.imaginary[i] = (square(x) - Interval(1.0)) / square(squared);
      const Interval least = square(lambda[i] * Interval(begin)) + Interval(1.0);
      cell.bending[i] = lambda[i] / (least * sqrt(least)) * square(cell.half_width);
    }
    cells_.push_back(cell);
    begin = end;
  }
}

template <int M>
Interval ResponseNorm<M>::upper_bound(const Coefficients& coefficients) const {
  const auto sum = [&](const Coefficients& x) {
    Interval total(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      total += coefficients[i] * x[i];
    }
    return total;
  };
  Interval largest(0.0);
  for (const Cell& cell : cells_) {
    const Interval real = sum(cell.value.real);
    const Interval imaginary = sum(cell.value.imaginary);
    const Interval real_change = sum(cell.slope.real) * cell.half_width;
    const Interval imaginary_change = sum(cell.slope.imaginary) * cell.half_width;
    Interval rest(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      rest += abs(coefficients[i]) * cell.bending[i];
    }
    const Interval squared = max(square(real + real_change) + square(imaginary + imaginary_change),
                                 square(real - real_change) + square(imaginary - imaginary_change));
    largest = max(largest, sqrt(Interval(squared.upper())) + rest);
  }
  return Interval(largest.upper());
}

template class ResponseNorm<4>;
template class ResponseNorm<5>;
template class ResponseNorm<6>;
template class ResponseNorm<7>;
template class ResponseNorm<8>;

}  // namespace veritrack::kkl_observer

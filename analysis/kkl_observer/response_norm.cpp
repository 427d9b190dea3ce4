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
    cell.half_width = rigor::symmetric(rigor::magnitude(period - middle));
    for (std::size_t i = 0; i < kFilters; ++i) {
      const auto denominator = [&](const Interval& r) { return square(lambda[i] * r) + Interval(1.0); };
      const Interval there = denominator(middle);
      const Interval squared = square(denominator(period));
      cell.at_middle.real[i] = lambda[i] * square(middle) / there;
      cell.at_middle.imaginary[i] = middle / there;
      cell.slope.real[i] = Interval(2.0) * lambda[i] * period / squared;
      cell.slope.imaginary[i] = (Interval(1.0) - square(lambda[i] * period)) / squared;
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
    const Interval real = sum(cell.at_middle.real) + sum(cell.slope.real) * cell.half_width;
    const Interval imaginary = sum(cell.at_middle.imaginary) + sum(cell.slope.imaginary) * cell.half_width;
    largest = max(largest, square(real) + square(imaginary));
  }
  return Interval(sqrt(Interval(largest.upper())).upper());
}

template class ResponseNorm<4>;
template class ResponseNorm<5>;
template class ResponseNorm<6>;
template class ResponseNorm<7>;
template class ResponseNorm<8>;

}  // namespace veritrack::kkl_observer

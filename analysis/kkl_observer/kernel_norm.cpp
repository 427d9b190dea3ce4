#include "analysis/kkl_observer/kernel_norm.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;

/// The ends of the cells: dense at first, where fast filters still move, and wider later.
template <typename Rates>
std::vector<double> cell_ends(const Rates& lambda, std::size_t cells) {
  double slowest = lambda[0].lower();
  double fastest = lambda[0].upper();
  for (const Interval& rate : lambda) {
    slowest = std::min(slowest, rate.lower());
    fastest = std::max(fastest, rate.upper());
  }
  constexpr double kTimeConstants = 18.0;  // of the slowest filter: exp(-18) is 1.5e-8
  const double end = kTimeConstants / slowest;
  const double bend = 1.0 / fastest;
  std::vector<double> ends{0.0};
  ends.reserve(cells + 1);
  const double growth = std::log(1.0 + end / bend);
  for (std::size_t j = 1; j <= cells; ++j) {
    const double place = static_cast<double>(j) / static_cast<double>(cells);
    ends.push_back(std::max(ends.back(), bend * (std::exp(growth * place) - 1.0)));
  }
  return ends;
}

}  // namespace

template <int M>
KernelNorm<M>::KernelNorm(const Coefficients& lambda, std::size_t cells) {
  const std::vector<double> ends = cell_ends(lambda, cells);
  const auto decay = [&](std::size_t i, double time) { return exp(-(lambda[i] * Interval(time))); };
  cells_.reserve(cells);
  for (std::size_t j = 0; j < cells; ++j) {
    const double begin = ends[j];
    const double end = ends[j + 1];
    const double middle = rigor::midpoint(Interval::from_bounds(begin, end));
    Cell cell;
    cell.width = rigor::sub_up(end, begin);
    cell.half_width = Interval::from_bounds(begin, end) - Interval(middle);
    for (std::size_t i = 0; i < kFilters; ++i) {
      const Interval at_begin = decay(i, begin);
      const Interval at_end = decay(i, end);
      cell.at_middle[i] = decay(i, middle);
      cell.slope[i] = -(lambda[i] * hull(at_begin, at_end));
      cell.integral[i] = (at_begin - at_end) / lambda[i];
    }
    cells_.push_back(cell);
  }
  for (std::size_t i = 0; i < kFilters; ++i) {
    tail_[i] = decay(i, ends.back()) / lambda[i];
  }
}

template <int M>
Interval KernelNorm<M>::upper_bound(const Coefficients& coefficients) const {
  Interval sum(0.0);
  for (const Cell& cell : cells_) {
    Interval middle(0.0);
    Interval slope(0.0);
    for (std::size_t i = 0; i < kFilters; ++i) {
      middle += coefficients[i] * cell.at_middle[i];
      slope += coefficients[i] * cell.slope[i];
    }
    const Interval kernel = middle + slope * cell.half_width;
    if (certainly_positive(kernel) || certainly_negative(kernel)) {
      Interval integral(0.0);
      for (std::size_t i = 0; i < kFilters; ++i) {
        integral += coefficients[i] * cell.integral[i];
      }
      sum += abs(integral);
    } else {
      sum += Interval(cell.width) * Interval(rigor::magnitude(kernel));
    }
  }
  for (std::size_t i = 0; i < kFilters; ++i) {
    sum += abs(coefficients[i]) * tail_[i];
  }
  return Interval(sum.upper());
}

template class KernelNorm<4>;
template class KernelNorm<5>;
template class KernelNorm<6>;
template class KernelNorm<7>;
template class KernelNorm<8>;

}  // namespace veritrack::kkl_observer

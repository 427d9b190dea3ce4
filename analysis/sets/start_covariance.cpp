#include "analysis/sets/start_covariance.hpp"

#include <algorithm>
#include <array>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::sets {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::Matrix;
using rigor::Verdict;

bool is_below(const Matrix<3>& low, const IntervalMatrix<3>& high) {
  return rigor::is_positive_definite(IntervalMatrix<3>(high - rigor::to_interval(low))) == Verdict::proved;
}
bool is_above(const Matrix<3>& high, const IntervalMatrix<3>& low) {
  return rigor::is_positive_definite(IntervalMatrix<3>(rigor::to_interval(high) - low)) == Verdict::proved;
}

/// The multiple farthest from `inside`, for which it is true, towards `outside`, for which it may not be.
template <typename IsTrue>
double farthest(double inside, double outside, const IsTrue& is_true) {
  constexpr int kBisections = 40;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (inside + outside);
    (is_true(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

IntervalMatrix<3> StartCovariance::lower_end() const {
  return matrix * Interval(multiples.lower());
}

IntervalMatrix<3> StartCovariance::upper_end() const {
  return highest.value_or(matrix) * Interval(multiples.upper());
}

IntervalMatrix<3> StartCovariance::enclosure() const {
  IntervalMatrix<3> p = lower_end();
  std::array<Interval, 3> spread;
  for (int i = 0; i < 3; ++i) {
    // The same entry of M in both ends: their difference has no more than the error of one product.
    const Interval difference =
        highest ? upper_end()(i, i) - p(i, i)
                : matrix(i, i) * (Interval(multiples.upper()) - Interval(multiples.lower()));
    spread[static_cast<std::size_t>(i)] = Interval(std::max(difference.upper(), 0.0));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Interval reach = sqrt(spread[static_cast<std::size_t>(i)] * spread[static_cast<std::size_t>(j)]);
      p(i, j) += rigor::symmetric(reach.upper());
    }
  }
  return p;
}

bool certainly_between(const StartCovariance& start, const Matrix<3>& lower, const Matrix<3>& upper) {
  return is_below(lower, start.lower_end()) && is_above(upper, start.upper_end());
}

std::optional<Interval> multiples_between(const StartCovariance& start, const Matrix<3>& lower,
                                          const Matrix<3>& upper) {
  constexpr double kLargest = 1e6;
  if (!certainly_between(start, lower, upper)) {
    return std::nullopt;
  }
  if (start.is_given) {
    return start.multiples;
  }
  const double from = farthest(start.multiples.lower(), 0.0, [&](double multiple) {
    return is_below(lower, IntervalMatrix<3>(start.matrix * Interval(multiple)));
  });
  const double to = farthest(start.multiples.upper(), kLargest, [&](double multiple) {
    return is_above(upper, IntervalMatrix<3>(start.matrix * Interval(multiple)));
  });
  return Interval::from_bounds(from, to);
}

}  // namespace veritrack::sets

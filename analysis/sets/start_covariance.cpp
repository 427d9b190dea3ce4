#include "analysis/sets/start_covariance.hpp"

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

IntervalMatrix<3> StartCovariance::enclosure() const {
  IntervalMatrix<3> p;
  const Interval from(multiples.lower());
  const Interval spread = Interval(multiples.upper()) - from;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Interval reach = spread * sqrt(matrix(i, i) * matrix(j, j));
      p(i, j) = from * matrix(i, j) + rigor::symmetric(reach.upper());
    }
  }
  return p;
}

bool certainly_between(const StartCovariance& start, const Matrix<3>& lower, const Matrix<3>& upper) {
  return is_below(lower, IntervalMatrix<3>(start.matrix * Interval(start.multiples.lower()))) &&
         is_above(upper, IntervalMatrix<3>(start.matrix * Interval(start.multiples.upper())));
}

std::optional<Interval> multiples_between(const StartCovariance& start, const Matrix<3>& lower,
                                          const Matrix<3>& upper) {
  constexpr double kLargest = 1e6;
  if (!certainly_between(start, lower, upper)) {
    return std::nullopt;
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

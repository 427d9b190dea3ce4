#include "analysis/linear/stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::linear {

using rigor::Interval;
using rigor::Verdict;

namespace {

constexpr double kWidthsOfCrudeBounds = 64.0;

}  // namespace

std::vector<Interval> characteristic_polynomial(const std::vector<Row>& a) {
  const std::size_t n = a.size();
  std::vector<Interval> coefficients(n + 1, Interval(1.0));
  std::vector<Row> m(n, Row(n, Interval(0.0)));  // M_k = A M_(k-1) + c_(n-k+1) I
  for (std::size_t k = 1; k <= n; ++k) {
    std::vector<Row> next(n, Row(n, Interval(0.0)));
    Interval trace(0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t l = 0; l < n; ++l) {
          next[i][j] += a[i][l] * m[l][j];
        }
      }
      next[i][i] += coefficients[n - k + 1];
    }
    m = std::move(next);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t l = 0; l < n; ++l) {
        trace += a[i][l] * m[l][i];
      }
    }
    coefficients[n - k] = -trace / Interval(static_cast<double>(k));
  }
  return coefficients;
}

Verdict are_within(const std::vector<Row>& a, double radius) {
  std::vector<Interval> p = characteristic_polynomial(a);
  Interval power(1.0);
  for (Interval& coefficient : p) {  // of p(radius z)
    coefficient *= power;
    power *= Interval(radius);
  }
  // While |p_0| < |p_n| the polynomial (p_n p(z) - p_0 z^n p(1/z)) / z has one root fewer inside the unit
  // circle, and as many outside it.
  while (p.size() > 1) {
    const Interval first = square(p.front());
    const Interval last = square(p.back());
    if (rigor::certainly_less(last, first)) {
      return Verdict::refuted;  // the product of the roots is larger than 1
    }
    if (!rigor::certainly_less(first, last)) {
      return Verdict::undecided;
    }
    std::vector<Interval> reduced;
    for (std::size_t i = 1; i < p.size(); ++i) {
      reduced.push_back(p.back() * p[i] - p.front() * p[p.size() - 1 - i]);
    }
    p = std::move(reduced);
  }
  return Verdict::proved;
}

std::optional<RadiusBounds> spectral_radius_bounds(const std::vector<Row>& a) {
  constexpr double kFirst = 1e-10;
  constexpr double kLast = 1e-3;
  const auto n = static_cast<Eigen::Index>(a.size());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = rigor::midpoint(a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  const double near = rigor::spectral_radius(middle);
  if (!(near > 0.0) || !std::isfinite(near)) {
    return std::nullopt;
  }
  RadiusBounds bounds;
  for (double room = kFirst; room < kLast && !(bounds.lower > 0.0 && bounds.upper > 0.0); room *= 4.0) {
    if (!(bounds.upper > 0.0) && are_within(a, near * (1.0 + room)) == Verdict::proved) {
      bounds.upper = near * (1.0 + room);
    }
    if (!(bounds.lower > 0.0) && are_within(a, near * (1.0 - room)) == Verdict::refuted) {
      bounds.lower = near * (1.0 - room);
    }
  }
  return bounds.lower > 0.0 && bounds.upper > 0.0 ? std::optional(bounds) : std::nullopt;
}

RadiusBounds with_room(const RadiusBounds& bounds) {
  constexpr double kMost = 1e-6;
  constexpr double kOfDistance = 0.01;  // to 1
  const auto room = [&](double bound) { return std::min(kMost, kOfDistance * std::fabs(1.0 - bound)); };
  return {bounds.lower > 1.0 ? bounds.lower - room(bounds.lower) : bounds.lower,
          bounds.upper < 1.0 ? bounds.upper + room(bounds.upper) : bounds.upper};
}

Row with_room(const Row& row) {
  Row wider;
  wider.reserve(row.size());
  for (const Interval& entry : row) {
    const Interval middle(rigor::midpoint(entry));
    wider.push_back(middle + Interval(kWidthsOfCrudeBounds) * (entry - middle));
  }
  return wider;
}

std::vector<Row> with_room(const std::vector<Row>& rows) {
  std::vector<Row> wider;
  wider.reserve(rows.size());
  for (const Row& row : rows) {
    wider.push_back(with_room(row));
  }
  return wider;
}

}  // namespace veritrack::linear

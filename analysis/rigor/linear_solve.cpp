#include "analysis/rigor/linear_solve.hpp"

#include <Eigen/LU>
#include <limits>
#include <stdexcept>

namespace veritrack::rigor::detail {

namespace {

constexpr int kInflations = 20;
constexpr int kRefinements = 3;

struct Proposal {
  DynamicMatrix inverse;
  DynamicMatrix solution;
};

Proposal propose(const DynamicIntervalMatrix& a, const DynamicIntervalMatrix& b) {
  const NearestRounding nearest;
  const Eigen::PartialPivLU<DynamicMatrix> factors(midpoint(a));
  return {factors.inverse(), factors.solve(midpoint(b))};
}

/// A little more than x on every side.
DynamicIntervalMatrix inflate(const DynamicIntervalMatrix& x) {
  const Interval factor = Interval::from_bounds(0.9, 1.1);
  const Interval margin = symmetric(std::numeric_limits<double>::min());
  return x.unaryExpr([&](const Interval& entry) { return entry * factor + margin; });
}

}  // namespace

std::optional<DynamicIntervalMatrix> solve(const DynamicIntervalMatrix& a, const DynamicIntervalMatrix& b) {
  if (a.rows() != a.cols() || a.rows() != b.rows()) {
    throw std::invalid_argument("solve: a square matrix and as many right-hand rows are needed");
  }
  if (!is_finite(a) || !is_finite(b)) {
    return std::nullopt;
  }
  const Proposal proposal = propose(a, b);
  if (!proposal.inverse.allFinite() || !proposal.solution.allFinite()) {
    return std::nullopt;
  }
  const UpwardRounding upward;
  const DynamicIntervalMatrix r = to_interval(proposal.inverse);
  const DynamicIntervalMatrix x = to_interval(proposal.solution);
  const DynamicIntervalMatrix z = r * (b - a * x).eval();
  const DynamicIntervalMatrix c = DynamicIntervalMatrix::Identity(a.rows(), a.cols()) - r * a;
  if (!is_finite(z) || !is_finite(c)) {
    return std::nullopt;
  }
  DynamicIntervalMatrix error = z;
  for (int i = 0; i < kInflations; ++i) {
    const DynamicIntervalMatrix candidate = inflate(error);
    error = z + c * candidate;
    if (is_interior(error, candidate)) {
      // The error A^-1 B - X lies in `error`, and stays in every further image.
      for (int j = 0; j < kRefinements; ++j) {
        error = intersection(DynamicIntervalMatrix(z + c * error), error);
      }
      const DynamicIntervalMatrix solution = x + error;
      return is_finite(solution) ? std::optional(solution) : std::nullopt;
    }
    if (!is_finite(error)) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::rigor::detail

#include "analysis/rigor/definiteness.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::rigor::detail {

namespace {

DynamicIntervalMatrix symmetric_members(const DynamicIntervalMatrix& a) {
  if (a.rows() != a.cols()) {
    throw std::invalid_argument("positive definiteness: a square matrix is needed");
  }
  return intersection(a, a.transpose());
}

/// X with X mid(a) X' near the identity, where the midpoint is positive definite in floating point.
std::optional<DynamicMatrix> propose_congruence(const DynamicIntervalMatrix& a) {
  const NearestRounding nearest;
  const Eigen::LLT<DynamicMatrix> factor(midpoint(a));
  if (factor.info() != Eigen::Success) {
    return std::nullopt;
  }
  const DynamicMatrix congruence = factor.matrixL().solve(DynamicMatrix::Identity(a.rows(), a.cols()));
  return congruence.allFinite() ? std::optional(congruence) : std::nullopt;
}

/// Weights that make the rows of y, mirrored, nearly equally dominant.
Eigen::VectorXd propose_weights(const DynamicIntervalMatrix& y) {
  const NearestRounding nearest;
  DynamicMatrix rest = magnitude(y);
  rest.diagonal().setZero();
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(y.rows());
  for (int step = 0; step < 8; ++step) {
    const double size = weights.maxCoeff();
    weights = ((rest * weights) / size + weights / size).eval();
  }
  return weights;
}

/// y_ii w_i > sum_{j != i} |y_ij| w_j for every i, certainly.
bool is_dominant(const DynamicIntervalMatrix& y, const Eigen::VectorXd& weights) {
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    Interval others(0.0);
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      if (j != i) {
        others += abs(y(i, j)) * Interval(weights[j]);
      }
    }
    // cannot bind (Interval(weights[i])): no weight is negative, and with weight zero nothing is above the
    // others.
    if (!certainly_positive(Interval(weights[i])) ||
        !certainly_less(others, y(i, i) * Interval(weights[i]))) {
      return false;
    }
  }
  return y.size() > 0;
}

bool prove_by_congruence(const DynamicIntervalMatrix& a) {
  const std::optional<DynamicMatrix> proposal = propose_congruence(a);
  if (!proposal) {
    return false;
  }
  const DynamicIntervalMatrix x = to_interval(*proposal);
  const DynamicIntervalMatrix y = (x * a).eval() * x.transpose();
  return is_finite(y) &&
         (is_dominant(y, Eigen::VectorXd::Ones(y.rows())) || is_dominant(y, propose_weights(y)));
}

bool prove_by_eigenvalues(const DynamicIntervalMatrix& a) {
  const std::optional<DynamicIntervalMatrix> values = symmetric_eigenvalues(a);
  return values && certainly_positive((*values)(0));
}

/// x'Ax <= 0 for every symmetric A in a, mirrored, and x is not zero.
bool is_witness(const DynamicIntervalMatrix& a, const Eigen::VectorXd& x) {
  if (!x.allFinite() || !(x.cwiseAbs().maxCoeff() > 0.0)) {
    return false;
  }
  Interval form(0.0);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Interval x_i(x[i]);
    form += a(i, i) * square(x_i);
    for (Eigen::Index j = 0; j < i; ++j) {
      form += a(i, j) * (Interval(2.0) * x_i * Interval(x[j]));
    }
  }
  return certainly_less_equal(form, Interval(0.0));
}

/// Directions in which the midpoint is least positive.
DynamicMatrix propose_directions(const DynamicIntervalMatrix& a) {
  const NearestRounding nearest;
  return symmetric_eigenvectors(midpoint(a));
}

/// x with its largest entry 1 and the others rounded to a grid: exact where the data are small rationals.
Eigen::VectorXd rounded(const Eigen::VectorXd& x, double grid) {
  const NearestRounding nearest;
  Eigen::Index largest = 0;
  x.cwiseAbs().maxCoeff(&largest);
  return x.unaryExpr([&](double entry) { return std::nearbyint(entry / x[largest] * grid) / grid; });
}

std::optional<Eigen::VectorXd> find_direction_for_members(const DynamicIntervalMatrix& a) {
  if (!is_finite(a)) {
    return std::nullopt;
  }
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Eigen::VectorXd axis = Eigen::VectorXd::Unit(a.rows(), i);
    if (is_witness(a, axis)) {
      return axis;
    }
  }
  const DynamicMatrix directions = propose_directions(a);
  if (!directions.allFinite()) {
    return std::nullopt;
  }
  const Eigen::VectorXd lowest = directions.col(0);
  for (const double grid : {0x1p60, 0x1p20, 60.0}) {
    const Eigen::VectorXd candidate = rounded(lowest, grid);
    if (is_witness(a, candidate)) {
      return candidate;
    }
  }
  return std::nullopt;
}

}  // namespace

Verdict is_positive_definite(const DynamicIntervalMatrix& a) {
  const DynamicIntervalMatrix members = symmetric_members(a);
  if (!is_finite(members)) {
    return Verdict::undecided;
  }
  if (prove_by_congruence(members)) {
    return Verdict::proved;
  }
  if (find_direction_for_members(members)) {
    return Verdict::refuted;
  }
  return prove_by_eigenvalues(members) ? Verdict::proved : Verdict::undecided;
}

std::optional<Eigen::VectorXd> find_non_positive_direction(const DynamicIntervalMatrix& a) {
  return find_direction_for_members(symmetric_members(a));
}

}  // namespace veritrack::rigor::detail

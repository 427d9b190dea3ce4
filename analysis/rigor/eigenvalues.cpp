#include "analysis/rigor/eigenvalues.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::rigor::detail {

namespace {

void require_square(const DynamicIntervalMatrix& a, Eigen::Index size) {
  if (a.rows() != size || a.cols() != size) {
    throw std::invalid_argument("eigenvalues: square matrices of equal size are needed");
  }
}

/// The eigenvalues of every symmetric matrix in `a`, by Weyl from the diagonal.
std::optional<DynamicIntervalMatrix> eigenvalues_near_diagonal(const DynamicIntervalMatrix& a) {
  std::vector<double> lower;
  std::vector<double> upper;
  DynamicMatrix rest = magnitude(a);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    lower.push_back(a(i, i).lower());
    upper.push_back(a(i, i).upper());
    rest(i, i) = 0.0;
  }
  const std::optional<double> distance = norm_of_bounded_symmetric(rest);
  if (!distance) {
    return std::nullopt;
  }
  // The i-th eigenvalue increases with the diagonal, so each end is sorted by itself.
  std::sort(lower.begin(), lower.end());
  std::sort(upper.begin(), upper.end());
  DynamicIntervalMatrix result(a.rows(), 1);
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    result(i) = Interval::from_bounds(lower[index], upper[index]) + symmetric(*distance);
  }
  return result;
}

/// The eigenvalues of (a, b), where mirrored entries of a and of b are identical; see the header.
std::optional<DynamicIntervalMatrix> eigenvalues_through_vectors(const DynamicIntervalMatrix& a,
                                                                 const DynamicIntervalMatrix& b,
                                                                 const DynamicMatrix& vectors) {
  if (!vectors.allFinite()) {
    return std::nullopt;
  }
  const DynamicIntervalMatrix v = to_interval(vectors);
  const DynamicIntervalMatrix d_all = v.transpose() * (a * v).eval();
  const DynamicIntervalMatrix g_all = v.transpose() * (b * v).eval();
  const DynamicIntervalMatrix d = intersection(d_all, d_all.transpose());
  const DynamicIntervalMatrix g = intersection(g_all, g_all.transpose());
  if (!is_finite(d) || !is_finite(g)) {
    return std::nullopt;
  }
  const DynamicIntervalMatrix deviation = g - DynamicIntervalMatrix::Identity(a.rows(), a.cols());
  const std::optional<double> distance = norm_of_bounded_symmetric(magnitude(deviation));
  std::optional<DynamicIntervalMatrix> result = eigenvalues_near_diagonal(d);
  if (!distance || !(*distance < 1.0) || !result) {
    return std::nullopt;
  }
  const Interval theta = Interval(1.0) / (Interval(1.0) + symmetric(*distance));
  for (Eigen::Index i = 0; i < result->size(); ++i) {
    (*result)(i) *= theta;
  }
  return is_finite(*result) ? result : std::nullopt;
}

}  // namespace

std::optional<DynamicIntervalMatrix> generalized_eigenvalues(const DynamicIntervalMatrix& a,
                                                             const DynamicIntervalMatrix& b) {
  require_square(a, a.rows());
  require_square(b, a.rows());
  const DynamicIntervalMatrix a_symmetric = intersection(a, a.transpose());
  const DynamicIntervalMatrix b_symmetric = intersection(b, b.transpose());
  if (!is_finite(a_symmetric) || !is_finite(b_symmetric)) {
    return std::nullopt;
  }
  const DynamicMatrix vectors = [&]() -> DynamicMatrix {
    const NearestRounding nearest;
    return pencil_eigenvectors(midpoint(a_symmetric), midpoint(b_symmetric));
  }();
  return eigenvalues_through_vectors(a_symmetric, b_symmetric, vectors);
}

std::optional<DynamicIntervalMatrix> symmetric_eigenvalues(const DynamicIntervalMatrix& a) {
  require_square(a, a.rows());
  const DynamicIntervalMatrix members = intersection(a, a.transpose());
  if (!is_finite(members)) {
    return std::nullopt;
  }
  const DynamicMatrix middle = midpoint(members);
  const DynamicMatrix vectors = [&]() -> DynamicMatrix {
    const NearestRounding nearest;
    return symmetric_eigenvectors(middle);
  }();
  const DynamicIntervalMatrix identity = DynamicIntervalMatrix::Identity(a.rows(), a.cols());
  std::optional<DynamicIntervalMatrix> direct = eigenvalues_through_vectors(members, identity, vectors);
  const DynamicMatrix radii = radius_around(members, middle);
  if (radii.maxCoeff() == 0.0) {
    return direct;
  }
  const std::optional<DynamicIntervalMatrix> central =
      eigenvalues_through_vectors(to_interval(middle), identity, vectors);
  const std::optional<double> perturbation = norm_of_bounded_symmetric(radii);
  if (!central || !perturbation) {
    return direct;
  }
  const DynamicIntervalMatrix around =
      central->unaryExpr([&](const Interval& value) { return value + symmetric(*perturbation); });
  const DynamicIntervalMatrix result = direct ? intersection(*direct, around) : around;
  return is_finite(result) ? std::optional(result) : std::nullopt;
}

}  // namespace veritrack::rigor::detail

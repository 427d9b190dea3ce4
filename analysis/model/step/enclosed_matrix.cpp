#include "analysis/model/step/enclosed_matrix.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using rigor::DynamicIntervalMatrix;
using rigor::Interval;

/// Products are computed in doubles: an entry is a sum of at most k products, each operation off by at most
/// 2^-52 of its result in whichever rounding mode, so that the entries are off by at most k 2^-51 times the
/// sum of the absolute values, and the matrix by that times the Frobenius norms of both factors. The
/// constants are generous.
constexpr double kUnit = kUnitOfProducts;
constexpr double kTiny = 0x1p-960;

}  // namespace

double frobenius(const Eigen::MatrixXd& matrix) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    sum += matrix(i) * matrix(i);
  }
  return std::sqrt(sum) + kTiny;
}

EnclosedMatrix enclosed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double terms = static_cast<double>(a.cols()) + 4.0;
  return {a * b.transpose(), terms * kUnit * frobenius(a) * frobenius(b) + kTiny};
}

void add_multiple(EnclosedMatrix& sum, const EnclosedMatrix& matrix, const Interval& factor) {
  const double middle = rigor::midpoint(factor);
  const double width = (factor - Interval(middle)).upper() - (factor - Interval(middle)).lower();
  const double size = frobenius(matrix.middle);
  sum.error += factor.upper() * matrix.error + (width + kUnit * factor.upper()) * size +
               kUnit * frobenius(sum.middle) + kTiny;
  sum.middle += middle * matrix.middle;
}

double norm_of_symmetric(const EnclosedMatrix& matrix) {
  const double size = frobenius(matrix.middle);
  if (!std::isfinite(size) || !std::isfinite(matrix.error)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (!(size > kTiny)) {
    return size + matrix.error;
  }
  // Scaled by a power of two, so that nothing overflows.
  const int exponent = std::ilogb(size);
  const Eigen::MatrixXd scaled = matrix.middle * std::ldexp(1.0, -exponent);
  const EnclosedMatrix squared = enclosed_product(scaled, scaled);  // symmetric: G G' = G^2
  const EnclosedMatrix fourth = enclosed_product(squared.middle, squared.middle);
  // |G^4 - S S'| <= 2 |S| e + e^2 for G^2 = S up to e.
  const double error = fourth.error + (2.0 * frobenius(squared.middle) + squared.error) * squared.error;
  const Interval root = sqrt(sqrt(Interval(frobenius(fourth.middle) + error)));
  const double underflow = kTiny;  // of the scaling
  return std::min(size, (root * Interval(std::ldexp(1.0, exponent))).upper() + underflow) + matrix.error;
}

double largest_eigenvalue(const EnclosedMatrix& matrix) {
  const double size = frobenius(matrix.middle);
  if (!std::isfinite(size) || !std::isfinite(matrix.error)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Exactly symmetric, so that the verified matrix is the intended one.
  const Eigen::MatrixXd symmetric = matrix.middle.selfadjointView<Eigen::Lower>();
  const double asymmetry = frobenius(symmetric - matrix.middle) + kUnit * size;
  const double proposal = rigor::largest_eigenvalue(symmetric);
  for (double room = 1e-10; room < 1e-2; room *= 100.0) {
    const double bound = proposal + room * size;
    DynamicIntervalMatrix below = (-symmetric).cast<Interval>();
    for (Eigen::Index i = 0; i < below.rows(); ++i) {
      below(i, i) = Interval(bound) + below(i, i);
    }
    if (bound > 0.0 && rigor::is_positive_definite(below) == rigor::Verdict::proved) {
      return bound + asymmetry + matrix.error;
    }
  }
  return size + matrix.error;
}

}  // namespace veritrack::model

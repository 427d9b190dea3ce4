#include "analysis/rigor/norms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::rigor::detail {

namespace {

constexpr int kPowerSteps = 16;
constexpr double kWorthwhileGain = 1e-6;  // relative

/// matrix * vector, rounded up; all entries non-negative.
Eigen::VectorXd multiply_up(const DynamicMatrix& matrix, const Eigen::VectorXd& vector) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(matrix.rows());
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      result[row] = add_up(result[row], mul_up(matrix(row, column), vector[column]));
    }
  }
  return result;
}

/// The least of max_i (M w)_i / w_i over some positive w, for a non-negative linear map M given by its
/// upper-rounded action. NaN when something is not finite.
template <typename Action>
double collatz_wielandt(const Action& action, Eigen::Index size) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(size);
  double best = std::numeric_limits<double>::quiet_NaN();
  for (int step = 0; step < kPowerSteps; ++step) {
    const Eigen::VectorXd image = action(weights);
    double ratio = 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      const double quotient = div_up(image[i], weights[i]);
      if (!std::isfinite(quotient)) {
        return best;
      }
      ratio = std::max(ratio, quotient);
    }
    const bool gained = !(ratio >= best * (1.0 - kWorthwhileGain));  // also when there is no best yet
    best = std::isnan(best) ? ratio : std::min(best, ratio);
    if (!gained || best == 0.0) {
      return best;
    }
    // Any positive weights are valid. The shift damps oscillation; the floor keeps the weights positive.
    const Eigen::VectorXd next = image + 0.25 * best * weights;
    const double largest = next.maxCoeff();
    for (Eigen::Index i = 0; i < size; ++i) {
      weights[i] = std::max(next[i] / largest, 1e-20);
    }
    if (!weights.allFinite()) {
      return best;
    }
  }
  return best;
}

bool all_finite_and_non_negative(const DynamicMatrix& matrix) {
  return matrix.size() > 0 && matrix.allFinite() && matrix.minCoeff() >= 0.0;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// Approximate right singular vectors, columns, the one of the largest singular value last.
DynamicMatrix propose_singular_vectors(const DynamicIntervalMatrix& a) {
  const NearestRounding nearest;
  const DynamicMatrix middle = midpoint(a);
  return symmetric_eigenvectors(middle.transpose() * middle);
}

/// |A v| / |v| for a non-zero point vector v.
Interval stretch(const DynamicIntervalMatrix& a, const DynamicIntervalMatrix& v) {
  const DynamicIntervalMatrix image = a * v;
  Interval image_square(0.0);
  for (Eigen::Index i = 0; i < image.size(); ++i) {
    image_square += square(image(i));
  }
  Interval vector_square(0.0);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    vector_square += square(v(i));
  }
  return sqrt(image_square / vector_square);
}

Interval norm_of_scaled(const DynamicIntervalMatrix& a) {
  double upper = std::numeric_limits<double>::infinity();
  const auto propose_upper = [&upper](const std::optional<double>& bound) {
    if (bound) {
      upper = std::min(upper, *bound);
    }
  };
  propose_upper(norm_of_bounded(magnitude(a)));
  double lower = 0.0;
  const DynamicMatrix vectors = propose_singular_vectors(a);
  if (vectors.allFinite()) {
    const DynamicIntervalMatrix v = to_interval(vectors);
    propose_upper(norm_through_vectors(a, v));
    const DynamicMatrix middle = midpoint(a);
    const DynamicMatrix radii = radius_around(a, middle);
    if (radii.maxCoeff() > 0.0) {
      const std::optional<double> central = norm_through_vectors(to_interval(middle), v);
      const std::optional<double> perturbation = norm_of_bounded(radii);
      if (central && perturbation) {
        propose_upper(finite(add_up(*central, *perturbation)));
      }
    }
    const Interval ratio = stretch(a, v.rightCols(1));
    if (is_finite(ratio)) {
      lower = std::max(lower, ratio.lower());
    }
  }
  return std::isfinite(upper) ? Interval::from_bounds(lower, upper) : Interval::empty();
}

}  // namespace

std::optional<double> norm_through_vectors(const DynamicIntervalMatrix& a, const DynamicIntervalMatrix& v) {
  const DynamicIntervalMatrix identity = DynamicIntervalMatrix::Identity(a.cols(), a.cols());
  const DynamicIntervalMatrix w = a * v;
  const DynamicIntervalMatrix deviation = v.transpose() * v - identity;
  const DynamicIntervalMatrix gram = w.transpose() * w;
  const std::optional<double> distance = norm_of_bounded_symmetric(magnitude(deviation));
  const std::optional<double> square = norm_of_bounded_symmetric(magnitude(gram));
  if (!distance || !square || !(*distance < 1.0)) {
    return std::nullopt;
  }
  return finite(sqrt_up(div_up(*square, sub_down(1.0, *distance))));
}

std::optional<double> norm_of_bounded(const DynamicMatrix& bounds) {
  if (!all_finite_and_non_negative(bounds)) {
    return std::nullopt;
  }
  const auto action = [&bounds](const Eigen::VectorXd& w) -> Eigen::VectorXd {
    return multiply_up(bounds.transpose(), multiply_up(bounds, w));
  };
  const double square = collatz_wielandt(action, bounds.cols());
  return std::isfinite(square) ? finite(sqrt_up(square)) : std::nullopt;
}

std::optional<double> norm_of_bounded_symmetric(const DynamicMatrix& bounds) {
  if (bounds.rows() != bounds.cols() || !all_finite_and_non_negative(bounds)) {
    return std::nullopt;
  }
  const auto action = [&bounds](const Eigen::VectorXd& w) -> Eigen::VectorXd {
    return multiply_up(bounds, w);
  };
  return finite(collatz_wielandt(action, bounds.cols()));
}

Interval spectral_norm(const DynamicIntervalMatrix& a) {
  if (!is_finite(a)) {
    return Interval::empty();
  }
  const DynamicMatrix sizes = magnitude(a);
  const double largest = sizes.maxCoeff();
  if (largest == 0.0) {
    return Interval(0.0);
  }
  // Squares must neither overflow nor underflow: bring the largest entry near 1. A tall matrix has the
  // smaller Gram matrix.
  const int exponent = std::clamp(std::ilogb(largest), -1000, 1000);
  const Interval scale(std::ldexp(1.0, -exponent));
  const DynamicIntervalMatrix tall = a.rows() >= a.cols() ? a : DynamicIntervalMatrix(a.transpose());
  const DynamicIntervalMatrix scaled = tall.unaryExpr([&](const Interval& entry) { return entry * scale; });
  return norm_of_scaled(scaled) * Interval(std::ldexp(1.0, exponent));
}

}  // namespace veritrack::rigor::detail

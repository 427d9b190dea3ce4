#include "analysis/model/map_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "analysis/model/disturbance_split.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::BallMonomials;
using rigor::DynamicIntervalMatrix;
using rigor::Interval;

/// The coefficients of a class, a row for each component of the vector.
Eigen::MatrixXd coefficients_of(const std::vector<BallModel>& vector, const BallMonomials::Class& here) {
  const auto columns = static_cast<Eigen::Index>(here.last - here.first);
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(vector.size()), columns);
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < columns; ++column) {
      matrix(row, column) =
          vector[static_cast<std::size_t>(row)].coefficients()[here.first + static_cast<std::size_t>(column)];
    }
  }
  return matrix;
}

/// A B' with the weights of the columns.
DynamicIntervalMatrix product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const double* weights) {
  DynamicIntervalMatrix result(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < b.rows(); ++j) {
      Interval sum(0.0);
      for (Eigen::Index k = 0; k < a.cols(); ++k) {
        const Interval weight(weights != nullptr ? weights[k] : 1.0);
        sum = sum + Interval(a(i, k)) * Interval(b(j, k)) * weight;
      }
      result(i, j) = sum;
    }
  }
  return result;
}

/// An upper bound of the square of the Frobenius norm.
double square_of_frobenius(const DynamicIntervalMatrix& matrix) {
  Interval sum(0.0);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    sum = sum + square(matrix(i));
  }
  return sum.upper();
}

/// An upper bound of the largest absolute eigenvalue of a symmetric matrix: |G| <= |G^4|_F^(1/4).
double norm_of_symmetric(const DynamicIntervalMatrix& matrix) {
  // Scaled by a power of two, so that nothing overflows.
  const double size = std::sqrt(square_of_frobenius(matrix));
  if (!(size > 0.0) || !std::isfinite(size)) {
    return size;
  }
  const int exponent = std::ilogb(size);
  const DynamicIntervalMatrix scaled =
      matrix.unaryExpr([&](const Interval& x) { return x * Interval(std::ldexp(1.0, -exponent)); });
  const DynamicIntervalMatrix squared = scaled * scaled;
  const DynamicIntervalMatrix fourth = squared * squared;
  const Interval root = sqrt(sqrt(sqrt(Interval(square_of_frobenius(fourth)))));
  return std::min(size, (root * Interval(std::ldexp(1.0, exponent))).upper());
}

/// An upper bound of the largest eigenvalue of a symmetric matrix, proposed in floating point and verified.
double largest_eigenvalue(const DynamicIntervalMatrix& matrix) {
  const Eigen::MatrixXd middle = rigor::midpoint(matrix);
  if (!middle.allFinite()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double proposal =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(middle, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  const double size = std::sqrt(square_of_frobenius(matrix));
  for (double room = 1e-10; room < 1e-2; room *= 100.0) {
    const double bound = proposal + room * size;
    DynamicIntervalMatrix below = -matrix;
    for (Eigen::Index i = 0; i < below.rows(); ++i) {
      below(i, i) = Interval(bound) + below(i, i);
    }
    if (bound > 0.0 && rigor::is_positive_definite(below) == rigor::Verdict::proved) {
      return bound;
    }
  }
  return size;
}

/// The parts of degree 1 in x, or in v, as polynomials in s and z: exponents of s and z, and the matrix.
using LinearPart = std::map<std::pair<int, int>, Eigen::MatrixXd>;

/// P(s, z) P(s, z)' by exponents of s and z.
std::map<std::pair<int, int>, DynamicIntervalMatrix> gram(const LinearPart& part) {
  std::map<std::pair<int, int>, DynamicIntervalMatrix> result;
  for (const auto& [a, first] : part) {
    for (const auto& [b, second] : part) {
      const DynamicIntervalMatrix term = product(first, second, nullptr);
      const auto [place, is_new] = result.try_emplace({a.first + b.first, a.second + b.second}, term);
      if (!is_new) {
        place->second += term;
      }
    }
  }
  return result;
}

/// A part, and what its Gram matrix is multiplied by.
struct WeightedPart {
  const LinearPart* part = nullptr;
  Interval factor;
};

/// An upper bound of the largest eigenvalue of the weighted sum of the Gram matrices, all s and z.
double joint_bound(const std::vector<WeightedPart>& parts) {
  std::map<std::pair<int, int>, DynamicIntervalMatrix> sum;
  for (const WeightedPart& weighted : parts) {
    if (!rigor::certainly_positive(weighted.factor)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    for (const auto& [exponents, matrix] : gram(*weighted.part)) {
      const DynamicIntervalMatrix scaled =
          matrix.unaryExpr([&](const Interval& x) { return x * weighted.factor; });
      const auto [place, is_new] = sum.try_emplace(exponents, scaled);
      if (!is_new) {
        place->second += scaled;
      }
    }
  }
  Interval total(0.0);
  for (const auto& [exponents, matrix] : sum) {
    const bool is_constant = exponents == std::pair(0, 0);
    total = total + Interval(is_constant ? largest_eigenvalue(matrix) : norm_of_symmetric(matrix));
  }
  return total.upper();
}

/// P P' at s = z = 0, in floating point; no rows when there is nothing.
Eigen::MatrixXd gram_at_middle(const LinearPart& part) {
  const auto found = part.find({0, 0});
  return found != part.end() && found->second.allFinite()
             ? Eigen::MatrixXd(found->second * found->second.transpose())
             : Eigen::MatrixXd();
}

/// An upper bound of the square of |of_x x + of_v v + of_w w|; |v|^2 and |w|^2 are at most `half` (1/2) when
/// both are there, 1 otherwise.
double square_of_linear_part(const LinearPart& of_x, const LinearPart& of_v, const LinearPart& of_w,
                             double scale, double squared_radius) {
  const Eigen::MatrixXd x = gram_at_middle(of_x) * scale * scale;
  const Interval squared_scale = square(Interval(scale));
  if (!of_v.empty() && !of_w.empty()) {
    const std::array<double, 3> shares =
        proposed_shares(x, gram_at_middle(of_v) * squared_radius, gram_at_middle(of_w) * squared_radius);
    // For any positive weights (a + b + c)^2 <= (t1 + t2 + t3) (a^2/t1 + b^2/t2 + c^2/t3).
    const Interval sum = Interval(shares[0]) + Interval(shares[1]) + Interval(shares[2]);
    return joint_bound({{&of_x, squared_scale * sum / Interval(shares[0])},
                        {&of_v, Interval(squared_radius) * sum / Interval(shares[1])},
                        {&of_w, Interval(squared_radius) * sum / Interval(shares[2])}});
  }
  const LinearPart& other = of_v.empty() ? of_w : of_v;
  const double t = proposed_split(x, gram_at_middle(other) * squared_radius);
  return joint_bound({{&of_x, squared_scale / Interval(t)},
                      {&other, Interval(squared_radius) / (Interval(1.0) - Interval(t))}});
}

}  // namespace

double length_bound(const std::vector<BallModel>& vector, double scale, bool last_alone) {
  const BallMonomials& monomials = vector.front().monomials();
  LinearPart of_x;
  LinearPart of_v;
  LinearPart of_w;  // the last disturbance, when it is bounded by itself
  Interval total(0.0);
  for (const BallMonomials::Class& here : monomials.classes()) {
    const Eigen::MatrixXd matrix = coefficients_of(vector, here);
    if (matrix.isZero(0.0)) {
      continue;
    }
    if (here.ball + here.disturbance == 1) {
      if (here.ball == 1) {
        of_x[{here.s, here.z}] = matrix;
        continue;
      }
      const Eigen::Index together = last_alone ? matrix.cols() - 1 : matrix.cols();
      if (!matrix.leftCols(together).isZero(0.0)) {
        of_v[{here.s, here.z}] = matrix.leftCols(together);
      }
      if (last_alone && !matrix.rightCols(1).isZero(0.0)) {
        of_w[{here.s, here.z}] = matrix.rightCols(1);
      }
      continue;
    }
    const double norm =
        std::sqrt(norm_of_symmetric(product(matrix, matrix, monomials.weights().data() + here.first)));
    total = total + Interval(norm) * pow(Interval(scale), here.ball);
  }
  if (of_v.empty() && of_w.empty()) {
    // t = 1: nothing is shared.
    double bound = 0.0;
    for (const auto& [exponents, matrix] : gram(of_x)) {
      bound += exponents == std::pair(0, 0) ? largest_eigenvalue(matrix) : norm_of_symmetric(matrix);
    }
    total = total + Interval(std::sqrt(bound)) * Interval(scale);
  } else {
    const double squared_radius = last_alone ? 0.5 : 1.0;
    total = total + Interval(std::sqrt(square_of_linear_part(of_x, of_v, of_w, scale, squared_radius)));
  }
  Interval square_of_errors(0.0);
  for (const BallModel& component : vector) {
    const double error = component.error();
    if (!std::isfinite(error)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    square_of_errors = square_of_errors + square(Interval(error));
  }
  const double bound = (total + sqrt(square_of_errors)).upper();
  return rigor::is_finite(total) ? bound : std::numeric_limits<double>::quiet_NaN();
}

WidthShares width_shares(const std::vector<BallModel>& vector) {
  WidthShares shares;
  const auto& classes = vector.front().monomials().classes();
  for (const BallModel& component : vector) {
    for (std::size_t number = 0; number < classes.size(); ++number) {
      shares.by_phase += classes[number].s > 0 ? component.norm(number) : 0.0;
      shares.by_frequency += classes[number].z > 0 ? component.norm(number) : 0.0;
    }
  }
  return shares;
}

}  // namespace veritrack::model

#include "analysis/model/map_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

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

/// An upper bound of the largest eigenvalue of of_x scale^2/t + of_v/(1 - t), all s and z.
double joint_bound(const LinearPart& of_x, const LinearPart& of_v, double scale, double t) {
  std::map<std::pair<int, int>, DynamicIntervalMatrix> sum;
  const auto add = [&](const LinearPart& part, const Interval& factor) {
    for (const auto& [exponents, matrix] : gram(part)) {
      const DynamicIntervalMatrix scaled = matrix.unaryExpr([&](const Interval& x) { return x * factor; });
      const auto [place, is_new] = sum.try_emplace(exponents, scaled);
      if (!is_new) {
        place->second += scaled;
      }
    }
  };
  add(of_x, square(Interval(scale)) / Interval(t));
  add(of_v, Interval(1.0) / (Interval(1.0) - Interval(t)));
  Interval total(0.0);
  for (const auto& [exponents, matrix] : sum) {
    const bool is_constant = exponents == std::pair(0, 0);
    total = total + Interval(is_constant ? largest_eigenvalue(matrix) : norm_of_symmetric(matrix));
  }
  return total.upper();
}

/// The t that splits best at s = z = 0, in floating point.
double proposed_split(const LinearPart& of_x, const LinearPart& of_v, double scale) {
  const auto at_middle = [](const LinearPart& part) -> Eigen::MatrixXd {
    const auto found = part.find({0, 0});
    return found != part.end() ? Eigen::MatrixXd(found->second * found->second.transpose())
                               : Eigen::MatrixXd();
  };
  const Eigen::MatrixXd x = at_middle(of_x) * scale * scale;
  const Eigen::MatrixXd v = at_middle(of_v);
  if (v.size() == 0 || x.size() == 0 || !x.allFinite() || !v.allFinite()) {
    return 0.5;
  }
  const auto value = [&](double logit) {
    const double t = 1.0 / (1.0 + std::exp(-logit));
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(x / t + v / (1.0 - t), Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
  };
  // Convex in t, so one valley in the logit, which reaches both ends: slow trackers need t close to 1.
  double low = -20.0;
  double high = 20.0;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    if (value(first) < value(second)) {
      high = second;
    } else {
      low = first;
    }
  }
  return 1.0 / (1.0 + std::exp(-(low + high) / 2.0));
}

}  // namespace

double length_bound(const std::vector<BallModel>& vector, double scale) {
  const BallMonomials& monomials = vector.front().monomials();
  LinearPart of_x;
  LinearPart of_v;
  Interval total(0.0);
  for (const BallMonomials::Class& here : monomials.classes()) {
    const Eigen::MatrixXd matrix = coefficients_of(vector, here);
    if (matrix.isZero(0.0)) {
      continue;
    }
    if (here.ball + here.disturbance == 1) {
      (here.ball == 1 ? of_x : of_v)[{here.s, here.z}] = matrix;
      continue;
    }
    const double norm =
        std::sqrt(norm_of_symmetric(product(matrix, matrix, monomials.weights().data() + here.first)));
    total = total + Interval(norm) * pow(Interval(scale), here.ball);
  }
  if (of_v.empty()) {
    // t = 1: nothing is shared.
    double bound = 0.0;
    for (const auto& [exponents, matrix] : gram(of_x)) {
      bound += exponents == std::pair(0, 0) ? largest_eigenvalue(matrix) : norm_of_symmetric(matrix);
    }
    total = total + Interval(std::sqrt(bound)) * Interval(scale);
  } else {
    total = total + Interval(std::sqrt(joint_bound(of_x, of_v, scale, proposed_split(of_x, of_v, scale))));
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

}  // namespace veritrack::model

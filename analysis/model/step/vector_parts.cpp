#include "analysis/model/step/vector_parts.hpp"

#include <cmath>
#include <limits>

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::BallMonomials;
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

/// The parts of degree 1 in x, or in v, as polynomials in s and z: exponents of s and z, and the matrix.
using LinearPart = std::map<std::pair<int, int>, Eigen::MatrixXd>;

Gram gram(const LinearPart& part) {
  Gram result;
  for (const auto& [a, first] : part) {
    for (const auto& [b, second] : part) {
      const EnclosedMatrix term = enclosed_product(first, second);
      const auto [place, is_new] = result.try_emplace({a.first + b.first, a.second + b.second}, term);
      if (!is_new) {
        add_multiple(place->second, term, Interval(1.0));
      }
    }
  }
  return result;
}

/// The norm of a class as a matrix, its columns weighted as in Bombieri's norm.
double norm_of_class(Eigen::MatrixXd matrix, const double* weights) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    matrix.col(column) *= std::sqrt(weights[column]);
  }
  // Rounded twice an entry: at most that much of the Frobenius norm.
  const double size = frobenius(matrix);
  return std::sqrt(norm_of_symmetric(enclosed_product(matrix, matrix))) + kUnitOfProducts * size;
}

}  // namespace

double joint_bound(const std::vector<WeightedGram>& parts) {
  Gram sum;
  for (const WeightedGram& weighted : parts) {
    if (!rigor::certainly_positive(weighted.factor)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    for (const auto& [exponents, matrix] : *weighted.gram) {
      const EnclosedMatrix zero{Eigen::MatrixXd::Zero(matrix.middle.rows(), matrix.middle.cols()), 0.0};
      add_multiple(sum.try_emplace(exponents, zero).first->second, matrix, weighted.factor);
    }
  }
  Interval total(0.0);
  for (const auto& [exponents, matrix] : sum) {
    const bool is_constant = exponents == std::pair(0, 0);
    total = total + Interval(is_constant ? largest_eigenvalue(matrix) : norm_of_symmetric(matrix));
  }
  return total.upper();
}

Eigen::MatrixXd at_middle(const Gram& gram) {
  const auto found = gram.find({0, 0});
  return found != gram.end() && found->second.middle.allFinite() ? found->second.middle : Eigen::MatrixXd();
}

VectorParts::VectorParts(const std::vector<BallModel>& vector, bool last_alone) {
  const BallMonomials& monomials = vector.front().monomials();
  for (auto& row : norms) {
    row.fill(Interval(0.0));
  }
  LinearPart linear_in_x;
  LinearPart linear_in_v;
  LinearPart linear_in_w;
  for (const BallMonomials::Class& here : monomials.classes()) {
    const Eigen::MatrixXd matrix = coefficients_of(vector, here);
    if (matrix.isZero(0.0)) {
      continue;
    }
    if (here.ball + here.disturbance != 1) {
      Interval& sum =
          norms.at(static_cast<std::size_t>(here.ball)).at(static_cast<std::size_t>(here.disturbance));
      sum = sum + Interval(norm_of_class(matrix, monomials.weights().data() + here.first));
      continue;
    }
    if (here.ball == 1) {
      linear_in_x[{here.s, here.z}] = matrix;
      continue;
    }
    const Eigen::Index together = last_alone ? matrix.cols() - 1 : matrix.cols();
    if (!matrix.leftCols(together).isZero(0.0)) {
      linear_in_v[{here.s, here.z}] = matrix.leftCols(together);
    }
    if (last_alone && !matrix.rightCols(1).isZero(0.0)) {
      linear_in_w[{here.s, here.z}] = matrix.rightCols(1);
    }
  }
  of_x = gram(linear_in_x);
  of_v = gram(linear_in_v);
  of_w = gram(linear_in_w);
  Interval square_of_errors(0.0);
  for (const BallModel& component : vector) {
    const bool is_known = std::isfinite(component.error());
    square_of_errors = is_known ? square_of_errors + square(Interval(component.error())) : Interval::empty();
    if (!is_known) {
      break;
    }
  }
  error = rigor::is_finite(square_of_errors) ? sqrt(square_of_errors) : Interval::empty();
}

}  // namespace veritrack::model

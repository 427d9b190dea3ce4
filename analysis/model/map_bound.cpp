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

/// A matrix that is known up to an error: `middle`, and a bound of the Frobenius norm of the difference.
///
/// The products below are computed in doubles: an entry is a sum of at most k products, each operation off by
/// at most 2^-52 of its result in whichever rounding mode, so that the entries are off by at most k 2^-51
/// times the sum of the absolute values, and the matrix by that times the Frobenius norms of both factors.
/// The constants are generous.
struct EnclosedMatrix {
  Eigen::MatrixXd middle;
  double error = 0.0;
};

constexpr double kUnit = 0x1p-50;
constexpr double kTiny = 0x1p-960;

/// The Frobenius norm, rounded up: the rounding mode is held, and the sum is of squares.
double frobenius(const Eigen::MatrixXd& matrix) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    sum += matrix(i) * matrix(i);
  }
  return std::sqrt(sum) + kTiny;
}

/// A B', of exact matrices.
EnclosedMatrix product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double terms = static_cast<double>(a.cols()) + 4.0;
  return {a * b.transpose(), terms * kUnit * frobenius(a) * frobenius(b) + kTiny};
}

/// sum += factor matrix, for a positive factor.
void add_multiple(EnclosedMatrix& sum, const EnclosedMatrix& matrix, const Interval& factor) {
  const double middle = rigor::midpoint(factor);
  const double width = (factor - Interval(middle)).upper() - (factor - Interval(middle)).lower();
  const double size = frobenius(matrix.middle);
  sum.error += factor.upper() * matrix.error + (width + kUnit * factor.upper()) * size +
               kUnit * frobenius(sum.middle) + kTiny;
  sum.middle += middle * matrix.middle;
}

/// An upper bound of the largest absolute eigenvalue of a symmetric matrix: |G| <= |G^4|_F^(1/4).
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
  const EnclosedMatrix squared = product(scaled, scaled);  // symmetric: G G' = G^2
  const EnclosedMatrix fourth = product(squared.middle, squared.middle);
  // |G^4 - S S'| <= 2 |S| e + e^2 for G^2 = S up to e.
  const double error = fourth.error + (2.0 * frobenius(squared.middle) + squared.error) * squared.error;
  const Interval root = sqrt(sqrt(Interval(frobenius(fourth.middle) + error)));
  const double underflow = kTiny;  // of the scaling
  return std::min(size, (root * Interval(std::ldexp(1.0, exponent))).upper() + underflow) + matrix.error;
}

/// An upper bound of the largest eigenvalue of a symmetric matrix, proposed in floating point and verified.
double largest_eigenvalue(const EnclosedMatrix& matrix) {
  const double size = frobenius(matrix.middle);
  if (!std::isfinite(size) || !std::isfinite(matrix.error)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Exactly symmetric, so that what is verified is what is meant.
  const Eigen::MatrixXd symmetric = matrix.middle.selfadjointView<Eigen::Lower>();
  const double asymmetry = frobenius(symmetric - matrix.middle) + kUnit * size;
  const double proposal = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
                              .eigenvalues()
                              .maxCoeff();
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

/// The parts of degree 1 in x, or in v, as polynomials in s and z: exponents of s and z, and the matrix.
using LinearPart = std::map<std::pair<int, int>, Eigen::MatrixXd>;

/// P(s, z) P(s, z)' by exponents of s and z.
using Gram = std::map<std::pair<int, int>, EnclosedMatrix>;

Gram gram(const LinearPart& part) {
  Gram result;
  for (const auto& [a, first] : part) {
    for (const auto& [b, second] : part) {
      const EnclosedMatrix term = product(first, second);
      const auto [place, is_new] = result.try_emplace({a.first + b.first, a.second + b.second}, term);
      if (!is_new) {
        add_multiple(place->second, term, Interval(1.0));
      }
    }
  }
  return result;
}

/// A Gram matrix, and what it is multiplied by.
struct WeightedGram {
  const Gram* gram = nullptr;
  Interval factor;
};

/// An upper bound of the largest eigenvalue of the weighted sum of the Gram matrices, all s and z.
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

/// P P' at s = z = 0, in floating point; no rows when there is nothing.
Eigen::MatrixXd at_middle(const Gram& gram) {
  const auto found = gram.find({0, 0});
  return found != gram.end() && found->second.middle.allFinite() ? found->second.middle : Eigen::MatrixXd();
}

/// What a vector of models is made of, whatever the scale: bounds of its classes, and the linear parts.
struct Anatomy {
  Gram of_x;
  Gram of_v;
  Gram of_w;                    ///< of the last disturbance, when it is bounded by itself
  std::vector<Interval> norms;  ///< of the other classes, by their degree in x
  Interval error;               ///< the length of the vector of errors
};

/// An upper bound of the square of |of_x x + of_v v + of_w w| for |x| <= scale; |v|^2 and |w|^2 are at most
/// `squared_radius`: 1/2 when both are there, 1 otherwise.
double square_of_linear_part(const Anatomy& parts, double scale, double squared_radius) {
  const Eigen::MatrixXd x = at_middle(parts.of_x) * scale * scale;
  const Interval squared_scale = square(Interval(scale));
  if (parts.of_v.empty() && parts.of_w.empty()) {
    return joint_bound({{&parts.of_x, squared_scale}});  // t = 1: nothing is shared
  }
  if (!parts.of_v.empty() && !parts.of_w.empty()) {
    const std::array<double, 3> shares =
        proposed_shares(x, at_middle(parts.of_v) * squared_radius, at_middle(parts.of_w) * squared_radius);
    // For any positive weights (a + b + c)^2 <= (t1 + t2 + t3) (a^2/t1 + b^2/t2 + c^2/t3).
    const Interval sum = Interval(shares[0]) + Interval(shares[1]) + Interval(shares[2]);
    return joint_bound({{&parts.of_x, squared_scale * sum / Interval(shares[0])},
                        {&parts.of_v, Interval(squared_radius) * sum / Interval(shares[1])},
                        {&parts.of_w, Interval(squared_radius) * sum / Interval(shares[2])}});
  }
  const Gram& other = parts.of_v.empty() ? parts.of_w : parts.of_v;
  const double t = proposed_split(x, at_middle(other) * squared_radius);
  return joint_bound({{&parts.of_x, squared_scale / Interval(t)},
                      {&other, Interval(squared_radius) / (Interval(1.0) - Interval(t))}});
}

/// The norm of a class as a matrix, its columns weighted as in Bombieri's norm.
double norm_of_class(Eigen::MatrixXd matrix, const double* weights) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    matrix.col(column) *= std::sqrt(weights[column]);
  }
  // Rounded twice an entry: at most that much of the Frobenius norm.
  const double size = frobenius(matrix);
  return std::sqrt(norm_of_symmetric(product(matrix, matrix))) + kUnit * size;
}

Anatomy anatomy_of(const std::vector<BallModel>& vector, bool last_alone) {
  const BallMonomials& monomials = vector.front().monomials();
  Anatomy parts;
  parts.norms.assign(BallMonomials::kMostOfVectors + 1, Interval(0.0));
  LinearPart of_x;
  LinearPart of_v;
  LinearPart of_w;
  for (const BallMonomials::Class& here : monomials.classes()) {
    const Eigen::MatrixXd matrix = coefficients_of(vector, here);
    if (matrix.isZero(0.0)) {
      continue;
    }
    if (here.ball + here.disturbance != 1) {
      Interval& sum = parts.norms[static_cast<std::size_t>(here.ball)];
      sum = sum + Interval(norm_of_class(matrix, monomials.weights().data() + here.first));
      continue;
    }
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
  }
  parts.of_x = gram(of_x);
  parts.of_v = gram(of_v);
  parts.of_w = gram(of_w);
  Interval square_of_errors(0.0);
  for (const BallModel& component : vector) {
    const bool is_known = std::isfinite(component.error());
    square_of_errors = is_known ? square_of_errors + square(Interval(component.error())) : Interval::empty();
    if (!is_known) {
      break;
    }
  }
  parts.error = rigor::is_finite(square_of_errors) ? sqrt(square_of_errors) : Interval::empty();
  return parts;
}

}  // namespace

std::vector<double> length_bounds(const std::vector<BallModel>& vector, const std::vector<double>& scales,
                                  bool last_alone) {
  constexpr double kNothingKnown = std::numeric_limits<double>::quiet_NaN();
  const Anatomy parts = anatomy_of(vector, last_alone);
  std::vector<double> bounds;
  bounds.reserve(scales.size());
  for (const double scale : scales) {
    Interval total = parts.error;
    for (std::size_t degree = 0; degree < parts.norms.size(); ++degree) {
      total = total + parts.norms[degree] * pow(Interval(scale), static_cast<int>(degree));
    }
    const double linear = square_of_linear_part(parts, scale, last_alone ? 0.5 : 1.0);
    if (!std::isfinite(linear) || !rigor::is_finite(total)) {
      bounds.push_back(kNothingKnown);
      continue;
    }
    bounds.push_back((total + sqrt(Interval::from_bounds(0.0, linear))).upper());
  }
  return bounds;
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

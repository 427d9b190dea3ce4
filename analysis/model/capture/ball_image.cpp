#include "analysis/model/capture/ball_image.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_definiteness.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

constexpr std::size_t kDimensions = SlopeMatrix::kMost;
constexpr double kUnknownLength = std::numeric_limits<double>::quiet_NaN();

using SmallDoubles = Eigen::Matrix<double, static_cast<int>(kDimensions), static_cast<int>(kDimensions)>;

/// The constant parts of the entries.
SmallDoubles constants_of(const SlopeMatrix& a) {
  SmallDoubles constants = SmallDoubles::Zero();
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t j = 0; j < a.columns; ++j) {
      constants(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = a(i, j).constant();
    }
  }
  return constants;
}

/// The lower triangle of a symmetric matrix of polynomials.
using GramMatrix = std::array<std::array<SlopeModel, kDimensions>, kDimensions>;

/// sum += factor A A'.
void add_gram(GramMatrix& sum, const SlopeMatrix& a, const Interval& factor) {
  const SlopeModel scale(factor);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      SlopeModel product(0.0);
      for (std::size_t k = 0; k < a.columns; ++k) {
        product += a(i, k) * a(j, k);
      }
      sum[i][j] += scale * product;
    }
  }
}

/// An upper bound of the norm of a symmetric matrix with |entries| at most these: the lesser one of two.
Interval symmetric_norm(const rigor::LowerTriangle<kDimensions>& sizes) {
  Interval squares(0.0);
  Interval most(0.0);
  for (std::size_t i = 0; i < kDimensions; ++i) {
    Interval row(0.0);
    for (std::size_t j = 0; j < kDimensions; ++j) {
      const Interval& entry = j <= i ? sizes[i][j] : sizes[j][i];
      squares += square(entry);
      row += entry;
    }
    most = rigor::max(most, row);
  }
  return rigor::min(most, sqrt(squares));
}

/// An upper bound of the contribution of all but the constant part to the largest eigenvalue.
Interval varying_part(const GramMatrix& gram) {
  Interval sum(0.0);
  rigor::LowerTriangle<kDimensions> sizes;
  for (std::size_t term = 1; term <= SlopeModel::kTerms; ++term) {
    for (std::size_t i = 0; i < kDimensions; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        // Last of all the remainders.
        sizes[i][j] = Interval(term < SlopeModel::kTerms ? std::fabs(gram[i][j].coefficients()[term])
                                                         : gram[i][j].remainder());
      }
    }
    sum += symmetric_norm(sizes);
  }
  return sum;
}

rigor::LowerTriangle<kDimensions> constant_part(const GramMatrix& gram) {
  rigor::LowerTriangle<kDimensions> constants;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      constants[i][j] = Interval(gram[i][j].constant());
    }
  }
  return constants;
}

/// A verified upper bound of the largest eigenvalue.
double largest_eigenvalue(const rigor::LowerTriangle<kDimensions>& matrix, double guess) {
  for (const double factor : {1.0 + 1e-9, 1.0 + 1e-6, 1.0 + 1e-3}) {
    const double bound = guess * factor;
    if (!(bound > 0.0) || !std::isfinite(bound)) {
      break;
    }
    rigor::LowerTriangle<kDimensions> rest = matrix;
    for (std::size_t i = 0; i < kDimensions; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        rest[i][j] = i == j ? Interval(bound) - matrix[i][j] : -matrix[i][j];
      }
    }
    if (rigor::certainly_positive_definite(rest)) {
      return bound;
    }
  }
  rigor::LowerTriangle<kDimensions> sizes = matrix;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      sizes[i][j] = abs(matrix[i][j]);
    }
  }
  return symmetric_norm(sizes).upper();
}

/// The largest eigenvalue and a t that makes it small, in floating point.
struct SplitGuess {
  double eigenvalue = 0.0;
  double t = 0.5;
};

SplitGuess split_guess(const SmallDoubles& a, double radius, const SmallDoubles& b, double noise) {
  const rigor::NearestRounding nearest;
  const SmallDoubles of_a = radius * radius * a * a.transpose();
  const SmallDoubles of_b = noise * noise * b * b.transpose();
  SplitGuess guess;
  if (!(radius > 0.0) || !(noise > 0.0)) {
    const SmallDoubles alone = radius > 0.0 ? of_a : of_b;
    guess.t = radius > 0.0 ? 1.0 : 0.0;
    guess.eigenvalue = rigor::largest_eigenvalue(alone);
    return guess;
  }
  guess.eigenvalue = std::numeric_limits<double>::infinity();
  double t = 0.5;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const SmallDoubles sum = of_a / t + of_b / (1.0 - t);
    const rigor::Eigensystem system = rigor::symmetric_eigensystem(sum);
    const double eigenvalue = system.values[static_cast<Eigen::Index>(kDimensions) - 1];
    if (eigenvalue < guess.eigenvalue) {
      guess = {eigenvalue, t};
    }
    // For a fixed direction p the best t is |A'p|/(|A'p| + |B'p|).
    const auto p = system.vectors.col(static_cast<Eigen::Index>(kDimensions) - 1);
    const double along_a = std::sqrt(std::max(p.dot(of_a * p), 0.0));
    const double along_b = std::sqrt(std::max(p.dot(of_b * p), 0.0));
    const double best = along_a / (along_a + along_b);
    if (!(best > 0.0 && best < 1.0)) {
      break;
    }
    t = std::min(std::max(0.5 * (t + best), 1e-6), 1.0 - 1e-6);
  }
  return guess;
}

}  // namespace

SlopeMatrix::SlopeMatrix(std::size_t row_count, std::size_t column_count)
    : rows(row_count), columns(column_count) {
  if (rows > kMost || columns > kMost) {
    throw std::invalid_argument("a small matrix has at most four rows and columns");
  }
  for (auto& row : entries) {
    row.fill(SlopeModel(0.0));
  }
}

SlopeMatrix operator*(const SlopeMatrix& a, const SlopeMatrix& b) {
  if (a.columns != b.rows) {
    throw std::invalid_argument("matrices whose sizes do not fit");
  }
  SlopeMatrix product(a.rows, b.columns);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t j = 0; j < b.columns; ++j) {
      for (std::size_t k = 0; k < a.columns; ++k) {
        product(i, j) += a(i, k) * b(k, j);
      }
    }
  }
  return product;
}

double ball_image(const SlopeMatrix& a, double radius, const SlopeMatrix& b, double noise) {
  const bool is_question = radius >= 0.0 && noise >= 0.0 && std::isfinite(radius) && std::isfinite(noise);
  if (!is_question || a.rows != b.rows) {
    return kUnknownLength;
  }
  if (!(radius > 0.0) && !(noise > 0.0)) {
    return 0.0;
  }
  // In units of the larger one, so that nothing underflows.
  const double unit = std::max(radius, noise);
  const Interval of_radius = Interval(radius) / Interval(unit);
  const Interval of_noise = Interval(noise) / Interval(unit);
  const SplitGuess guess = split_guess(constants_of(a), of_radius.upper(), constants_of(b), of_noise.upper());
  const Interval t(guess.t);
  GramMatrix gram;
  for (auto& row : gram) {
    row.fill(SlopeModel(0.0));
  }
  if (radius > 0.0) {
    add_gram(gram, a, square(of_radius) / t);
  }
  if (noise > 0.0) {
    add_gram(gram, b, square(of_noise) / (Interval(1.0) - t));
  }
  const Interval eigenvalue =
      Interval(largest_eigenvalue(constant_part(gram), guess.eigenvalue)) + varying_part(gram);
  const Interval length = Interval(unit) * sqrt(rigor::max(eigenvalue, Interval(0.0)));
  return rigor::is_finite(length) ? length.upper() : kUnknownLength;
}

}  // namespace veritrack::model

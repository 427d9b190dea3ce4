#include "checker/model/place_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "checker/model/symmetric_matrix.hpp"
#include "checker/numbers/matrix.hpp"

namespace veritrack::checker {

namespace {

bool is_nothing(const BallPolynomial& x) {
  return x.vector_degree() < 0 && x.known() && !(x.error() > 0.0);
}

double coefficient(const BallPolynomial& x, std::size_t place) {
  const std::span<const double> block = x.block(0, 0);
  return place < block.size() ? block[place] : 0.0;
}

/// The root of the sum of squares of the entries.
Ball length_of_matrix(const Matrix& matrix) {
  Ball squares;
  for (slong i = 0; i < matrix.rows(); ++i) {
    for (slong j = 0; j < matrix.columns(); ++j) {
      squares += square(matrix(i, j));
    }
  }
  return root_of_non_negative(squares);
}

}  // namespace

PlaceMatrix place_matrix(std::size_t rows, std::size_t columns) {
  return PlaceMatrix(rows, std::vector<BallPolynomial>(columns));
}

PlaceMatrix product(const PlaceMatrix& a, const PlaceMatrix& b) {
  PlaceMatrix result = place_matrix(a.size(), b.front().size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (is_nothing(a[i][k])) {
        continue;
      }
      for (std::size_t j = 0; j < b[k].size(); ++j) {
        result[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return result;
}

PlaceMatrix sum(const PlaceMatrix& a, const PlaceMatrix& b, const BallPolynomial& factor_of_b) {
  PlaceMatrix result = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      result[i][j] += factor_of_b * b[i][j];
    }
  }
  return result;
}

PlaceMatrix mirrored(const PlaceMatrix& a) {
  PlaceMatrix result = place_matrix(a.front().size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      result[j][i] = a[i][j];
    }
  }
  return result;
}

PlaceMatrix symmetric_of(const std::vector<BallPolynomial>& triangle, std::size_t rows) {
  PlaceMatrix result = place_matrix(rows, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result[i][j] = result[j][i] = triangle[i * (i + 1) / 2 + j];
    }
  }
  return result;
}

PlaceMatrix root_of(const PlaceMatrix& a) {
  const std::size_t n = a.size();
  PlaceMatrix l = place_matrix(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      BallPolynomial rest = a[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        rest -= l[i][k] * l[j][k];
      }
      const bool is_positive = i > j || certainly_positive(rest.range());
      l[i][j] = !is_positive ? BallPolynomial::everything() : i == j ? sqrt(rest) : rest / l[j][j];
    }
  }
  return l;
}

std::vector<BallPolynomial> forward(const PlaceMatrix& l, const std::vector<BallPolynomial>& b) {
  std::vector<BallPolynomial> x;
  for (std::size_t i = 0; i < b.size(); ++i) {
    BallPolynomial rest = b[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest -= l[i][j] * x[j];
    }
    x.push_back(rest / l[i][i]);
  }
  return x;
}

PlaceMatrix positive_inverse(const PlaceMatrix& a) {
  PlaceMatrix result = place_matrix(a.size(), a.size());
  if (a.size() == 1) {
    result[0][0] = certainly_positive(a[0][0].range()) ? reciprocal(a[0][0]) : BallPolynomial::everything();
    return result;
  }
  const BallPolynomial determinant = a[0][0] * a[1][1] - a[1][0] * a[1][0];
  const bool is_positive =
      a.size() == 2 && certainly_positive(a[0][0].range()) && certainly_positive(determinant.range());
  const BallPolynomial share = is_positive ? reciprocal(determinant) : BallPolynomial::everything();
  result[0][0] = a[1][1] * share;
  result[1][1] = a[0][0] * share;
  result[0][1] = result[1][0] = -(a[1][0] * share);
  return result;
}

PlaceMatrix middle_of(const PlaceMatrix& a) {
  PlaceMatrix result = a;
  for (std::vector<BallPolynomial>& row : result) {
    for (BallPolynomial& entry : row) {
      entry = entry.known() ? BallPolynomial(entry.constant()) : BallPolynomial::everything();
    }
  }
  return result;
}

double near_least_eigenvalue(const PlaceMatrix& a, const PlaceMatrix& unit) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  const std::size_t n = a.size();
  std::vector<std::vector<double>> of_unit(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (!a[i][j].known() || !unit[i][j].known()) {
        return kNothing;
      }
      of_unit[i][j] = unit[i][j].constant();
    }
  }
  const std::vector<std::vector<double>> x = near_inverse_root(of_unit);
  if (x.empty()) {
    return kNothing;
  }
  SymmetricMatrix negative(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double entry = 0.0;
      for (std::size_t k = 0; k <= i; ++k) {
        for (std::size_t l = 0; l <= j; ++l) {
          entry += x[i][k] * a[k][l].constant() * x[j][l];
        }
      }
      negative.add(i, j, -entry);
    }
  }
  const double least = -near_largest_eigenvalue(negative);
  if (!std::isfinite(least)) {
    return kNothing;
  }
  return least;
}

std::vector<std::vector<double>> near_inverse_root(const std::vector<std::vector<double>>& a) {
  const std::size_t n = a.size();
  std::vector<std::vector<double>> l(n, std::vector<double>(n, 0.0));
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double rest = a[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        rest -= l[i][k] * l[j][k];
      }
      if (i == j && !(rest > 0.0)) {
        return {};
      }
      l[i][j] = i == j ? std::sqrt(rest) : rest / l[j][j];
    }
  }
  std::vector<std::vector<double>> x(n, std::vector<double>(n, 0.0));
  for (std::size_t column = 0; column < n; ++column) {
    for (std::size_t i = column; i < n; ++i) {
      double rest = i == column ? 1.0 : 0.0;
      for (std::size_t k = column; k < i; ++k) {
        rest -= l[i][k] * x[k][column];
      }
      x[i][column] = rest / l[i][i];
      if (!std::isfinite(x[i][column])) {
        return {};
      }
    }
  }
  return x;
}

bool certainly_definite(const PlaceMatrix& a) {
  const std::size_t n = a.size();
  const auto entry = [&](std::size_t i, std::size_t j) -> const BallPolynomial& {
    return a[std::max(i, j)][std::min(i, j)];
  };
  std::vector<std::vector<double>> middle(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (!entry(i, j).known() || entry(i, j).vector_degree() > 0) {
        return false;
      }
      middle[i][j] = entry(i, j).constant();
    }
  }
  const std::vector<std::vector<double>> units = near_inverse_root(middle);
  if (units.empty()) {
    return false;
  }
  // X A X' is positive definite: its middle is about the identity, and the rest is shorter than 1.
  const auto size = static_cast<slong>(n);
  Matrix x(size, size);
  Matrix sizes(size, size);
  for (slong i = 0; i < size; ++i) {
    for (slong j = 0; j < size; ++j) {
      const Ball value(units[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
      x.set(i, j, value);
      sizes.set(i, j, abs(value));
    }
  }
  const auto in_units = [&](const Matrix& by, const auto& value) {
    Matrix matrix(size, size);
    for (slong i = 0; i < size; ++i) {
      for (slong j = 0; j < size; ++j) {
        matrix.set(i, j, Ball(value(entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j)))));
      }
    }
    return by * matrix * by.transposed();
  };
  Ball rest = length_of_matrix(in_units(sizes, [](const BallPolynomial& each) { return each.error(); }));
  for (std::size_t place = 1; place < BallPolynomial::kPlaces; ++place) {
    rest += length_of_matrix(
        in_units(x, [place](const BallPolynomial& each) { return coefficient(each, place); }));
  }
  Matrix reduced = in_units(x, [](const BallPolynomial& each) { return each.constant(); });
  for (slong i = 0; i < size; ++i) {
    reduced.set(i, i, reduced(i, i) - rest);
  }
  return rest.finite() && reduced.definite();
}

}  // namespace veritrack::checker

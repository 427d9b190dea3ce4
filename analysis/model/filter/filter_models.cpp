#include "analysis/model/filter/filter_models.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/model/step/enclosed_matrix.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

namespace {

bool is_zero_model(const BallModel& x) {
  return x.constant() == 0.0 && x.deviation() == 0.0;
}

const BallModel& of_triangle(const std::vector<BallModel>& triangle, std::size_t i, std::size_t j) {
  return i >= j ? triangle[i * (i + 1) / 2 + j] : triangle[j * (j + 1) / 2 + i];
}

}  // namespace

BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix product(a.rows(), b.columns());
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t k = 0; k < a.columns(); ++k) {
      if (is_zero_model(a(i, k))) {
        continue;
      }
      for (std::size_t j = 0; j < b.columns(); ++j) {
        if (!is_zero_model(b(k, j))) {
          product(i, j) += a(i, k) * b(k, j);
        }
      }
    }
  }
  return product;
}

BallMatrix operator+(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix sum = a;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t j = 0; j < a.columns(); ++j) {
      sum(i, j) += b(i, j);
    }
  }
  return sum;
}

BallMatrix operator-(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix difference = a;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t j = 0; j < a.columns(); ++j) {
      difference(i, j) -= b(i, j);
    }
  }
  return difference;
}

BallMatrix scaled(const BallMatrix& a, const BallModel& factor) {
  BallMatrix product = a;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t j = 0; j < a.columns(); ++j) {
      product(i, j) = product(i, j) * factor;
    }
  }
  return product;
}

BallMatrix transposed(const BallMatrix& a) {
  BallMatrix result(a.columns(), a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t j = 0; j < a.columns(); ++j) {
      result(j, i) = a(i, j);
    }
  }
  return result;
}

BallMatrix symmetric(const std::vector<BallModel>& triangle) {
  std::size_t rows = 0;
  while (rows * (rows + 1) / 2 < triangle.size()) {
    ++rows;
  }
  BallMatrix result(rows, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      result(i, j) = of_triangle(triangle, i, j);
    }
  }
  return result;
}

BallMatrix congruent(const BallMatrix& a, const BallMatrix& p) {
  return a * p * transposed(a);
}

BallMatrix cholesky(const BallMatrix& a) {
  BallMatrix l(a.rows(), a.rows());
  for (std::size_t j = 0; j < a.rows(); ++j) {
    BallModel pivot = a(j, j);
    for (std::size_t k = 0; k < j; ++k) {
      pivot -= square(l(j, k));
    }
    l(j, j) = sqrt(pivot);
    for (std::size_t i = j + 1; i < a.rows(); ++i) {
      BallModel rest = a(i, j);
      for (std::size_t k = 0; k < j; ++k) {
        rest -= l(i, k) * l(j, k);
      }
      l(i, j) = rest / l(j, j);
    }
  }
  return l;
}

std::vector<BallModel> solved(const BallMatrix& l, const std::vector<BallModel>& b) {
  std::vector<BallModel> x;
  for (std::size_t i = 0; i < b.size(); ++i) {
    BallModel rest = b[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest -= l(i, j) * x[j];
    }
    x.push_back(rest / l(i, i));
  }
  return x;
}

bool is_positive_definite(const BallMatrix& a) {
  const auto n = static_cast<Eigen::Index>(a.rows());
  const auto entry = [&](Eigen::Index i, Eigen::Index j) -> const BallModel& {
    return a(static_cast<std::size_t>(std::max(i, j)), static_cast<std::size_t>(std::min(i, j)));
  };
  Eigen::MatrixXd middle(n, n);
  Eigen::MatrixXd errors(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = entry(i, j).constant();
      errors(i, j) = entry(i, j).error();
    }
  }
  if (!middle.allFinite() || !errors.allFinite()) {
    return false;
  }
  // In units in which the middle is about the identity: X A X' is positive definite.
  const Eigen::LLT<Eigen::MatrixXd> factor(middle);
  if (factor.info() != Eigen::Success) {
    return false;
  }
  const Eigen::MatrixXd x = factor.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd sizes = x.cwiseAbs();
  // A bound on the matrix of the terms that vary with the place, and of the errors; upward rounding.
  double around = frobenius(Eigen::MatrixXd(sizes * errors * sizes.transpose())) * (1.0 + 0x1p-40);
  const auto& classes = a(0, 0).monomials().classes();
  for (std::size_t number = 1; number < classes.size(); ++number) {
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        matrix(i, j) = entry(i, j).coefficients()[classes[number].first];
      }
    }
    if (!matrix.isZero(0.0)) {
      const Eigen::MatrixXd product = x * matrix * x.transpose();
      // Rounding of both products, generously.
      const double rounding = 64.0 * static_cast<double>(n) * kUnitOfProducts *
                              frobenius(Eigen::MatrixXd(sizes * matrix.cwiseAbs() * sizes.transpose()));
      around += norm_of_symmetric({product, rounding});
    }
  }
  if (!std::isfinite(around)) {
    return false;
  }
  rigor::DynamicIntervalMatrix reduced(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      Interval sum(0.0);
      for (Eigen::Index k = 0; k < n; ++k) {
        for (Eigen::Index l = 0; l < n; ++l) {
          sum = sum + Interval(x(i, k)) * Interval(middle(k, l)) * Interval(x(j, l));
        }
      }
      reduced(i, j) = i == j ? sum - Interval(around) : sum;
    }
  }
  return rigor::is_positive_definite(reduced) == rigor::Verdict::proved;
}

FilterNoise noise_of(const TrackerModel& model) {
  // H, Q and R do not depend on these.
  const std::vector<BallModel> estimate(static_cast<std::size_t>(model.filter->states), BallModel(1.0));
  const std::vector<BallModel> samples(static_cast<std::size_t>(model.filter->samples), BallModel(1.0));
  const trackers::FilterValues<BallModel> values = parts_at(model, estimate, samples);
  BallMatrix noise(values.noise, samples.size());
  BallMatrix inverse = inverse_of_positive(noise);
  return {BallMatrix(values.measured, estimate.size()), BallMatrix(values.process, estimate.size()),
          std::move(noise), std::move(inverse)};
}

BallMatrix inverse_of_positive(const BallMatrix& a) {
  BallMatrix result(a.rows(), a.rows());
  const bool is_first = rigor::certainly_positive(a(0, 0).range());
  const BallModel unknown(Interval::empty());
  if (a.rows() == 1) {
    result(0, 0) = is_first ? BallModel(1.0) / a(0, 0) : unknown;
    return result;
  }
  const BallModel determinant = a(0, 0) * a(1, 1) - square(a(1, 0));
  const BallModel share = is_first && a.rows() == 2 && rigor::certainly_positive(determinant.range())
                              ? BallModel(1.0) / determinant
                              : unknown;
  result(0, 0) = a(1, 1) * share;
  result(1, 1) = a(0, 0) * share;
  result(0, 1) = result(1, 0) = -a(1, 0) * share;
  return result;
}

BallMatrix updated(const BallMatrix& predicted, const FilterNoise& noise) {
  const BallMatrix cross = noise.measured * predicted;  // H P
  const BallMatrix inverse = inverse_of_positive(cross * transposed(noise.measured) + noise.noise);
  return predicted - transposed(cross) * inverse * cross;
}

trackers::FilterValues<BallModel> parts_at(const TrackerModel& model, const std::vector<BallModel>& estimate,
                                           const std::vector<BallModel>& samples) {
  std::vector<BallModel> inputs;
  for (const Interval& constant : model.constants) {
    inputs.emplace_back(constant);
  }
  inputs.insert(inputs.end(), estimate.begin(), estimate.end());
  inputs.insert(inputs.end(), samples.begin(), samples.end());
  return trackers::filter_values(*model.filter, inputs);
}

}  // namespace veritrack::model

#include "analysis/model/filter/covariance_order.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::BallMonomials;
using rigor::Interval;

/// s^c z^d, by the number of its class among models without a ball.
std::vector<BallModel> place_monomials() {
  std::vector<BallModel> monomials;
  for (const BallMonomials::Class& here : rigor::BallModelScope::monomials().classes()) {
    BallModel product(1.0);
    for (int i = 0; i < here.s; ++i) {
      product = product * BallModel::s();
    }
    for (int i = 0; i < here.z; ++i) {
      product = product * BallModel::z();
    }
    monomials.push_back(product);
  }
  return monomials;
}

Eigen::MatrixXd middle_of(const BallMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(matrix.rows());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = matrix(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).constant();
    }
  }
  return middle;
}

bool is_zero(const BallMatrix& matrix) {
  return std::all_of(matrix.entries().begin(), matrix.entries().end(), [](const BallModel& entry) {
    return entry.constant() == 0.0 && entry.deviation() == 0.0;
  });
}

/// The logarithm of eta, in [-10, highest], for which the least eigenvalue of a(eta) in units of `size` is
/// largest; in floating point.
template <typename Matrix>
double best_logarithm(double highest, const Eigen::MatrixXd& size, const Matrix& matrix_at) {
  const auto factor = rigor::cholesky(size);
  const auto cost = [&](double logarithm) {
    const double least =
        factor ? rigor::least_eigenvalue(rigor::in_units_of(*factor, matrix_at(std::exp(logarithm))))
               : std::numeric_limits<double>::quiet_NaN();
    return std::isfinite(least) ? -least : std::numeric_limits<double>::max();
  };
  constexpr int kSteps = 20;
  return search::golden_section(-10.0, highest, kSteps, cost).point;
}

}  // namespace

JacobianParts parts_of_jacobian(const std::vector<BallModel>& jacobian, std::size_t states) {
  const BallMonomials& monomials = jacobian.front().monomials();
  const std::vector<BallModel> places = place_monomials();
  const std::vector<BallMonomials::Class>& place_classes = rigor::BallModelScope::monomials().classes();
  /// The coefficient of the monomial number k of degree a in xi, as a model in s and z.
  const auto coefficient = [&](const BallModel& entry, int degree, std::size_t k) {
    BallModel sum;
    for (std::size_t number = 0; number < place_classes.size(); ++number) {
      const BallMonomials::Class& place = place_classes[number];
      if (degree + place.s + place.z > BallMonomials::kMost) {
        continue;
      }
      const std::size_t there = monomials.class_of(degree, 0, place.s, place.z);
      const double value = entry.coefficients()[monomials.classes()[there].first + k];
      if (value != 0.0) {
        sum.add_multiple(places[number], value);
      }
    }
    return sum;
  };
  const auto matrix_of = [&](int degree, std::size_t k) {
    std::vector<BallModel> entries;
    entries.reserve(jacobian.size());
    for (const BallModel& entry : jacobian) {
      entries.push_back(coefficient(entry, degree, k));
    }
    return BallMatrix(std::move(entries), states);
  };
  JacobianParts parts{matrix_of(0, 0), {}, {}, 0.0};
  for (int degree = 1; degree <= BallMonomials::kMostOfVectors; ++degree) {
    const BallMonomials::Class& here = monomials.classes()[monomials.class_of(degree, 0, 0, 0)];
    parts.powers.emplace_back();
    parts.weights.emplace_back();
    for (std::size_t k = 0; k < here.last - here.first; ++k) {
      parts.powers.back().push_back(matrix_of(degree, k));
      parts.weights.back().push_back(monomials.weights()[here.first + k]);
    }
  }
  double squares = 0.0;
  for (const BallModel& entry : jacobian) {
    squares += entry.error() * entry.error();
  }
  parts.error = std::sqrt(squares);
  return parts;
}

BallMatrix spread_of(const JacobianParts& jacobian, const BallMatrix& covariance) {
  const std::size_t n = covariance.rows();
  std::vector<BallMatrix> sums;
  std::vector<double> sizes;
  for (std::size_t a = 0; a < jacobian.powers.size(); ++a) {
    BallMatrix sum(n, n);
    for (std::size_t k = 0; k < jacobian.powers[a].size(); ++k) {
      if (is_zero(jacobian.powers[a][k])) {
        continue;
      }
      sum = sum + scaled(congruent(jacobian.powers[a][k], covariance), BallModel(jacobian.weights[a][k]));
    }
    sums.push_back(sum);
    sizes.push_back(std::sqrt(std::max(0.0, middle_of(sum).trace())));
  }
  // |P| <= the trace.
  BallMatrix of_error(n, n);
  BallModel trace;
  for (std::size_t i = 0; i < n; ++i) {
    trace = trace + covariance(i, i);
  }
  const BallModel squared = BallModel(jacobian.error) * BallModel(jacobian.error) * trace;
  for (std::size_t i = 0; i < n; ++i) {
    of_error(i, i) = squared;
  }
  sums.push_back(of_error);
  sizes.push_back(std::sqrt(std::max(0.0, squared.constant())));
  for (double& size : sizes) {
    size = std::max(size, 1e-9 * *std::max_element(sizes.begin(), sizes.end()) + 1e-200);
  }
  // (a + b + ...)^2 <= (sum of the t) (a^2/t_a + b^2/t_b + ...) for any positive t.
  Interval all(0.0);
  for (const double size : sizes) {
    all = all + Interval(size);
  }
  BallMatrix spread(n, n);
  for (std::size_t a = 0; a < sums.size(); ++a) {
    spread = spread + scaled(sums[a], BallModel(all / Interval(sizes[a])));
  }
  return spread;
}

bool stays_below(const JacobianParts& jacobian, const BallMatrix& covariance, const BallMatrix& process,
                 const BallMatrix& high) {
  const BallMatrix spread = spread_of(jacobian, covariance);
  const BallMatrix carried = congruent(jacobian.constant, covariance);
  const Eigen::MatrixXd room = middle_of(high) - middle_of(process);
  const Eigen::MatrixXd carried_middle = middle_of(carried);
  const Eigen::MatrixXd spread_middle = middle_of(spread);
  if (!room.allFinite() || !carried_middle.allFinite() || !spread_middle.allFinite()) {
    return false;
  }
  const double eta = std::exp(best_logarithm(4.0, middle_of(high), [&](double tried) -> Eigen::MatrixXd {
    return room - (1.0 + tried) * carried_middle - (1.0 + 1.0 / tried) * spread_middle;
  }));
  const BallModel of_carried(Interval(1.0) + Interval(eta));
  const BallModel of_spread(Interval(1.0) + Interval(1.0) / Interval(eta));
  return is_positive_definite(high - process - scaled(carried, of_carried) - scaled(spread, of_spread));
}

bool stays_above(const JacobianParts& jacobian, const BallMatrix& covariance, const BallMatrix& process,
                 const BallMatrix& low) {
  const BallMatrix spread = spread_of(jacobian, covariance);
  const BallMatrix carried = congruent(jacobian.constant, covariance);
  const Eigen::MatrixXd room = middle_of(process) - middle_of(low);
  const Eigen::MatrixXd carried_middle = middle_of(carried);
  const Eigen::MatrixXd spread_middle = middle_of(spread);
  if (!room.allFinite() || !carried_middle.allFinite() || !spread_middle.allFinite()) {
    return false;
  }
  const double eta = std::exp(best_logarithm(-0.01, middle_of(low), [&](double tried) -> Eigen::MatrixXd {
    return room + (1.0 - tried) * carried_middle - (1.0 / tried - 1.0) * spread_middle;
  }));
  const BallModel of_carried(Interval(1.0) - Interval(eta));
  const BallModel of_spread(Interval(1.0) / Interval(eta) - Interval(1.0));
  return eta < 1.0 &&
         is_positive_definite(process - low + scaled(carried, of_carried) - scaled(spread, of_spread));
}

}  // namespace veritrack::model

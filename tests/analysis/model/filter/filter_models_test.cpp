#include "analysis/model/filter/filter_models.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/ball_model.hpp"
#include "tests/analysis/model/filter/filter_examples.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::model {
namespace {

using Eigen::MatrixXd;
using rigor::BallModel;
using rigor::Interval;

/// middle + of_s s + of_z z.
struct PlaneMatrix {
  MatrixXd middle, of_s, of_z;

  PlaneMatrix(test::Random& random, Eigen::Index rows, Eigen::Index columns, double size, double around)
      : middle(random_entries(random, rows, columns, size)),
        of_s(random_entries(random, rows, columns, around)),
        of_z(random_entries(random, rows, columns, around)) {}
  static MatrixXd random_entries(test::Random& random, Eigen::Index rows, Eigen::Index columns, double size) {
    return MatrixXd::NullaryExpr(rows, columns, [&random, size] { return random.uniform(-size, size); });
  }
  /// A A' + least I of a square one's middle, symmetric in all parts.
  void make_positive(double least) {
    middle = (middle * middle.transpose()).eval();
    middle.diagonal().array() += least;
    of_s = (0.5 * (of_s + of_s.transpose())).eval();
    of_z = (0.5 * (of_z + of_z.transpose())).eval();
  }
  [[nodiscard]] MatrixXd at(double s, double z) const { return middle + s * of_s + z * of_z; }
  [[nodiscard]] BallMatrix models() const {
    BallMatrix result(static_cast<std::size_t>(middle.rows()), static_cast<std::size_t>(middle.cols()));
    for (Eigen::Index i = 0; i < middle.rows(); ++i) {
      for (Eigen::Index j = 0; j < middle.cols(); ++j) {
        result(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) =
            BallModel(middle(i, j)) + BallModel(of_s(i, j)) * BallModel::s() +
            BallModel(of_z(i, j)) * BallModel::z();
      }
    }
    return result;
  }
};

/// Whether the ranges of the entries contain the values at the corners, the middle and random places, which
/// are at least so much of their widths.
template <typename Values>
void check_contains(test::Random& random, const BallMatrix& matrix, const Values& values, double share) {
  const MatrixXd first = values(0.0, 0.0);
  MatrixXd lowest = first;
  MatrixXd highest = first;
  for (int i = 0; i < 60; ++i) {
    const double s = i < 4 ? (i % 2 == 0 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
    const double z = i < 4 ? (i < 2 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
    const MatrixXd here = values(s, z);
    lowest = lowest.cwiseMin(here);
    highest = highest.cwiseMax(here);
  }
  REQUIRE(matrix.rows() == static_cast<std::size_t>(first.rows()));
  REQUIRE(matrix.columns() == static_cast<std::size_t>(first.cols()));
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      const Interval range = matrix(i, j).range();
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(j);
      constexpr double kRounding = 1e-13;
      CHECK(range.lower() <= lowest(row, column) + kRounding);
      CHECK(range.upper() >= highest(row, column) - kRounding);
      CHECK(highest(row, column) - lowest(row, column) + kRounding >=
            share * (range.upper() - range.lower()));
    }
  }
}

TEST_CASE("operations on matrices of ball models contain those on their values") {
  test::Random random(961);
  const rigor::BallModelScope plane(0, 0);
  const PlaneMatrix a(random, 2, 3, 1.0, 0.1);
  const PlaneMatrix b(random, 3, 2, 1.0, 0.1);
  const PlaneMatrix c(random, 2, 3, 1.0, 0.1);
  PlaneMatrix p(random, 3, 3, 1.0, 0.05);
  p.make_positive(0.5);
  PlaneMatrix lower(random, 2, 2, 0.5, 0.05);
  lower.middle += MatrixXd::Identity(2, 2);
  const auto check = [&random](const BallMatrix& matrix, const auto& values, double share = 0.4) {
    check_contains(random, matrix, values, share);
  };
  check(a.models() * b.models(), [&](double s, double z) -> MatrixXd { return a.at(s, z) * b.at(s, z); });
  check(a.models() + c.models(), [&](double s, double z) -> MatrixXd { return a.at(s, z) + c.at(s, z); });
  check(a.models() - c.models(), [&](double s, double z) -> MatrixXd { return a.at(s, z) - c.at(s, z); });
  check(scaled(a.models(), BallModel(0.5) + BallModel::z()),
        [&](double s, double z) -> MatrixXd { return (0.5 + z) * a.at(s, z); });
  check(transposed(a.models()), [&](double s, double z) -> MatrixXd { return a.at(s, z).transpose(); });
  check(congruent(a.models(), p.models()),
        [&](double s, double z) -> MatrixXd { return a.at(s, z) * p.at(s, z) * a.at(s, z).transpose(); });
  const BallMatrix root = cholesky(p.models());
  check(
      root * transposed(root), [&](double s, double z) { return p.at(s, z); }, 0.3);
  CHECK(root(0, 1).range().upper() == 0.0);
  CHECK(root(1, 1).range().lower() > 0.0);
  const BallMatrix right = b.models();
  const std::vector<BallModel> solution = solved(lower.models(), {right(0, 0), right(1, 1)});
  check(
      BallMatrix(solution, 1),
      [&](double s, double z) -> MatrixXd {
        const MatrixXd l = lower.at(s, z);
        const double first = b.at(s, z)(0, 0) / l(0, 0);
        return Eigen::Vector2d(first, (b.at(s, z)(1, 1) - l(1, 0) * first) / l(1, 1));
      },
      0.3);
}

/// c + a s + b z.
BallModel place_model(double c, double a, double b) {
  return BallModel(c) + BallModel(a) * BallModel::s() + BallModel(b) * BallModel::z();
}

TEST_CASE("a matrix over a cell is definite only where it is at all places") {
  const rigor::BallModelScope scope(0, 0);
  // [2 + a s, 1; 1, 2 + b z], with eigenvalues of 1 and 3 in the middle.
  const auto matrix = [](double a, double b, double error) {
    return symmetric({place_model(2.0, a, 0.0), BallModel(1.0), place_model(2.0, 0.0, b).widened(error)});
  };
  CHECK(is_positive_definite(matrix(0.0, 0.0, 0.0)));
  CHECK(is_positive_definite(matrix(0.4, 0.4, 0.0)));
  CHECK_FALSE(is_positive_definite(matrix(1.6, 0.0, 0.0)));
  CHECK_FALSE(is_positive_definite(matrix(0.0, 0.0, 1.6)));
  CHECK_FALSE(is_positive_definite(matrix(0.0, 0.0, std::numeric_limits<double>::quiet_NaN())));
  CHECK_FALSE(is_positive_definite(symmetric({BallModel(1.0), BallModel(1.0), BallModel(1.0)})));
  CHECK_FALSE(is_positive_definite(symmetric({BallModel(-1.0)})));
}

TEST_CASE("a product passes over zeros, and a symmetric matrix is filled from its triangle") {
  const rigor::BallModelScope plane(0, 0);
  BallMatrix unknown(1, 1);
  unknown(0, 0) = BallModel(Interval::empty());
  const BallMatrix product = BallMatrix(1, 1) * unknown;  // 0 times what is not known
  CHECK(product(0, 0).range().upper() == 0.0);
  const BallMatrix matrix = symmetric({BallModel(1.0), BallModel(2.0), BallModel(3.0)});
  REQUIRE(matrix.rows() == 2);
  CHECK(matrix(0, 0).constant() == 1.0);
  CHECK(matrix(0, 1).constant() == 2.0);
  CHECK(matrix(1, 0).constant() == 2.0);
  CHECK(matrix(1, 1).constant() == 3.0);
}

TEST_CASE("nothing is known of the inverse of a matrix that may not be positive definite") {
  test::Random random(962);
  const rigor::BallModelScope plane(0, 0);
  for (const Eigen::Index rows : {1, 2}) {
    PlaneMatrix p(random, rows, rows, 0.5, 0.05);
    p.make_positive(0.4);
    check_contains(
        random, inverse_of_positive(p.models()),
        [&p](double s, double z) -> MatrixXd { return oracle::inverse(p.at(s, z)); }, 0.3);
  }
  const auto is_known = [](double first, double across, double second) {
    const BallMatrix inverse =
        inverse_of_positive(symmetric({BallModel(first), BallModel(across), BallModel(second)}));
    return !rigor::is_empty(inverse(0, 0).range()) && !rigor::is_empty(inverse(1, 0).range());
  };
  CHECK(is_known(1.0, 0.9, 1.0));
  CHECK_FALSE(is_known(1.0, 1.0, 1.0));
  CHECK_FALSE(is_known(1.0, 2.0, 1.0));
  CHECK_FALSE(is_known(-1.0, 0.0, -1.0));
  CHECK_FALSE(is_known(-1.0, 0.0, 1.0));
  CHECK(rigor::is_empty(inverse_of_positive(symmetric({BallModel(-1.0)}))(0, 0).range()));
  CHECK(rigor::is_empty(inverse_of_positive(symmetric({BallModel(0.1) + BallModel::s()}))(0, 0).range()));
}

TEST_CASE("a filter's parts and its updated covariance over a cell are those of its formulas") {
  test::Random random(963);
  for (const int channels : {1, 2}) {
    CAPTURE(channels);
    test::BentFilter bent;
    bent.channels = channels;
    const test::FilterExample filter(bent.filter());
    const rigor::BallModelScope plane(0, 0);
    const FilterNoise noise = noise_of(filter.example.model);
    const auto everywhere = [](const MatrixXd& matrix) {
      return [matrix](double, double) { return matrix; };
    };
    check_contains(random, noise.measured, everywhere(bent.measured()), 0.0);
    check_contains(random, noise.process, everywhere(bent.process()), 0.0);
    check_contains(random, noise.noise, everywhere(bent.noise()), 0.0);
    check_contains(random, noise.inverse, everywhere(oracle::inverse(bent.noise())), 0.0);
    PlaneMatrix p(random, 2, 2, 0.3, 0.01);
    p.make_positive(0.05);
    check_contains(
        random, updated(p.models(), noise),
        [&](double s, double z) -> MatrixXd { return bent.updated(p.at(s, z)); }, 0.3);
    const PlaneMatrix x(random, 2, 1, 0.5, 0.1);
    const trackers::FilterValues<BallModel> values =
        parts_at(filter.example.model, x.models().entries(),
                 std::vector<BallModel>(static_cast<std::size_t>(channels)));
    check_contains(
        random, BallMatrix(values.predicted, 1),
        [&](double s, double z) -> MatrixXd { return bent.next(x.at(s, z)); }, 0.5);
    check_contains(
        random, BallMatrix(values.jacobian, 2),
        [&](double s, double z) -> MatrixXd { return bent.jacobian(x.at(s, z)); }, 0.5);
    check_contains(
        random, BallMatrix(values.innovation, 1),
        [&](double s, double z) -> MatrixXd { return -bent.measured() * bent.next(x.at(s, z)); }, 0.5);
  }
}

}  // namespace
}  // namespace veritrack::model

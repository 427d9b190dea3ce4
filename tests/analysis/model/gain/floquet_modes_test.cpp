#include "analysis/model/gain/floquet_modes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "analysis/rigor/small_matrix.hpp"
#include "analysis/rigor/spectral_radius.hpp"

using namespace veritrack;
using model::FloquetBasis;
using model::FloquetGauge;
using model::PhaseGrid;

namespace {

constexpr double kOmega = 0.31;

/// A basis that depends on the phase, and turns its first two columns.
Eigen::Matrix3d basis_at(double phase) {
  Eigen::Matrix3d wave;
  wave << 1.0, 0.2 * std::cos(phase), 0.1 * std::sin(2.0 * phase), 0.3 * std::sin(phase), 1.0,
      0.2 * std::cos(phase), 0.1, 0.1 * std::cos(2.0 * phase), 1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(phase), -std::sin(phase), std::sin(phase), std::cos(phase);
  return turn * wave;
}

/// A pair of multipliers, 0.9 +- 0.05i, and one, 0.97.
Eigen::Matrix3d pair_and_one() {
  Eigen::Matrix3d constant;
  constant << 0.9, 0.05, 0.0, -0.05, 0.9, 0.0, 0.0, 0.0, 0.97;
  return constant;
}

/// A(phi) = P(phi + omega) constant P(phi)^-1.
Eigen::MatrixXd jacobians_of(const PhaseGrid& grid, const Eigen::Matrix3d& constant) {
  Eigen::MatrixXd values(9, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    const double phase = grid.phase(j);
    Eigen::Map<Eigen::Matrix3d>(values.col(j).data()) =
        basis_at(phase + kOmega) * constant * Eigen::Matrix3d(rigor::approximate_inverse(basis_at(phase)));
  }
  return values;
}

/// B(phi + omega)^-1 A(phi) B(phi) at a phase of the grid.
Eigen::MatrixXd seen_at(const PhaseGrid& grid, const Eigen::MatrixXd& jacobians, const FloquetBasis& basis,
                        int j) {
  const Eigen::MatrixXd there = basis.values * grid.shift(kOmega);
  const auto matrix = [](const Eigen::MatrixXd& values, int column) {
    return Eigen::MatrixXd(Eigen::Map<const Eigen::Matrix3d>(values.col(column).data()));
  };
  return rigor::product(rigor::approximate_inverse(matrix(there, j)),
                        rigor::product(matrix(jacobians, j), matrix(basis.values, j)));
}

void check_eigenvalues(const Eigen::MatrixXd& matrix, const std::vector<std::complex<double>>& expected) {
  const auto found = rigor::eigenvalues_by_size(matrix);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(std::abs(found[i] - expected[i]) < 1e-9);
  }
}

}  // namespace

TEST_CASE("modes make a matrix constant, with its multipliers") {
  const PhaseGrid grid(24);
  const Eigen::MatrixXd jacobians = jacobians_of(grid, pair_and_one());
  const FloquetBasis basis = model::floquet_modes(grid, kOmega, jacobians, 3, FloquetGauge::by_mode);
  REQUIRE(basis.modes() == 3);
  const Eigen::MatrixXd first = seen_at(grid, jacobians, basis, 0);
  check_eigenvalues(first, {{0.97, 0.0}, {0.9, 0.05}, {0.9, -0.05}});
  for (int j = 1; j < grid.size(); ++j) {
    CHECK((seen_at(grid, jacobians, basis, j) - first).cwiseAbs().maxCoeff() < 1e-9);
  }
  // The pair has a block of its own.
  CHECK(basis.group_of.front() != basis.group_of.back());
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const bool is_apart =
          basis.group_of[static_cast<std::size_t>(i)] != basis.group_of[static_cast<std::size_t>(j)];
      CHECK((!is_apart || std::fabs(first(i, j)) < 1e-9));
    }
  }
}

TEST_CASE("by state the mean of the basis is the unit matrix, or there is none") {
  const PhaseGrid grid(24);
  const Eigen::MatrixXd jacobians = jacobians_of(grid, pair_and_one());
  const FloquetBasis basis = model::floquet_modes(grid, kOmega, jacobians, 3, FloquetGauge::by_state);
  REQUIRE(basis.modes() == 3);
  const Eigen::VectorXd mean = basis.values.rowwise().mean();
  CHECK((Eigen::Map<const Eigen::Matrix3d>(mean.data()) - Eigen::Matrix3d::Identity()).norm() < 1e-9);
  // The two that turn with the signal are taken as they are seen by somebody who does not turn.
  const auto found = rigor::eigenvalues_by_size(seen_at(grid, jacobians, basis, 0));
  CHECK(std::abs(found[0] - 0.97) < 1e-9);
  const std::complex<double> pair(0.9, 0.05);
  const double faster = std::abs(found[1] - pair * std::polar(1.0, kOmega));
  const double slower = std::abs(found[1] - std::conj(pair * std::polar(1.0, -kOmega)));
  CHECK(std::min(faster, slower) < 1e-9);

  // A single mode that turns has no mean.
  Eigen::MatrixXd turning(4, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    const auto at = [](double phase) {
      Eigen::Matrix2d turned;
      turned << std::cos(phase), -std::sin(phase), std::sin(phase), std::cos(phase);
      return turned;
    };
    Eigen::Matrix2d apart;
    apart << 0.9, 0.0, 0.0, 0.5;
    Eigen::Map<Eigen::Matrix2d>(turning.col(j).data()) =
        at(grid.phase(j) + kOmega) * apart * at(grid.phase(j)).transpose();
  }
  CHECK(model::floquet_modes(grid, kOmega, turning, 2, FloquetGauge::by_mode).modes() == 2);
  CHECK(model::floquet_modes(grid, kOmega, turning, 2, FloquetGauge::by_state).modes() == 0);
}

TEST_CASE("states that only delay others are no modes") {
  const PhaseGrid grid(24);
  Eigen::Matrix3d step;
  step << 0.9, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;  // the second and third are the first, later
  Eigen::MatrixXd jacobians(9, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    Eigen::Map<Eigen::Matrix3d>(jacobians.col(j).data()) = step;
  }
  const FloquetBasis basis = model::floquet_modes(grid, kOmega, jacobians, 3, FloquetGauge::by_mode);
  CHECK(basis.modes() == 1);
  for (int j = 0; j < grid.size(); ++j) {
    const Eigen::Map<const Eigen::Matrix3d> there(basis.values.col(j).data());
    CHECK(std::fabs(there.determinant()) > 1e-3);
  }
}

#include "analysis/model/gain/basis_inverse.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::BallModel;

constexpr int kSize = 3;

/// Entries middle + lean z, in units that differ from row to row and from column to column.
struct Family {
  Eigen::Matrix3d middle, lean;

  [[nodiscard]] std::vector<BallModel> models() const {
    std::vector<BallModel> all;
    for (int i = 0; i < kSize * kSize; ++i) {
      all.push_back(BallModel(middle(i / kSize, i % kSize)) +
                    BallModel(lean(i / kSize, i % kSize)) * BallModel::z());
    }
    return all;
  }
};

Family random_family(test::Random& random) {
  Family family;
  const auto unit = [&] { return std::pow(10.0, random.uniform(-4.0, 4.0)); };
  const std::array rows{unit(), unit(), unit()};
  const std::array columns{unit(), unit(), unit()};
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) {
      const double size = rows.at(static_cast<std::size_t>(i)) * columns.at(static_cast<std::size_t>(j));
      family.middle(i, j) = size * random.uniform(-1.0, 1.0);
      family.lean(i, j) = size * random.uniform(-0.01, 0.01);
    }
  }
  return family;
}

TEST_CASE("solutions lie in their ranges, whatever the units of rows and columns are") {
  test::Random random(37'011);
  const rigor::BallModelScope scope(0, 0);
  int known = 0;
  const std::int64_t cases = test::effort(300);
  for (std::int64_t trial = 0; trial < cases; ++trial) {
    const Family family = random_family(random);
    std::vector<BallModel> side(kSize);
    {
      const rigor::UpwardRounding upward;
      for (int i = 0; i < kSize; ++i) {
        side[static_cast<std::size_t>(i)] = BallModel(family.middle(i, 0));
      }
      model::solve_in_basis(family.models(), {&side});
    }
    bool is_known = true;
    for (int i = 0; i < kSize; ++i) {
      const rigor::Interval range = side[static_cast<std::size_t>(i)].range();
      is_known = is_known && !is_empty(range);
      for (const double z : {-1.0, -0.3, 0.0, 1.0}) {
        const Eigen::Matrix3d there = family.middle + z * family.lean;
        const double exact = oracle::solution(there, family.middle.col(0))(i);
        const double room = 1e-7 * (std::fabs(exact) + std::fabs(rigor::midpoint(range)));
        CHECK((is_empty(range) || (range.lower() - room <= exact && exact <= range.upper() + room)));
      }
    }
    known += is_known ? 1 : 0;
  }
  CHECK(known > 9 * cases / 10);
}

TEST_CASE("where each entry of the first column may be 0 another unknown is eliminated first") {
  // z x + y = 1, (z - 1/2) x + y = 2 for all |z| <= 1: x = -2, y = 1 + 2 z.
  const rigor::BallModelScope scope(0, 0);
  const rigor::UpwardRounding upward;
  std::vector<BallModel> side{BallModel(1.0), BallModel(2.0)};
  const std::vector<BallModel> basis{BallModel::z(), BallModel(1.0), BallModel::z() - BallModel(0.5),
                                     BallModel(1.0)};
  model::solve_in_basis(basis, {&side});
  CHECK(side[0].range().lower() == doctest::Approx(-2.0));
  CHECK(side[0].range().upper() == doctest::Approx(-2.0));
  CHECK(side[1].range().lower() == doctest::Approx(-1.0));
  CHECK(side[1].range().upper() == doctest::Approx(3.0));
}

}  // namespace

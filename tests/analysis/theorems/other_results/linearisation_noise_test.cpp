#include "analysis/theorems/other_results/linearisation_noise.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "tests/analysis/theorems/tracker_inputs.hpp"
#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

/// Mean and covariance of e^{i nu}(m + d), (d_1, d_2, nu) Gaussian of covariance P, by Gauss-Hermite
/// quadrature with five points a direction (exact for polynomials up to degree nine).
struct Moments {
  Eigen::Vector2d mean;
  Eigen::Matrix2d covariance;
};
Moments exact_moments(const Eigen::Matrix3d& p, double m) {
  const double inner = std::sqrt(5.0 - std::sqrt(10.0));
  const double outer = std::sqrt(5.0 + std::sqrt(10.0));
  const double node[5] = {-outer, -inner, 0.0, inner, outer};
  const double small = (7.0 - 2.0 * std::sqrt(10.0)) / 60.0;
  const double large = (7.0 + 2.0 * std::sqrt(10.0)) / 60.0;
  const double weight[5] = {small, large, 8.0 / 15.0, large, small};
  const Eigen::Matrix3d root = oracle::cholesky_factor(p);
  Moments moments{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 125; ++i) {
    const int index[3] = {i % 5, i / 5 % 5, i / 25};
    const Eigen::Vector3d e = root * Eigen::Vector3d(node[index[0]], node[index[1]], node[index[2]]);
    const double c = std::cos(e(2));
    const double s = std::sin(e(2));
    const Eigen::Vector2d value(c * (m + e(0)) - s * e(1), s * (m + e(0)) + c * e(1));
    const double w = weight[index[0]] * weight[index[1]] * weight[index[2]];
    moments.mean += w * value;
    square += w * value * value.transpose();
  }
  moments.covariance = square - moments.mean * moments.mean.transpose();
  return moments;
}

}  // namespace

TEST_CASE("the second-order terms are those of the exact moments as the covariance shrinks") {
  test::Random random(121);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(50); ++i) {
    INFO("seed ", test::kSeed + 121, ", covariance ", i);
    Eigen::Matrix3d factor;
    for (Eigen::Index entry = 0; entry < factor.size(); ++entry) {
      factor(entry) = random.uniform(-1.0, 1.0);
    }
    const double m = random.uniform(0.2, 2.0);
    Eigen::Matrix3d p;
    Eigen::Matrix2d covariance_term;
    Eigen::Vector2d bias;
    {
      const rigor::NearestRounding nearest;
      p = factor * factor.transpose() + 0.1 * Eigen::Matrix3d::Identity();
      Eigen::Matrix<double, 2, 3> first;
      first << 1.0, 0.0, 0.0, 0.0, 1.0, m;
      const double scale = 1e-4;
      const Moments moments = exact_moments(scale * p, m);
      covariance_term = (moments.covariance - scale * first * p * first.transpose()) / (scale * scale);
      bias = (moments.mean - Eigen::Vector2d(m, 0.0)) / scale;
    }
    const auto terms = theorems::second_order_terms(rigor::to_interval(p), Interval(m));
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        CHECK(rigor::midpoint(terms.printed(row, column)) ==
              doctest::Approx(bias(row) * bias(column)).epsilon(2e-2).scale(p.norm() * p.norm()));
      }
    }
    // What order P^2 of the phase variance holds besides: first-order times third-order terms, by Isserlis.
    const double mixed = -p(1, 1) * p(2, 2) - 2.0 * p(1, 2) * p(1, 2) - 4.0 * m * p(2, 2) * p(1, 2) -
                         m * m * p(2, 2) * p(2, 2);
    CHECK(rigor::midpoint(terms.covariance(1, 1)) + mixed ==
          doctest::Approx(covariance_term(1, 1)).epsilon(2e-2).scale(p.norm() * p.norm()));
  }
}

TEST_CASE("lemma 3.1: the printed term misses the phase, and linearisation may also over-estimate") {
  for (const test::TableRow& row : test::kTable32) {
    const auto derivation = theorems::evaluate_lemma_3_1(test::without_leak(row));
    CHECK(test::find_condition(derivation, "exact-to-second-order").verdict == Verdict::refuted);
    CHECK(test::find_condition(derivation, "truncated-under-estimate").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "under-estimate").verdict == Verdict::refuted);
  }
}

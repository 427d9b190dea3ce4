#include "analysis/linear/resolvent.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;

TEST_CASE("random recursions: the response by Eigen, at frequencies of the band") {
  test::Random random(37006);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    const auto n = static_cast<Eigen::Index>(1 + random.below(4));
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXcd g(n);
    Eigen::RowVectorXd form(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        matrix(i, j) = random.uniform(-0.4, 0.4);
      }
      g(i) = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
      form(i) = random.uniform(-1.0, 1.0);
    }
    const int turns = static_cast<int>(random.below(3)) + 1;
    const double low = random.uniform(0.1, 1.0);
    const double high = low + 0.2;
    double largest_form = 0.0;
    double largest_direct = 0.0;
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd largest_rest = largest;
    for (int k = 0; k <= 50; ++k) {
      const std::complex<double> turn = std::polar(1.0, turns * (low + k * (high - low) / 50));
      const Eigen::MatrixXcd shifted = turn * Eigen::MatrixXcd::Identity(n, n) - matrix;
      const Eigen::VectorXcd pi = oracle::solution(shifted, g * turn);
      largest = largest.cwiseMax(pi.cwiseAbs());
      largest_form = std::max(largest_form, std::abs((form * pi)(0)));
      const std::complex<double> direct = turn / (turn - 1.0);
      largest_direct = std::max(largest_direct, std::abs(direct));
      largest_rest = largest_rest.cwiseMax((pi - direct * g).cwiseAbs());
    }
    const rigor::UpwardRounding upward;
    std::vector<Row> a;
    Row real;
    Row imaginary;
    Row row;
    for (Eigen::Index i = 0; i < n; ++i) {
      a.emplace_back();
      for (Eigen::Index j = 0; j < n; ++j) {
        a.back().emplace_back(matrix(i, j));
      }
      real.emplace_back(g(i).real());
      imaginary.emplace_back(g(i).imag());
      row.emplace_back(form(i));
    }
    const auto response =
        turning_response(a, real, imaginary, turns, {row}, Interval::from_bounds(low, high), 256);
    REQUIRE(response.has_value());
    for (Eigen::Index i = 0; i < n; ++i) {
      const double bound = response->states[static_cast<std::size_t>(i)];
      CHECK(bound >= largest(i) * (1.0 - 1e-12));
      CHECK(bound <= largest(i) * 1.05);
      CHECK(response->rest[static_cast<std::size_t>(i)] >= largest_rest(i) * (1.0 - 1e-12));
      CHECK(response->rest[static_cast<std::size_t>(i)] <= largest_rest(i) * 1.2 + 0.05);
    }
    CHECK(response->direct >= largest_direct * (1.0 - 1e-12));
    CHECK(response->direct <= largest_direct * 1.05);
    CHECK(response->forms[0] >= largest_form * (1.0 - 1e-12));
    CHECK(response->forms[0] <= largest_form * 1.02 + 0.05);
  }
}

TEST_CASE("nothing is said where a mode turns with the signal") {
  const rigor::UpwardRounding upward;
  const std::vector<Row> rotation{{Interval(0.0), Interval(-1.0)}, {Interval(1.0), Interval(0.0)}};
  const Row one{Interval(1.0), Interval(0.0)};
  const Row none{Interval(0.0), Interval(0.0)};
  CHECK_FALSE(turning_response(rotation, one, none, 1, {}, Interval::from_bounds(1.5, 1.6), 64).has_value());
  CHECK(turning_response(rotation, one, none, 1, {}, Interval::from_bounds(0.5, 0.6), 64).has_value());
}

}  // namespace
}  // namespace veritrack::linear

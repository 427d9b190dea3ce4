#include "analysis/model/filter/filter_fit.hpp"

#include <doctest/doctest.h>

#include "analysis/model/steady_state/curve_fit.hpp"
#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

constexpr int kRowsOfFit = 3;
constexpr int kHarmonicsOfFit = 4;
constexpr int kPhasesOfFit = 13;

/// A function of the phase and z that is a polynomial of the fourth degree with four harmonics.
struct WrittenSeries {
  std::array<Eigen::MatrixXcd, kNodes> coefficients;

  explicit WrittenSeries(test::Random& random) {
    for (Eigen::MatrixXcd& matrix : coefficients) {
      matrix = Eigen::MatrixXcd::NullaryExpr(kRowsOfFit, kHarmonicsOfFit + 1, [&random] {
        return std::complex<double>(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      });
    }
  }
  [[nodiscard]] double at(Index row, double z, double phase) const {
    double sum = 0.0;
    for (std::size_t d = 0; d < coefficients.size(); ++d) {
      sum += std::pow(z, static_cast<double>(d)) * test::summed(coefficients.at(d), row, phase);
    }
    return sum;
  }
  /// On a grid of phases at the nodes.
  [[nodiscard]] std::array<MatrixXd, kNodes> values() const {
    std::array<MatrixXd, kNodes> result;
    for (std::size_t j = 0; j < result.size(); ++j) {
      result.at(j) = MatrixXd(kRowsOfFit, kPhasesOfFit);
      for (Index row = 0; row < kRowsOfFit; ++row) {
        for (Index p = 0; p < kPhasesOfFit; ++p) {
          result.at(j)(row, p) =
              at(row, node_places().at(j), 2.0 * 3.141592653589793 * static_cast<double>(p) / kPhasesOfFit);
        }
      }
    }
    return result;
  }
};

TEST_CASE("both parts rounded to the nearest number of 24 bits") {
  test::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const std::complex<double> c(random.uniform(-1.0, 1.0), random.uniform(-1e-6, 1e3));
    const std::complex<double> rounded = rounded_to_24_bits(c);
    for (const auto& [before, after] :
         {std::pair(c.real(), rounded.real()), std::pair(c.imag(), rounded.imag())}) {
      volatile float shorter = static_cast<float>(before);
      CHECK(after == static_cast<double>(shorter));
    }
  }
  CHECK(rounded_to_24_bits({0.0, -0x1.ffffffp+0}) == std::complex<double>(0.0, -2.0));
}

TEST_CASE("a lower triangle row by row, and back") {
  const MatrixXd lower{{1.0, 0.0, 0.0}, {2.0, 3.0, 0.0}, {4.0, 5.0, 6.0}};
  const MatrixXd symmetric{{1.0, 2.0, 4.0}, {2.0, 3.0, 5.0}, {4.0, 5.0, 6.0}};
  const VectorXd entries = triangle_of(lower);
  REQUIRE(entries.size() == 6);
  for (int i = 0; i < 6; ++i) {
    CHECK(entries[i] == i + 1.0);
  }
  CHECK(triangle_of(symmetric) == entries);
  CHECK(matrix_of_triangle(entries, 3, false) == lower);
  CHECK(matrix_of_triangle(entries, 3, true) == symmetric);
}

TEST_CASE("a fit through a polynomial's values is that polynomial, scaled, up to single precision") {
  test::Random random(931);
  const WrittenSeries written(random);
  constexpr double kScale = 2.5;
  const PhaseFit fit = fit_of(written.values(), kHarmonicsOfFit, kScale);
  for (const Eigen::MatrixXcd& coefficients : fit) {
    REQUIRE(coefficients.cols() == kHarmonicsOfFit + 1);
  }
  for (const double z : {-1.0, -0.3, 0.0, 0.6, 1.0}) {
    for (const double phase : {0.0, 1.1, 4.0}) {
      const VectorXd value = value_of(fit, z, phase);
      for (Index row = 0; row < kRowsOfFit; ++row) {
        CHECK(std::fabs(value[row] - kScale * written.at(row, z, phase)) < 1e-5);
      }
    }
  }
}

TEST_CASE("fewer harmonics are the first ones; what is negligible is left out") {
  test::Random random(932);
  WrittenSeries written(random);
  written.coefficients.at(2).setConstant(1e-9);
  const PhaseFit all = fit_of(written.values(), kHarmonicsOfFit, 1.0);
  const PhaseFit first = fit_of(written.values(), 2, 1.0);
  for (std::size_t d = 0; d < all.size(); ++d) {
    REQUIRE(first.at(d).cols() == 3);
    CHECK((first.at(d) - all.at(d).leftCols(3)).cwiseAbs().maxCoeff() < 1e-6);
  }
  CHECK(all.at(2).isZero(0.0));
}

TEST_CASE("the series of a fit have its values, without zeros at their ends") {
  test::Random random(933);
  WrittenSeries written(random);
  written.coefficients.at(4).setZero();
  for (Eigen::MatrixXcd& matrix : written.coefficients) {
    matrix.row(1).tail(2).setZero();  // no harmonics above the second
    matrix.row(2).setZero();
  }
  const PhaseFit fit = fit_of(written.values(), kHarmonicsOfFit, 1.0);
  const std::vector<PhaseSeries> series = series_of_fit(fit);
  REQUIRE(series.size() == kRowsOfFit);
  CHECK(series[0].coefficients.size() == kHarmonicsOfFit + 1);
  CHECK(series[0].coefficients[1].size() == 4);
  CHECK(series[1].coefficients.size() == 3);
  CHECK(series[2].coefficients.empty());
  for (const double z : {-1.0, 0.4}) {
    for (const double phase : {0.3, 2.0}) {
      for (std::size_t row = 0; row < series.size(); ++row) {
        double sum = 0.0;
        for (std::size_t h = 0; h < series[row].coefficients.size(); ++h) {
          for (std::size_t d = 0; d < series[row].coefficients[h].size(); ++d) {
            const std::complex<double> turned = std::polar(1.0, static_cast<double>(h) * phase);
            sum += (series[row].coefficients[h][d] * turned).real() * std::pow(z, static_cast<double>(d));
          }
        }
        CHECK(sum == doctest::Approx(value_of(fit, z, phase)[static_cast<Index>(row)]).epsilon(1e-12));
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::model::detail

#include "trackers/dft_block/dft_block_ekf.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Real = long double;
using Complex = std::complex<Real>;
using Dynamic = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using DynamicVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
constexpr Real kPiReal = std::numbers::pi_v<Real>;

double power_of_ten(Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

/// D C D with a definite C and D over two decades.
Eigen::Matrix3d random_block_covariance(Random& random) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) {
    a(i) = random.uniform(-1.0, 1.0);
  }
  const Eigen::Vector3d d(power_of_ten(random, -2.0, 0.0), power_of_ten(random, -2.0, 0.0),
                          power_of_ten(random, -2.0, 0.0));
  const Eigen::Matrix3d p =
      d.asDiagonal() * (a * a.transpose() + 0.1 * Eigen::Matrix3d::Identity()) * d.asDiagonal();
  return 0.5 * (p + p.transpose());
}

DftBlockEstimate<double> random_block_estimate(Random& random, double most) {
  return {random.uniform(-0.6, 0.6), random.uniform(-20.0, 20.0), random.uniform(-most, most),
          random_block_covariance(random)};
}

DftBlockDesign<double> random_block_design(Random& random) {
  return {power_of_ten(random, -6.0, -2.0),
          power_of_ten(random, -6.0, -2.0),
          power_of_ten(random, -6.0, -2.0),
          power_of_ten(random, -4.0, 0.0),
          random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.2),
          random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.2)};
}

std::vector<DftBin<double>> random_bins(Random& random, int half) {
  std::vector<DftBin<double>> bins(static_cast<std::size_t>(2 * half + 1));
  for (auto& bin : bins) {
    bin = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  }
  return bins;
}

/// h and H as printed in (4.16)-(4.17) and (4.19)-(4.24); not for integer x3.
struct Printed {
  DynamicVector h;
  Dynamic H;

  Printed(const Eigen::Matrix<Real, 3, 1>& x, int half) : h(4 * half + 2), H(4 * half + 2, 3) {
    const Real s0 = std::sin(x(1));
    const Real c0 = std::cos(x(1));
    const Real s1 = std::sin(x(1) + 2 * kPiReal * x(2));
    const Real c1 = std::cos(x(1) + 2 * kPiReal * x(2));
    for (int i = 1; i <= 2 * half + 1; ++i) {
      const Real d = static_cast<Real>(half + 1 - i) + x(2);
      const Real square = x(0) * x(0);
      const int re = i - 1;
      const int im = i + 2 * half;
      h(re) = square / d * (s1 - s0);
      h(im) = square / d * (c0 - c1);
      H(re, 0) = 2 * x(0) / d * (s1 - s0);
      H(re, 1) = square / d * (c1 - c0);
      H(re, 2) = 2 * kPiReal * square / d * c1 + square / (d * d) * (s0 - s1);
      H(im, 0) = 2 * x(0) / d * (c0 - c1);
      H(im, 1) = square / d * (s1 - s0);
      H(im, 2) = 2 * kPiReal * square / d * s1 + square / (d * d) * (c1 - c0);
    }
  }
};

DynamicVector stacked(const std::vector<DftBin<double>>& bins) {
  const auto count = static_cast<Eigen::Index>(bins.size());
  DynamicVector y(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    y(i) = bins[static_cast<std::size_t>(i)].real;
    y(count + i) = bins[static_cast<std::size_t>(i)].imaginary;
  }
  return y;
}

/// g(d) = 2 pi times the integral of e^{j 2 pi d t} over [0, 1], and g', by Gauss's rule on 256 pieces: the
/// tone in a bin without any division.
std::pair<Complex, Complex> tone_in_bin(Real d) {
  const Real node = std::sqrt(Real(0.6));
  Complex value = 0;
  Complex slope = 0;
  constexpr int kPieces = 256;
  for (int piece = 0; piece < kPieces; ++piece) {
    for (int k = -1; k <= 1; ++k) {
      const Real t =
          (static_cast<Real>(piece) + Real(0.5) + Real(0.5) * static_cast<Real>(k) * node) / kPieces;
      const Complex term = std::polar((k == 0 ? Real(8) : Real(5)) / (18 * kPieces), 2 * kPiReal * d * t);
      value += term;
      slope += Complex(0, 2 * kPiReal * t) * term;
    }
  }
  return {2 * kPiReal * value, 2 * kPiReal * slope};
}

TEST_CASE("a step is the printed extended Kalman filter with all its rows, for any L") {
  Random random(401);
  const std::int64_t count = test::effort(2000);
  for (std::int64_t k = 0; k < count; ++k) {
    const int half = static_cast<int>(random.below(6));
    const auto design = random_block_design(random);
    const auto start = random_block_estimate(random, 1.5);
    const auto bins = random_bins(random, half);
    DftBlockEkf<double> tracker(design, start);
    tracker.step(bins);

    Eigen::Matrix<Real, 3, 3> F = Eigen::Matrix<Real, 3, 3>::Identity();
    F(0, 0) = 1 - Real(design.epsilon_amplitude);
    F(1, 2) = 2 * kPiReal;
    F(2, 2) = 1 - Real(design.epsilon_offset);
    const Eigen::Matrix<Real, 3, 1> q(design.q1, design.q2, design.q3);
    const Eigen::Matrix<Real, 3, 1> x = F * start.state().cast<Real>();
    Eigen::Matrix<Real, 3, 3> M = F * start.covariance.cast<Real>() * F.transpose();
    M.diagonal() += q;
    const Real from_integer = std::abs(x(2) - std::round(x(2)));
    if (from_integer < 1e-3L) {
      continue;  // where the printed form cancels
    }
    const Printed printed(x, half);
    const Dynamic S = printed.H * M * printed.H.transpose() +
                      Real(design.r) * Dynamic::Identity(4 * half + 2, 4 * half + 2);
    const Dynamic K = M * printed.H.transpose() * oracle::inverse(S);
    const Eigen::Matrix<Real, 3, 1> filtered = x + K * (stacked(bins) - printed.h);
    const Eigen::Matrix<Real, 3, 3> P = M - K * printed.H * M;

    const Eigen::Vector3d unit = M.diagonal().cast<double>().cwiseSqrt();
    CHECK((tracker.predicted().state() - x.cast<double>()).norm() <= 1e-13);
    CHECK((tracker.predicted().covariance - M.cast<double>()).norm() <= 1e-13 * M.cast<double>().norm());
    const double innovation = (stacked(bins) - printed.h).cast<double>().norm() / std::sqrt(design.r);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::fabs(tracker.filtered().state()(i) - static_cast<double>(filtered(i))) <=
            1e-9 * unit(i) * (1.0 + innovation));
      for (int j = 0; j < 3; ++j) {
        CHECK(std::fabs(tracker.filtered().covariance(i, j) - static_cast<double>(P(i, j))) <=
              1e-10 * unit(i) * unit(j));
      }
    }
    CHECK(tracker.filtered().covariance == tracker.filtered().covariance.transpose());
  }
}

TEST_CASE(
    "the information is that of the integral of the tone over the block, at integers and near them too") {
  Random random(402);
  for (int k = 0; k < 60; ++k) {
    const int half = 1 + static_cast<int>(random.below(3));
    const int integer = static_cast<int>(random.below(static_cast<std::uint64_t>(2 * half + 3))) - half - 1;
    const double off =
        random.below(3) == 0 ? 0.0 : (random.below(2) == 0 ? 1.0 : -1.0) * power_of_ten(random, -12.0, -0.4);
    const Eigen::Vector3d x(random.uniform(0.2, 0.6), random.uniform(-3.0, 3.0), integer + off);
    const auto bins = random_bins(random, half);
    const auto information = dft_block_information<double>(x, bins, 0.25);
    Eigen::Matrix<Real, 3, 3> matrix = Eigen::Matrix<Real, 3, 3>::Zero();
    Eigen::Matrix<Real, 3, 1> vector = Eigen::Matrix<Real, 3, 1>::Zero();
    for (int i = 0; i <= 2 * half; ++i) {
      const auto [g, slope] = tone_in_bin(static_cast<Real>(half - i) + Real(x(2)));
      const Complex turn = std::polar(Real(1), Real(x(1)));
      const Real a = x(0);
      const std::array<Complex, 3> H{2 * a * turn * g, Complex(0, 1) * a * a * turn * g,
                                     a * a * turn * slope};
      const auto& bin = bins[static_cast<std::size_t>(i)];
      const Complex e = Complex(bin.real, bin.imaginary) - a * a * turn * g;
      for (int row = 0; row < 3; ++row) {
        vector(row) += std::real(std::conj(H[static_cast<std::size_t>(row)]) * e) / Real(0.25);
        for (int column = 0; column < 3; ++column) {
          matrix(row, column) +=
              std::real(std::conj(H[static_cast<std::size_t>(row)]) * H[static_cast<std::size_t>(column)]) /
              Real(0.25);
        }
      }
    }
    CHECK((information.matrix - matrix.cast<double>()).norm() <=
          1e-11 * (1.0 + matrix.cast<double>().norm()));
    CHECK((information.vector - vector.cast<double>()).norm() <=
          1e-11 * (1.0 + vector.cast<double>().norm()));
  }
}

TEST_CASE(
    "at an integer offset the third column of H is zero in no row, and one block determines the state") {
  // The thesis prints a third column of zeros after (4.24).
  for (int integer = -2; integer <= 2; ++integer) {
    const auto bins = std::vector<DftBin<double>>(5, DftBin<double>{0.0, 0.0});
    const Eigen::Vector3d x(0.5, 0.3, integer);
    const auto J = dft_block_information<double>(x, bins, 1.0).matrix;
    double others = 0.0;
    for (int d = integer - 2; d <= integer + 2; ++d) {
      others += d == 0 ? 0.0 : 1.0 / (d * d);
    }
    const double pi = std::numbers::pi;
    const double fourth = std::pow(0.5, 4);
    CHECK(J(0, 0) == doctest::Approx(16 * pi * pi * 0.25));
    CHECK(J(1, 1) == doctest::Approx(4 * pi * pi * fourth));
    CHECK(J(1, 2) == doctest::Approx(4 * pi * pi * pi * fourth));
    CHECK(J(2, 2) == doctest::Approx(4 * pi * pi * fourth * (pi * pi + others)));
    CHECK(std::fabs(J(0, 2)) <= 1e-12);
    CHECK(J.determinant() > 0.0);
  }
}

TEST_CASE("each bin more adds information: a larger L decreases no effective SNR") {
  Random random(403);
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d x(random.uniform(0.1, 1.0), random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5));
    Eigen::Matrix3d last = Eigen::Matrix3d::Zero();
    for (std::size_t half = 0; half < 8; ++half) {
      const std::vector<DftBin<double>> bins(2 * half + 1, DftBin<double>{0.0, 0.0});
      const Eigen::Matrix3d J = dft_block_information<double>(x, bins, 1.0).matrix;
      const Eigen::Vector3d more = oracle::symmetric_eigenvalues(J - last);
      CHECK(more(0) >= -1e-12 * J.norm());
      CHECK(more(2) > 0.0);
      last = J;
    }
  }
}

TEST_CASE("symmetries: turned phase, sign of x1, scale; the offset has no period") {
  Random random(404);
  for (int k = 0; k < 500; ++k) {
    const auto design = random_block_design(random);
    const auto start = random_block_estimate(random, 1.5);
    const auto bins = random_bins(random, 2);
    DftBlockEkf<double> tracker(design, start);
    tracker.step(bins);
    const auto& reference = tracker.filtered();
    const double size = 1.0 + reference.state().norm();

    const double angle = random.uniform(-3.0, 3.0);
    auto turned_bins = bins;
    for (auto& bin : turned_bins) {
      bin = {bin.real * std::cos(angle) - bin.imaginary * std::sin(angle),
             bin.real * std::sin(angle) + bin.imaginary * std::cos(angle)};
    }
    auto turned_start = start;
    turned_start.phase += angle;
    DftBlockEkf<double> turned(design, turned_start);
    turned.step(turned_bins);
    CHECK((turned.filtered().state() - reference.state() - angle * Eigen::Vector3d::UnitY()).norm() <=
          1e-8 * size);
    CHECK((turned.filtered().covariance - reference.covariance).norm() <=
          1e-9 * (1.0 + reference.covariance.norm()));

    const Eigen::DiagonalMatrix<double, 3> mirror(-1.0, 1.0, 1.0);
    DftBlockEkf<double> mirrored(
        design, {-start.root_amplitude, start.phase, start.offset, mirror * start.covariance * mirror});
    mirrored.step(bins);
    CHECK(mirrored.filtered().state() == Eigen::Vector3d(mirror * reference.state()));

    // x1 by c, q1 by c^2, bins by c^2, R by c^4; exact for a power of two.
    const Eigen::DiagonalMatrix<double, 3> larger(2.0, 1.0, 1.0);
    auto scaled_design = design;
    scaled_design.q1 *= 4.0;
    scaled_design.r *= 16.0;
    auto scaled_bins = bins;
    for (auto& bin : scaled_bins) {
      bin = {4.0 * bin.real, 4.0 * bin.imaginary};
    }
    DftBlockEkf<double> scaled(scaled_design, {2.0 * start.root_amplitude, start.phase, start.offset,
                                               larger * start.covariance * larger});
    scaled.step(scaled_bins);
    CHECK((scaled.filtered().state() - larger * reference.state()).norm() <= 1e-10 * size);
  }
  const std::vector<DftBin<double>> bins(5, DftBin<double>{0.0, 0.0});
  const auto at = [&](double offset) {
    return dft_block_information<double>({0.5, 0.0, offset}, bins, 1.0).matrix;
  };
  CHECK((at(0.3) - at(1.3)).norm() > 0.01 * at(0.3).norm());
}

TEST_CASE("the update without inverses is (P^-1 + J)^-1, and serves a singular P") {
  Random random(405);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Matrix3d p = random_block_covariance(random);
    const Eigen::Matrix3d j = power_of_ten(random, -3.0, 5.0) * random_block_covariance(random);
    const Eigen::Matrix3d oracle = (p.cast<Real>().inverse() + j.cast<Real>()).inverse().cast<double>();
    CHECK((information_update<double>(p, j) - oracle).norm() <= 1e-9 * oracle.norm());
  }
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  CHECK(information_update<double>(zero, random_block_covariance(random)) == zero);
  const Eigen::Vector3d v(1.0, 2.0, -1.0);
  const Eigen::Matrix3d one = v * v.transpose();
  const Eigen::Matrix3d updated = information_update<double>(one, Eigen::Matrix3d::Identity());
  CHECK((updated - one / 7.0).norm() <= 1e-15);  // 1 + v'v
}

TEST_CASE("without noise it settles on a constant tone, and exact lock is a fixed point") {
  Random random(406);
  for (int run = 0; run < 40; ++run) {
    const Eigen::Vector3d truth(random.uniform(0.2, 0.4), random.uniform(-3.0, 3.0),
                                random.uniform(-1.4, 1.4));
    const DftBlockDesign<double> design{5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0};
    const bool exact = run < 10;
    const Eigen::Vector3d start = exact ? truth : Eigen::Vector3d(truth + Eigen::Vector3d(0.02, 0.2, 0.05));
    DftBlockEkf<double> tracker(
        design, {start(0), start(1), start(2), Eigen::Vector3d(5e-5, 1e-3, 2.5e-3).asDiagonal()});
    double phase = truth(1);
    for (int k = 0; k < 200; ++k) {
      phase += 2.0 * std::numbers::pi * truth(2);
      std::vector<DftBin<double>> bins;
      for (int i = 0; i < 5; ++i) {
        const Complex y = Real(truth(0) * truth(0)) * std::polar(Real(1), Real(phase)) *
                          tone_in_bin(static_cast<Real>(2 - i) + Real(truth(2))).first;
        bins.push_back({static_cast<double>(y.real()), static_cast<double>(y.imag())});
      }
      tracker.step(bins);
      if (exact) {
        REQUIRE(std::fabs(tracker.filtered().offset - truth(2)) <= 1e-9);
      }
    }
    CHECK(std::fabs(tracker.filtered().root_amplitude - truth(0)) <= 1e-8);
    CHECK(std::fabs(tracker.filtered().phase - phase) <= 1e-8);
    CHECK(std::fabs(tracker.filtered().offset - truth(2)) <= 1e-8);
  }
}

TEST_CASE("an even number of bins is refused") {
  const std::vector<DftBin<double>> bins(4);
  const Eigen::Vector3d x(1.0, 0.0, 0.0);
  CHECK_THROWS_AS((void)dft_block_information<double>(x, bins, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::trackers

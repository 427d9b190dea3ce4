#include "papers/dft_block/thesis_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;
using trackers::DftBin;

constexpr double kHalfTurn = std::numbers::pi;

/// A standard normal number, after Box and Muller.
double normal_number(test::Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) * std::cos(2.0 * kHalfTurn * random.uniform());
}

/// The bins of (4.9) for x1^2 = `power`, phase and offset, L = 2, with Gaussian noise in each part.
std::vector<DftBin<double>> bins_of(double power, double phase, double offset, double deviation,
                                    test::Random& random) {
  std::vector<DftBin<double>> bins;
  for (int m = -2; m <= 2; ++m) {
    const double d = offset - m;
    const double sinc = std::fabs(d) < 1e-12 ? 1.0 : std::sin(kHalfTurn * d) / (kHalfTurn * d);
    const std::complex<double> bin = 2.0 * kHalfTurn * power * sinc * std::polar(1.0, phase + kHalfTurn * d);
    bins.push_back(
        {bin.real() + deviation * normal_number(random), bin.imag() + deviation * normal_number(random)});
  }
  return bins;
}

struct Sample {
  double mean, standard_error, variance;
};

/// Errors of (4.35) for a tone with the size 1 in its bin: 2 pi power = 1.
Sample errors_of_starts(double offset, double variance, int runs, std::uint64_t seed) {
  test::Random random(seed);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < runs; ++i) {
    const auto bins =
        bins_of(0.5 / kHalfTurn, random.uniform(-kHalfTurn, kHalfTurn), offset, std::sqrt(variance), random);
    const double error =
        trackers::dft_block_start<double>(std::span<const DftBin<double>>(bins)).offset - offset;
    sum += error;
    squares += error * error;
  }
  const double mean = sum / runs;
  const double spread = squares / runs - mean * mean;
  return {mean, std::sqrt(spread / runs), spread};
}

}  // namespace

TEST_CASE("what chapter 4 says beside its transform is decided as expected") {
  const std::set<std::string> refuted{"chapter-4/filter-bank/printed",
                                      "chapter-4/filter-bank/centre",
                                      "chapter-4/spectral-density/printed",
                                      "chapter-4/zero-rows/printed",
                                      "chapter-4/observability/zero-state",
                                      "chapter-4/ambiguity/printed",
                                      "chapter-4/square-root/root",
                                      "chapter-4/gramian/as-printed",
                                      "chapter-4/gramian/from-zeros",
                                      "chapter-4/controllability/printed",
                                      "chapter-4/table-4.1/snr",
                                      "chapter-4/estimator/unbiased",
                                      "chapter-4/estimator/efficient-samples"};
  const rigor::UpwardRounding upward;
  std::set<std::string> found;
  for (const auto& part :
       {dft_block::filter_bank_claims(), dft_block::model_output_claims(), dft_block::observability_claims(),
        dft_block::tuning_claims(), dft_block::initial_estimate_claims()}) {
    for (const theorems::Statement& statement : part) {
      CAPTURE(statement.id);
      CAPTURE(statement.witness);
      CHECK_FALSE(statement.witness.empty());
      CHECK(found.insert(statement.id).second);
      CHECK(statement.verdict == (refuted.contains(statement.id) ? Verdict::refuted : Verdict::proved));
    }
  }
  CHECK(found.size() == 36);
}

TEST_CASE("the block tracker's own update makes x1 negative on the witness") {
  test::Random random(1);
  const auto bins = bins_of(2.0, kHalfTurn, 0.0, 0.0, random);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(0, 0) = 1.0;
  const trackers::DftBlockEstimate<double> start{1.0, 0.0, 0.0, covariance};
  const trackers::DftBlockDesign<double> design{0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
  const auto updated = trackers::measurement_update(start, std::span<const DftBin<double>>(bins), design);
  CHECK(updated.root_amplitude == doctest::Approx(-0.49056).epsilon(1e-4));
}

TEST_CASE("the Gramian of the tracker's own information, at integers: the corrected entries") {
  const std::vector<DftBin<double>> bins(5, {0.0, 0.0});
  for (const int offset : {-2, -1, 0, 1, 2}) {
    CAPTURE(offset);
    const auto information = [&](double x1) {
      return trackers::dft_block_information<double>(Eigen::Vector3d(x1, 0.3, offset),
                                                     std::span<const DftBin<double>>(bins), 1.0)
          .matrix;
    };
    Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
    back(1, 2) = -2.0 * kHalfTurn;
    const Eigen::Matrix3d gramian = information(1.0) + back.transpose() * information(0.5) * back;
    double slopes = 0.0;
    for (int m = -2; m <= 2; ++m) {
      slopes += m + offset == 0 ? 0.0 : 1.0 / ((m + offset) * (m + offset));
    }
    CHECK(gramian(1, 2) == doctest::Approx(4.0 * kHalfTurn * kHalfTurn * kHalfTurn * (1.0 - 0.0625)));
    CHECK(gramian(2, 2) ==
          doctest::Approx(4.0 * kHalfTurn * kHalfTurn * (kHalfTurn * kHalfTurn + slopes) * 1.0625));
    CHECK(std::fabs(gramian(0, 2)) < 1e-9);
    CHECK(gramian.determinant() > 0.0);
  }
}

TEST_CASE(
    "the initial estimate, simulated: biased at the end, not in the middle, as large as the bound inside") {
  const int runs = static_cast<int>(test::effort(400));
  constexpr double kVariance = 0.002;
  const Sample end = errors_of_starts(2.0, kVariance, runs, 11);
  CHECK(end.mean < -4.0 * end.standard_error);
  const Sample middle = errors_of_starts(0.0, kVariance, runs, 12);
  CHECK(std::fabs(middle.mean) < 5.0 * middle.standard_error);
  // v/i with i = 2.5 at 0.
  CHECK(middle.variance == doctest::Approx(kVariance / 2.5).epsilon(0.3));
}

TEST_CASE("the second-order bias, simulated by a pair of mirrored noises for each run") {
  // Errors of first order cancel in the mean over n and -n, which leaves the bias.
  test::Random random(13);
  constexpr double kVariance = 0.01;
  constexpr double kOffset = 0.25;
  const double deviation = std::sqrt(kVariance);
  // So many are needed to tell the bias from 0.
  const int runs = std::max(3000, static_cast<int>(test::effort(3000)));
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < runs; ++i) {
    test::Random silent(1);
    const auto clean = bins_of(0.5 / kHalfTurn, 0.4, kOffset, 0.0, silent);
    std::vector<DftBin<double>> plus, minus;
    for (const DftBin<double>& bin : clean) {
      const double a = deviation * normal_number(random);
      const double b = deviation * normal_number(random);
      plus.push_back({bin.real + a, bin.imaginary + b});
      minus.push_back({bin.real - a, bin.imaginary - b});
    }
    const auto offset = [](const std::vector<DftBin<double>>& bins) {
      return trackers::dft_block_start<double>(std::span<const DftBin<double>>(bins)).offset;
    };
    const double error = 0.5 * (offset(plus) + offset(minus)) - kOffset;
    sum += error;
    squares += error * error;
  }
  const double mean = sum / runs;
  const double standard_error = std::sqrt((squares / runs - mean * mean) / runs);
  CHECK(std::fabs(mean - -0.0968974 * kVariance) < 5.0 * standard_error);
  CHECK(mean < -3.0 * standard_error);
}

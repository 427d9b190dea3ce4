#include "analysis/single_channel/window_claim.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "analysis/rigor/matrix.hpp"
#include "analysis/single_channel/window_errors.hpp"
#include "analysis/single_channel/window_grid.hpp"
#include "analysis/single_channel/window_proposal.hpp"
#include "tests/analysis/single_channel/phase_attack.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;
using trackers::ToneModel;
using Matrix3 = rigor::Matrix<3>;

constexpr double kQ = 0.005;
constexpr double kR = 0.01;
const Interval kBand = Interval::from_bounds(1.1, 1.12);

ToneModel<Interval> design() {
  return {Interval(kQ), Interval(kQ), Interval(kR), Interval(0.0)};
}

/// A claim that verifies, with the largest radius that leaves room.
WindowClaim good_claim() {
  const auto claims = propose_windows({{kQ, kQ, kR, 0.0}, 1.1, 1.12});
  REQUIRE(claims.size() > 5);
  return with_slack(claims[claims.size() - 3], 0.02);
}

Matrix3 matrix_of(const PhaseCovariance<double>& p) {
  Matrix3 matrix;
  matrix << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return matrix;
}

/// The paper's covariance on the truth, turned into the frame of the true phase.
Matrix3 steady_covariance(double frequency, double phase) {
  Matrix3 turn = Matrix3::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(phase), std::sin(phase), -std::sin(phase), std::cos(phase);
  return turn * test::steady_covariance(kQ, kR, frequency, phase).cast<double>() * turn.transpose();
}

TEST_CASE("a claim verifies, and its bounds hold the steady state of the paper's filter") {
  const rigor::UpwardRounding upward;
  const WindowClaim claim = good_claim();
  const auto floor = verify_window(design(), kBand, claim);
  REQUIRE(floor);
  const auto window = static_cast<int>(claim.shares.size());
  for (int i = 0; i < 12; ++i) {
    const double phase = std::numbers::pi * i / 12;
    const double frequency = 1.1 + 0.02 * i / 12;
    follow_window<double>({kQ, kQ, kR, 0.0}, claim.assumption, {claim.settling, window, 0.0}, phase,
                          frequency,
                          [&](int m, const auto& upper, const auto& lower, const auto& /*predicted*/) {
                            const rigor::NearestRounding nearest;
                            const Matrix3 p = steady_covariance(frequency, phase + m * frequency);
                            CHECK(oracle::least_eigenvalue(matrix_of(upper) - p) > 0.0);
                            CHECK(oracle::least_eigenvalue(p - matrix_of(lower)) > 0.0);
                            CHECK(p(2, 2) < claim.assumption.frequency_variance);
                            return true;
                          });
    const Matrix3 p = steady_covariance(frequency, phase);
    CHECK(p(0, 0) > floor->p11);
    CHECK(p(1, 1) > floor->p22);
    CHECK(p(2, 2) > floor->p33);
  }
}

TEST_CASE("claims that say a little too much do not verify") {
  const rigor::UpwardRounding upward;
  const WindowClaim good = good_claim();
  const auto refused = [&](const auto& change) {
    WindowClaim claim = good;
    change(claim);
    CHECK(!verify_window(design(), kBand, claim));
  };
  for (std::size_t m = 0; m < good.shares.size(); ++m) {
    refused([m](WindowClaim& claim) { claim.shares[m] *= 1.15; });
  }
  refused([](WindowClaim& claim) { claim.curvature *= 0.85; });
  // Little enough for the middles of the cells, and not for their ends.
  refused([](WindowClaim& claim) { claim.curvature /= 1.038; });
  refused([](WindowClaim& claim) { claim.shares.front() *= 1.0635; });
  refused([](WindowClaim& claim) { claim.signal_uncertainty *= 1.25; });
  refused([](WindowClaim& claim) { claim.assumption.frequency_variance *= 0.9; });
  refused([](WindowClaim& claim) { claim.assumption.signal_variance *= 0.9; });
  refused([](WindowClaim& claim) { claim.assumption.signal_variance *= 0.01; });
  refused([](WindowClaim& claim) { claim.assumption.radius *= 1.5; });
  refused([](WindowClaim& claim) { claim.slew = 0.05; });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {nan, infinity, -1.0, 0.0}) {
    refused([odd](WindowClaim& claim) { claim.assumption.radius = odd; });
    refused([odd](WindowClaim& claim) { claim.assumption.signal_variance = odd; });
    refused([odd](WindowClaim& claim) { claim.assumption.loosening = odd; });
    refused([odd](WindowClaim& claim) { claim.curvature = odd; });
    refused([odd](WindowClaim& claim) { claim.curvature_weight = odd; });
    refused([odd](WindowClaim& claim) { claim.signal_uncertainty = odd; });
  }
  refused([nan](WindowClaim& claim) { claim.shares.back() = nan; });
  refused([nan](WindowClaim& claim) { claim.slew = nan; });
  refused([](WindowClaim& claim) { claim.shares.clear(); });
  CHECK(!verify_window(design(), Interval::empty(), good));
  CHECK(!verify_window(design(), Interval::from_bounds(0.0, 0.02), good));
  CHECK(certainly_below_covariances(design(), kBand, good, {Interval(1e-9), Interval(1e-9)}));
  CHECK(!certainly_below_covariances(design(), kBand, good, {Interval(1e3), Interval(1e-9)}));
  CHECK(!certainly_below_covariances(design(), kBand, good, {Interval(1e-9), Interval(1e3)}));
  CHECK(!certainly_below_covariances(design(), kBand, good, {Interval::empty(), Interval(1e-9)}));
}

TEST_CASE("cells side by side are looked at as single cells are, to the bit") {
  const rigor::UpwardRounding upward;
  const WindowClaim good = good_claim();
  WindowClaim wrong = good;
  wrong.shares.back() *= 1.05;  // true in some cells of phase
  int refused = 0;
  int held = 0;
  for (const WindowClaim& claim : {good, wrong}) {
    WindowTask task{design(),
                    claim.assumption,
                    {claim.settling, static_cast<int>(claim.shares.size()), 1e-6},
                    claim.shares.data(),
                    claim.curvature,
                    claim.curvature_weight,
                    claim.signal_uncertainty,
                    1,
                    {Interval(0.001), Interval(), Interval()},
                    {Interval(0.002), Interval(), Interval()}};
    for (int batch = 0; batch < 6; ++batch) {
      WindowCells cells{};
      cells.count = WindowCells::kMost;
      for (int i = 0; i < cells.count; ++i) {
        cells.phase[0][i] = (8 * batch + i) * 0.0655;
        cells.phase[1][i] = (8 * batch + i + 1) * 0.0655;
        cells.frequency[0][i] = 1.1;
        cells.frequency[1][i] = 1.12;
      }
      WindowAnswers alone{};
      detail::check_window_one_by_one()(task, cells, alone);
      for (const auto set : {trackers::InstructionSet::sse2, trackers::InstructionSet::avx2,
                             trackers::InstructionSet::avx512}) {
        if (!trackers::has(set)) {
          continue;
        }
        WindowAnswers found{};
        detail::check_window_of(set)(task, cells, found);
        for (int i = 0; i < cells.count; ++i) {
          CHECK(found.holds[i] == alone.holds[i]);
          (alone.holds[i] ? held : refused) += 1;
          if (alone.holds[i]) {
            CHECK(found.is_below[0][i] == alone.is_below[0][i]);
            CHECK(found.p11[i] == alone.p11[i]);
            CHECK(found.p22[i] == alone.p22[i]);
            CHECK(found.p33[i] == alone.p33[i]);
          }
        }
      }
    }
  }
  CHECK(refused > 0);
  CHECK(held > 0);
}

TEST_CASE("proposals do not depend on the set of instructions, and see what eigenvalues are") {
  const rigor::UpwardRounding upward;
  const WindowRequest request{{kQ, kQ, kR, 0.0}, 1.1, 1.12};
  const WindowClaim claim = good_claim();
  const detail::PhaseGrid grid(request);
  const detail::GridTask task = grid.task(claim.assumption, detail::kLongestWindow);
  const auto& sse2 = detail::grid_functions_of(trackers::InstructionSet::sse2);
  detail::GridView seen{};
  sse2.look(task, seen);
  detail::GridLevels levels{};
  sse2.levels(task, 0.01, 0.02, levels);
  for (const auto set : {trackers::InstructionSet::avx2, trackers::InstructionSet::avx512}) {
    if (!trackers::has(set)) {
      continue;
    }
    const auto& wide = detail::grid_functions_of(set);
    detail::GridView also{};
    wide.look(task, also);
    for (int m = 0; m < detail::kLongestWindow; ++m) {
      CHECK(also.shares[m] == seen.shares[m]);
      CHECK(also.signal_uncertainties[m] == seen.signal_uncertainties[m]);
    }
    for (int i = 0; i < detail::kWeights; ++i) {
      CHECK(also.curvatures[i] == seen.curvatures[i]);
    }
    detail::GridLevels also_levels{};
    wide.levels(task, 0.01, 0.02, also_levels);
    for (int i = 0; i < detail::kParts; ++i) {
      CHECK(also_levels.levels[i] == levels.levels[i]);
    }
    CHECK(wide.variances(task).signal == sse2.variances(task).signal);
    CHECK(wide.variances(task).frequency == sse2.variances(task).frequency);
  }
  // The same by Eigen's solvers, at each point of the grid.
  std::array<double, detail::kLongestWindow> shares{};
  shares.fill(1.0);
  double curvature = 0.0;
  double level = 0.0;
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    for (int i = 0; i < detail::kGridPhases; ++i) {
      follow_window<double>(
          request.design, claim.assumption, {detail::kSettling, detail::kLongestWindow, 0.0},
          std::numbers::pi * i / detail::kGridPhases, 1.1 + share * (1.12 - 1.1),
          [&](int m, const auto& upper, const auto& lower, const auto& /*predicted*/) {
            const rigor::NearestRounding nearest;
            double& least = shares[static_cast<std::size_t>(m - 1)];
            least = std::min(least, oracle::relative_eigenvalues(matrix_of(lower), matrix_of(upper))(0));
            if (m == detail::kLongestWindow) {
              const double weight = detail::grid_weight(3);
              Matrix3 c;
              c << 0.0, 0.0, std::sqrt(weight), 1.0 / std::sqrt(weight), 0.0, 0.0, 0.0,
                  1.0 / std::sqrt(weight), 0.5 / std::sqrt(weight);
              curvature = std::max(curvature,
                                   -0.5 * oracle::least_eigenvalue(-(c * matrix_of(upper) * c.transpose())));
              const Matrix3 wanted =
                  rigor::Vector<3>(1e-4 / 0.3, 1e-4 / 0.3, 4e-4 / (1.0 - 0.3)).asDiagonal();
              level = std::max(level, std::sqrt(oracle::relative_eigenvalues(wanted, matrix_of(lower))(2)));
            }
            return true;
          });
    }
  }
  for (std::size_t m = 0; m < shares.size(); ++m) {
    CHECK(seen.shares[m] == doctest::Approx(shares[m]).epsilon(1e-7));
  }
  CHECK(seen.curvatures[3] == doctest::Approx(curvature).epsilon(1e-7));
  CHECK(levels.levels[2] == doctest::Approx(level).epsilon(1e-7));
}

TEST_CASE("the recursion of the errors") {
  const rigor::UpwardRounding upward;
  const WindowClaim claim = good_claim();
  const Interval zero(0.0);
  const WindowErrors quiet(design(), claim, zero, zero);
  CHECK(quiet.keeps_radius());
  const Interval input = quiet.largest_input();
  const Interval noise = Interval(input.lower()) * sqrt(Interval(kR));
  CHECK(WindowErrors(design(), claim, Interval(0.999 * noise.lower()), zero).keeps_radius());
  CHECK(!WindowErrors(design(), claim, Interval(1.001 * noise.upper()), zero).keeps_radius());
  CHECK(!WindowErrors(design(), claim, Interval::empty(), zero).keeps_radius());
  CHECK(!WindowErrors(design(), claim, zero, Interval::entire()).keeps_radius());
  // Without noise errors die out, with it they do not.
  CHECK(quiet.ultimate() < 1e-12);
  const WindowErrors noisy(design(), claim, Interval(0.5 * noise.lower()), zero);
  CHECK(noisy.ultimate() > 0.0);
  CHECK(noisy.ultimate() < claim.assumption.radius);
  CHECK(noisy.keeps(noisy.ultimate() * (1.0 + 1e-9)));
  CHECK(!quiet.levels(1.01 * claim.assumption.radius, 1));
  const auto levels = quiet.levels(0.5 * claim.assumption.radius, 200);
  REQUIRE(levels);
  CHECK(levels->back() < 1e-6 * levels->front());
}

TEST_CASE("rounding is in the recursion of the errors, and of the covariance") {
  const rigor::UpwardRounding upward;
  WindowClaim claim = good_claim();
  const Interval zero(0.0);
  const Interval noise(1e-5);
  const WindowErrors exact(design(), claim, noise, zero);
  constexpr double kError = 1e-7;
  constexpr double kCovariance = 1e-4;
  claim.assumption.rounding = {kError, kCovariance};
  const WindowErrors rounded(design(), claim, noise, zero);
  // By hand: g^m for the past and for noise, g for what is curved, and rho for each sample.
  const double g = 1.0 / std::sqrt(1.0 - kCovariance);
  const double level = 0.5 * claim.assumption.radius;
  const auto window = static_cast<int>(claim.shares.size());
  const double a = claim.assumption.frequency_variance;
  const double curved = g * (claim.curvature + claim.assumption.radius * a * std::sqrt(a) / 6.0) /
                        std::sqrt(claim.signal_uncertainty);
  double sum = 0.0;
  for (int j = 0; j < window; ++j) {
    sum += std::pow(g, j) * (j == 0 ? 1.0 : std::sqrt(1.0 - claim.shares[static_cast<std::size_t>(j - 1)]));
  }
  const double expected =
      (std::pow(g, window) * std::sqrt(1.0 - claim.shares.back()) + curved * sum * level) * level +
      std::pow(g, window) * std::sqrt(window) * 1e-5 / std::sqrt(kR) + kError * sum;
  CHECK(rounded.after_window(Interval(level)).upper() == doctest::Approx(expected).epsilon(1e-12));
  CHECK(rounded.ultimate() > exact.ultimate());
  CHECK(rounded.rate().lower() > exact.rate().upper());
  CHECK(rounded.largest_input().upper() < exact.largest_input().lower());
  const double most = rounded.largest_input().lower() * std::sqrt(kR);
  CHECK(WindowErrors(design(), claim, Interval(0.9999 * most), zero).keeps_radius());
  CHECK(!WindowErrors(design(), claim, Interval(1.0001 * most), zero).keeps_radius());
  // The covariance moves by a ten-thousandth a step, which the slack of the claim allows for.
  CHECK(verify_window(design(), kBand, claim));
  for (const StepRounding& odd :
       {StepRounding{0.0, 0x1.01p-8}, StepRounding{0.0, -1e-9}, StepRounding{-1e-9, 0.0},
        StepRounding{0.0, std::nan("")}, StepRounding{std::nan(""), 0.0}, kUnboundedRounding}) {
    claim.assumption.rounding = odd;
    CHECK(!verify_window(design(), kBand, claim));
  }
}

TEST_CASE("the bounds of a window hold covariances that each step moves by its rounding, and little more") {
  const rigor::UpwardRounding upward;
  // Without errors, so that rounding is what decides.
  WindowClaim claim = good_claim();
  claim.assumption.radius = 1e-9;
  claim.assumption.loosening = 1e-6;
  constexpr double kShare = 0.01;
  constexpr double kFrequency = 1.11;
  claim.assumption.rounding = {0.0, kShare};
  const auto step = [](const PhaseCovariance<double>& p, double share, int sample) {
    const double phase = sample * kFrequency;
    return scaled(1.0 + share,
                  updated(predicted(p, 1.0, 0.0, {kQ, kQ, kR, 0.0}), std::sin(phase), std::cos(phase), kR));
  };
  // From long ago, a little larger each time; and from zero, a little smaller.
  PhaseCovariance<double> large = diagonal(kQ, kQ);
  for (int k = -200; k <= 0; ++k) {
    large = step(large, kShare, k);
  }
  PhaseCovariance<double> small = diagonal(0.0, 0.0);
  int seen = 0;
  follow_window<double>({kQ, kQ, kR, 0.0}, claim.assumption, {30, 8, 0.0}, 0.0, kFrequency,
                        [&](int m, const auto& upper, const auto& lower, const auto& /*predicted*/) {
                          large = step(large, kShare, m);
                          small = step(small, -kShare, m);
                          CHECK(oracle::least_eigenvalue(matrix_of(upper) - matrix_of(large)) > 0.0);
                          CHECK(oracle::least_eigenvalue(matrix_of(small) - matrix_of(lower)) > 0.0);
                          CHECK(oracle::least_eigenvalue(1.02 * matrix_of(large) - matrix_of(upper)) > 0.0);
                          CHECK(oracle::least_eigenvalue(matrix_of(lower) - 0.98 * matrix_of(small)) > 0.0);
                          ++seen;
                          return true;
                        });
  CHECK(seen == 8);
}

}  // namespace
}  // namespace veritrack::single_channel

// One block of the DFT-block tracker with L = 2: the template against the same filter written by hand for
// five bins.
//
// The aim is at most 1.5 times the time of the hand-written one, which has the printed Jacobian bin by bin,
// not for integer offsets, and inverts P twice.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>

#include "trackers/dft_block/dft_block_ekf.hpp"

namespace {

using namespace veritrack::trackers;

constexpr double kOffset = 0.3;
constexpr DftBlockDesign<double> kDesign{5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0};

/// (4.16)-(4.17) at a phase; exact lock, so that the tracker stays where it is.
std::array<DftBin<double>, 5> bins_at(double phase) {
  std::array<DftBin<double>, 5> bins{};
  for (int i = 0; i < 5; ++i) {
    const double scale = 0.08 / (2 - i + kOffset);
    const double turned = phase + 2.0 * detail::kPi * kOffset;
    bins[static_cast<std::size_t>(i)] = {scale * (std::sin(turned) - std::sin(phase)),
                                         scale * (std::cos(phase) - std::cos(turned))};
  }
  return bins;
}

/// Ten blocks turn the phase by three full turns.
const std::array<std::array<DftBin<double>, 5>, 10>& blocks() {
  static const auto result = [] {
    std::array<std::array<DftBin<double>, 5>, 10> all{};
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k] = bins_at(2.0 * detail::kPi * kOffset * static_cast<double>(k + 1));
    }
    return all;
  }();
  return result;
}

DftBlockEstimate<double> start() {
  return {std::sqrt(0.08), 0.0, kOffset, Eigen::Vector3d(5e-5, 1e-3, 2.5e-3).asDiagonal()};
}

void hand_written_step(Eigen::Vector3d& x, Eigen::Matrix3d& p, const std::array<DftBin<double>, 5>& bins) {
  constexpr double kTurn = 2.0 * detail::kPi;
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = kTurn;
  x(1) += kTurn * x(2);
  Eigen::Matrix3d m = f * p * f.transpose();
  m.diagonal() += Eigen::Vector3d(kDesign.q1, kDesign.q2, kDesign.q3);
  const double s0 = std::sin(x(1));
  const double c0 = std::cos(x(1));
  const double s1 = std::sin(x(1) + kTurn * x(2));
  const double c1 = std::cos(x(1) + kTurn * x(2));
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int i = 0; i < 5; ++i) {
    const double inverse = 1.0 / (2 - i + x(2));
    const double amplitude = x(0) * x(0) * inverse;
    const double a = s1 - s0;
    const double b = c0 - c1;
    const Eigen::Vector3d re(2.0 * x(0) * inverse * a, -amplitude * b,
                             amplitude * (kTurn * c1 - inverse * a));
    const Eigen::Vector3d im(2.0 * x(0) * inverse * b, amplitude * a, amplitude * (kTurn * s1 - inverse * b));
    information += re * re.transpose() + im * im.transpose();
    const auto& bin = bins[static_cast<std::size_t>(i)];
    vector += re * (bin.real - amplitude * a) + im * (bin.imaginary - amplitude * b);
  }
  p = (m.inverse() + information / kDesign.r).inverse();
  x += p * (vector / kDesign.r);
}

void step_template(benchmark::State& state) {
  DftBlockEkf<double> tracker(kDesign, start());
  std::size_t k = 0;
  for (auto _ : state) {
    tracker.step(blocks()[k]);
    k = (k + 1) % blocks().size();
  }
  benchmark::DoNotOptimize(tracker.filtered().offset);
}
BENCHMARK(step_template);

void step_by_hand(benchmark::State& state) {
  Eigen::Vector3d x = start().state();
  Eigen::Matrix3d p = start().covariance;
  std::size_t k = 0;
  for (auto _ : state) {
    hand_written_step(x, p, blocks()[k]);
    k = (k + 1) % blocks().size();
  }
  benchmark::DoNotOptimize(x(2));
}
BENCHMARK(step_by_hand);

}  // namespace

BENCHMARK_MAIN();

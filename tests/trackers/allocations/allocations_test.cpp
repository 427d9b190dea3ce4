// A tracker's step takes no memory, so that it can run where there is none to be had, and for ever. This
// program has its own malloc, which counts; under the sanitizers, which have theirs, nothing is counted.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

#include "trackers/dft_block/block_dft.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/dft_block/lock_monitor.hpp"
#include "trackers/kkl_observer/adaptive_oscillator_observer.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"
#include "trackers/notch/adaptive_notch.hpp"
#include "trackers/pendulum/impulsive_pendulum.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/regulator/frequency_regulator.hpp"
#include "trackers/regulator/self_tuning_regulator.hpp"
#include "trackers/regulator/vibrating_plant.hpp"
#include "trackers/sam/sam_filter.hpp"
#include "trackers/signals/hilbert_filter.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define VERITRACK_SANITIZED
#endif
#endif

namespace {
std::size_t taken = 0;
}  // namespace

#ifndef VERITRACK_SANITIZED
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++taken;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++taken;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++taken;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++taken;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace veritrack::trackers {
namespace {

constexpr int kSteps = 1000;

/// How often `step(k)` takes memory, k = 0 ... kSteps - 1, the first time included.
template <typename Step>
std::size_t taken_by(const Step& step) {
  const std::size_t before = taken;
  for (int k = 0; k < kSteps; ++k) {
    step(k);
  }
  return taken - before;
}

double tone(int k) {
  return std::sin(0.7 * k + 0.2);
}

ToneEstimate<double> tone_start() {
  return {0.0, 1.0, 0.69, {1.0, 0.0, 1.0, 0.0, 0.0, 0.01}};
}

TEST_CASE("what takes memory is counted") {
#ifndef VERITRACK_SANITIZED
  CHECK(taken_by([](int) { std::make_unique<double>(1.0); }) == kSteps);
  CHECK(taken_by([](int) { Eigen::MatrixXd::Zero(3, 3).eval(); }) == kSteps);
  CHECK(taken_by([](int) { std::free(std::calloc(3, 8)); }) == kSteps);
#endif
}

TEST_CASE("trackers of a sample") {
  QuadratureEkf<double> quadrature({0.01, 1e-4, 0.1, 0.0}, tone_start());
  CHECK(taken_by([&](int k) { quadrature.step(std::cos(0.7 * k), tone(k)); }) == 0);
  SingleChannelEkf<double> single({diagonal_process_noise(0.01, 1e-4), 0.1, 0.0}, tone_start());
  CHECK(taken_by([&](int k) { single.step(tone(k)); }) == 0);
  KklObserver<double, 4> kkl({Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), 3e-4}, 0.01);
  double sum = 0.0;
  CHECK(taken_by([&](int k) {
          kkl.step_interpolated(tone(k), tone(k + 1));
          sum += kkl.state()(2);
        }) == 0);
  AdaptiveOscillatorObserver adaptive({1.0, 1.0, Eigen::Vector3d(1.0, 1.0, 1.0)}, 0.7, 0.01);
  CHECK(taken_by([&](int k) { adaptive.step(tone(k), tone(k + 1)); }) == 0);
  RealNotch<double> real({0.9, 0.01, 2.0}, 0.7);
  CHECK(taken_by([&](int k) { real.step(tone(k)); }) == 0);
  QuadratureNotch<double> both({0.9, 0.01, 2.0}, 0.7);
  CHECK(taken_by([&](int k) { both.step(std::cos(0.7 * k), tone(k)); }) == 0);
  HilbertFilter hilbert(15);
  CHECK(taken_by([&](int k) { sum += hilbert.push(tone(k)) ? hilbert.quadrature() : 0.0; }) == 0);
  CHECK(std::isfinite(sum));
}

TEST_CASE("Zarchan's four filters") {
  const ZarchanDesign<double> design{0.1, 0.25, 0.3, 0.2};
  const ZarchanEstimate<double, 3> start{Eigen::Vector3d(0.1, 1.0, 0.7), Eigen::Matrix3d::Identity()};
  SinePhaseEkf<double> phase(design, start);
  CHECK(taken_by([&](int k) { phase.step(tone(k)); }) == 0);
  SineKnownAmplitudeEkf<double> known(design, 1.0, {Eigen::Vector2d(0.1, 0.7), Eigen::Matrix2d::Identity()});
  CHECK(taken_by([&](int k) { known.step(tone(k)); }) == 0);
  OscillatorEkf<double> oscillator(design, start);
  CHECK(taken_by([&](int k) { oscillator.step(tone(k)); }) == 0);
  SquaredFrequencyEkf<double> squared(design, start);
  CHECK(taken_by([&](int k) { squared.step(tone(k)); }) == 0);
}

TEST_CASE("the tracker of blocks, its transform and its monitor") {
  BlockDft<double> transform(64, 8, 2);
  DftBlockEkf<double> tracker({5e-5, 1e-3, 2.5e-3, 12.5 / 4096.0, 0.0, 0.0},
                              {0.3, 0.1, 0.2, Eigen::Vector3d(0.005, 0.7, 0.01).asDiagonal()});
  BlockLockMonitor<double> monitor(2);
  int blocks = 0;
  CHECK(taken_by([&](int k) {
          if (transform.push(std::sin(2.0 * std::numbers::pi * 8.2 / 64.0 * k))) {
            tracker.step(transform.bins());
            monitor.push(transform.bins(), tracker.filtered());
            ++blocks;
          }
        }) == 0);
  CHECK(blocks == kSteps / 64);
}

TEST_CASE("regulators and their plant") {
  using Vector = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  const Vector theta = Vector::Constant(0.5);
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), 0.7, 0.1, 0.2);
  FrequencyRegulator<double, 1> ideal(thesis_example_plant<double>());
  double control = 0.0;
  CHECK(taken_by([&](int) { control = ideal.step(plant.step(control), [](double) { return 0.7; }); }) == 0);
  using Monitored = MonitoredLeastSquares<double, 3>;
  SelfTuningRegulator<double, 3, Monitored> monitored(Monitored(theta, Matrix::Identity(), 1.0, 1e6));
  CHECK(taken_by([&](int k) { control = monitored.step(tone(k)); }) == 0);
  using Efra = EfraLeastSquares<double, 3>;
  SelfTuningRegulator<double, 3, Efra> efra(Efra(thesis_efra_design<double>(), theta, Matrix::Identity()));
  CHECK(taken_by([&](int k) { control = efra.step(tone(k)); }) == 0);
}

TEST_CASE("the median filter and the pendulum") {
  auto median = median_filter<double>(7);
  double sum = 0.0;
  CHECK(taken_by([&](int k) { sum += median.step(tone(k)); }) == 0);
  auto model = chaotic_pendulum<double>();
  model.substeps = 10;
  ImpulsivePendulum<double> pendulum(model, {0.1, 0.2});
  CHECK(taken_by([&](int) { pendulum.step(); }) == 0);
  CHECK(std::isfinite(sum + pendulum.state().angle));
}

}  // namespace
}  // namespace veritrack::trackers

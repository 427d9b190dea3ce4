#include "trackers/regulator/frequency_regulator.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;

/// Poles and zeros of a stable plant of order two with a stable inverse.
PlantModel<double, 2> random_plant(Random& random) {
  const double p1 = random.uniform(-0.9, 0.9);
  const double p2 = random.uniform(-0.9, 0.9);
  const double b = random.uniform(0.5, 3.0);
  PlantModel<double, 2> plant;
  plant.a << -(p1 + p2), p1 * p2;
  plant.b << b, -b * random.uniform(-0.9, 0.9);
  return plant;
}

TEST_CASE("the disturbance is that of its two impulses, the printed factors two samples late") {
  Random random(431);
  for (int run = 0; run < 50; ++run) {
    const double omega = random.uniform(0.1, 3.0);
    const double first = random.uniform(-1.0, 1.0);
    const double second = random.uniform(-1.0, 1.0);
    VibratingPlant<double, 1> plant(thesis_example_plant<double>(), omega, first, second);
    for (int k = 0; k < 40; ++k) {
      const double y = plant.step(0.0);
      const double v =
          (first * std::sin((k + 2) * omega) + second * std::sin((k + 3) * omega)) / std::sin(omega);
      CHECK(plant.disturbance() == doctest::Approx(v).epsilon(1e-9));
      CHECK(y == plant.disturbance());
    }
  }
}

TEST_CASE("the plant is its difference equation") {
  Random random(432);
  const auto model = random_plant(random);
  Plant<double, 2> plant(model);
  std::vector<double> u(52, 0.0);
  std::vector<double> x(52, 0.0);
  for (std::size_t k = 2; k < 52; ++k) {
    u[k - 1] = random.uniform(-1.0, 1.0);
    x[k] = -model.a(0) * x[k - 1] - model.a(1) * x[k - 2] + model.b(0) * u[k - 1] + model.b(1) * u[k - 2];
    CHECK(plant.step(u[k - 1]) == doctest::Approx(x[k]).epsilon(1e-12));
  }
}

TEST_CASE("A_1 y(k+1) = 2 (cos omega - c_k) A_1 v(k), for any frequencies and any plant") {
  Random random(433);
  for (int run = 0; run < 100; ++run) {
    const auto model = random_plant(random);
    const double omega = random.uniform(0.1, 3.0);
    VibratingPlant<double, 2> plant(model, omega, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    FrequencyRegulator<double, 2> regulator(model);
    std::vector<double> y;
    std::vector<double> v;
    double input = 0.0;
    double last_estimate = 0.0;
    for (std::size_t k = 0; k < 60; ++k) {
      y.push_back(plant.step(input));
      v.push_back(plant.disturbance());
      if (k >= 4) {
        const auto filtered = [&](const std::vector<double>& s, std::size_t i) {
          return s[i] + model.a(0) * s[i - 1] + model.a(1) * s[i - 2];
        };
        CHECK(std::fabs(filtered(y, k) -
                        2.0 * (std::cos(omega) - std::cos(last_estimate)) * filtered(v, k - 1)) <= 1e-9);
      }
      const double estimate = omega + random.uniform(-0.05, 0.05);
      input = regulator.step(y.back(), [&](double disturbance) {
        CHECK(std::fabs(disturbance - v.back()) <= 1e-9);
        return estimate;
      });
      last_estimate = estimate;
    }
  }
}

TEST_CASE("the example's law is the one written out, and the ideal one leaves y = 0") {
  const double omega = std::numbers::pi / 6.0;
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), omega, 1.0, 0.3);
  FrequencyRegulator<double, 1> regulator(thesis_example_plant<double>());
  double u1 = 0.0;
  double u2 = 0.0;
  double y1 = 0.0;
  double y2 = 0.0;
  for (int k = 0; k < 80; ++k) {
    const double y = plant.step(u1);
    const double c = std::cos(omega);
    const double written = 2.0 * c * u1 - u2 - (2.0 * c * y - (1.0 + c) * y1 + 0.5 * y2) / 3.0;
    const double u = regulator.step(y, [&](double) { return omega; });
    CHECK(u == doctest::Approx(written).epsilon(1e-9));
    u2 = u1;
    u1 = u;
    y2 = y1;
    y1 = y;
    if (k > 60) {
      CHECK(std::fabs(y) <= 1e-11);
    }
  }
}

TEST_CASE("white measurement noise at a constant frequency comes through as 1 - 2 c q^-1 + q^-2") {
  Random random(434);
  const double omega = 0.8;
  const double c = std::cos(omega);
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), omega, 0.0, 0.0);
  FrequencyRegulator<double, 1> regulator(thesis_example_plant<double>());
  double input = 0.0;
  double n1 = 0.0;
  double n2 = 0.0;
  for (int k = 0; k < 300; ++k) {
    const double noise = random.uniform(-1.0, 1.0);
    const double y = plant.step(input, noise);
    CHECK(std::fabs(y - (noise - 2.0 * c * n1 + n2)) <= 1e-10);
    n2 = n1;
    n1 = noise;
    input = regulator.step(y, [&](double) { return omega; });
  }
}

TEST_CASE("with a tracker in the loop the vibration vanishes, and follows the frequency") {
  SingleChannelEkf<double> tracker(
      {.process_noise = identity_process_noise(0.005), .r = 0.01, .epsilon = 0.0},
      {.in_phase = 1.0, .quadrature = 0.0, .frequency = 0.6, .covariance = identity_process_noise(0.005)});
  const double omega = std::numbers::pi / 6.0;
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), omega, 0.5, 0.3);
  FrequencyRegulator<double, 1> regulator(thesis_example_plant<double>());
  double input = 0.0;
  double last = 0.0;
  for (int k = 0; k < 1200; ++k) {
    if (k == 600) {
      plant.set_frequency(omega + 0.02);
    }
    const double y = plant.step(input);
    input = regulator.step(y, [&](double v) {
      tracker.step(v);
      return tracker.filtered().frequency;
    });
    if (k > 500 && (k < 600 || k > 1100)) {
      last = std::max(last, std::fabs(y));
    }
  }
  CHECK(last <= 1e-6);
}

}  // namespace
}  // namespace veritrack::trackers

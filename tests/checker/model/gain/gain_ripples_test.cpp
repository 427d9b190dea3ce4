// Ripples by averaging: the change of variables, and what it does not say, against loops of one channel in
// doubles.
#include "checker/model/gain/gain_ripples.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "checker/model/gain/stability.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"
#include "tests/checker/model/gain/type_2_simulation.hpp"

namespace veritrack::checker {
namespace {

using test::Type2Simulation;
using Complex = std::complex<double>;

const double kHalfTurn = std::acos(-1.0);

/// Pi of a network of two states with one ripple, in doubles.
std::array<Complex, 2> response_to(const GainNetwork& network, double omega) {
  const GainRipple& ripple = network.ripples.at(0);
  const Complex turn = std::polar(1.0, static_cast<double>(ripple.turns) * omega);
  const auto a = [&](std::size_t i, std::size_t j) {
    return (i == j ? turn : 0.0) - network.matrix[i][j].near();
  };
  const auto g = [&](std::size_t i) {
    const InputFactor& factor = network.inputs[ripple.input].column[i];
    return Complex(factor.first.near(), -factor.second.near()) * turn;
  };
  const Complex determinant = a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
  return {(a(1, 1) * g(0) - a(0, 1) * g(1)) / determinant, (a(0, 0) * g(1) - a(1, 0) * g(0)) / determinant};
}

TEST_CASE("averaging is a change of variables") {
  // e = -2 y (p sin + q cos): about the steady state -p (sin l + sin(2 phi' + l)) - q (cos l + cos(2 phi' +
  // l)), and noise.
  for (const auto& [p, q] : std::vector<std::pair<double, double>>{{1.0, 0.0}, {0.75, 0.5}}) {
    test::Loop loop = test::type_2_loop("0.0625");
    loop.step = "e = -2*y*(" + std::to_string(p) + "*sin(theta + w) + " + std::to_string(q) +
                "*cos(theta + w))\nw' = w + c_ki*e\ntheta' = theta + w + d_kp*e\n";
    const GainNetwork network = loop.network();
    REQUIRE(network.ripples.size() == 1);
    const GainRipple& ripple = network.ripples[0];
    REQUIRE(std::abs(ripple.turns) == 2);
    const double sign = ripple.turns > 0 ? 1.0 : -1.0;
    const double ki = 0.0625 * 0.0625;
    const double kp = 2 * 0.7071 * 0.0625;
    const std::array<double, 2> gains{kp, ki};
    const double omega = 0.37;
    const std::array<Complex, 2> response = response_to(network, omega);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(std::abs(response[i]) * 1.0 <= ripple.of_state[i].upper_double());
      CHECK(network.inputs[ripple.input].column[i].first.near() == doctest::Approx(-q * gains[i]));
      CHECK(network.inputs[ripple.input].column[i].second.near() == doctest::Approx(-p * sign * gains[i]));
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<> draw(-1.0, 1.0);
    std::array<double, 2> xi{0.2, -0.01};
    double phi = 0.7;
    std::array<double, 2> eta{};
    Complex z;
    double error = 0.0;
    for (int k = 0; k < 500; ++k) {
      const double lambda = xi[0] + xi[1];
      const Complex now = std::polar(1.0, sign * lambda);
      std::array<double, 2> here{};
      for (std::size_t i = 0; i < 2; ++i) {
        here[i] = xi[i] - std::real(response[i] * std::polar(1.0, sign * 2.0 * phi) * now);
        if (k > 0) {
          // eta of the sample before has all other inputs and A applied; the drift is left.
          const Complex drift = response[i] * std::polar(1.0, sign * 2.0 * phi) * (now - z);
          error = std::max(error, std::abs(here[i] - (eta[i] - std::real(drift))));
        }
      }
      const double v = 0.3 * draw(random);
      const double next_phase = phi + omega;
      const double angle = next_phase + lambda;
      const double e = -2.0 * (std::cos(next_phase) + v) * (p * std::sin(angle) + q * std::cos(angle));
      const double other = -2.0 * v * (p * std::sin(angle) + q * std::cos(angle)) - p * std::sin(lambda) -
                           q * std::cos(lambda) + p * lambda;
      for (std::size_t i = 0; i < 2; ++i) {
        eta[i] =
            network.matrix[i][0].near() * here[0] + network.matrix[i][1].near() * here[1] + gains[i] * other;
      }
      z = now;
      xi = {xi[0] + xi[1] + kp * e, xi[1] + ki * e};
      phi = next_phase;
    }
    CHECK(error < 1e-12);
  }
}

TEST_CASE("the mean of a ripple whose angle is in step with it is not 0") {
  // An output with the double frequency, at a frequency far below that at which the angle is averaged.
  test::Loop loop = test::type_2_loop("0.002");
  loop.states.emplace_back("out");
  loop.step += "out' = w + sin(2*theta)\n";
  loop.frequency = "out";
  loop.steady.push_back({0, 0.0, 1.0});
  loop.lowest = 0.02;
  loop.highest = 0.0201;
  const GainNetwork network = loop.network();
  const GainBounds bounds(network, 16384, 64);
  REQUIRE(bounds.is_certain());
  const auto errors = bounds.errors(zero, zero, std::vector<Ball>(3));
  REQUIRE(errors.has_value());
  Type2Simulation simulation(0.002, 0.02003, 0.0);
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < 400'000; ++k) {
    const double out = std::sin(2.0 * (simulation.phase() + simulation.phase_error()));
    if (k >= 50'000) {
      sum += out + simulation.frequency_error();
      ++count;
    }
    simulation.step(0.0);
  }
  const double mean = std::abs(sum / count);
  CHECK(mean <= errors->mean_in_long_run().upper_double());
  CHECK(mean > 0.05);  // as large as the ripple itself, which has no part in it at a constant angle
}

TEST_CASE("with ripples the matrix says nothing on how fast errors shrink") {
  test::Loop loop = test::type_2_loop("0.5");
  loop.parameters = {{"c_ki", "1"}, {"d_kp", "1"}};
  const GainNetwork network = loop.network();
  CHECK(all_eigenvalues_within(network.matrix, Ball(0.01)));
  CHECK_FALSE(network.ripples.empty());
  // To first order, without averaging.
  double growth = 0.0;
  std::array<double, 2> xi{1.0, 0.0};
  for (int k = 1; k <= 10'000; ++k) {
    const double e = -(1.0 + std::cos(2.0 * 0.3 * k)) * (xi[0] + xi[1]);
    xi = {xi[0] + xi[1] + e, xi[1] + e};
    const double length = std::hypot(xi[0], xi[1]);
    growth += std::log(length) / 10'000;
    xi = {xi[0] / length, xi[1] / length};
  }
  CHECK(std::exp(growth) > 0.99);
}

TEST_CASE("steps with powers of the sample are covered") {
  test::Loop loop = test::type_2_loop("0.02");
  loop.step =
      "e = y*(1 - 0.5*y^2)*cos(theta + 2*w) + 0.3*y^2*sin(2*theta) + 0.2*sin(theta)/(2 + cos(theta)) - "
      "y*w\nw' = w + 0.01*e\ntheta' = theta + w + 0.1*e\n";
  loop.least_amplitude = loop.largest_amplitude = 1.25;
  const GainNetwork network = loop.network();
  std::mt19937 random(9);
  const auto draw = [&](double most) { return std::uniform_real_distribution<>(-most, most)(random); };
  double closest = 0.0;
  for (int trial = 0; trial < 2'000; ++trial) {
    const double noise = 0.2 * std::abs(draw(1.0));
    const double omega = 0.35 + draw(0.15);
    const double phi = draw(kHalfTurn);
    const std::array<double, 2> xi{draw(0.4), draw(0.05)};
    const double theta = phi + xi[0];
    const double w = omega + xi[1];
    const double y = 1.25 * std::cos(phi + omega) + (trial % 2 == 0 ? noise : -noise);
    const double e = y * (1 - 0.5 * y * y) * std::cos(theta + 2 * w) + 0.3 * y * y * std::sin(2 * theta) +
                     0.2 * std::sin(theta) / (2 + std::cos(theta)) - y * w;
    const std::array<double, 2> next{xi[0] + xi[1] + 0.1 * e, xi[1] + 0.01 * e};
    std::vector<double> sizes;
    std::vector<Ball> forms;
    const auto size_of = [&](const GainInput& input) {
      std::vector<Ball> about;
      for (const std::size_t form : input.about) {
        const GainForm& each = network.forms[form];
        double bound = std::abs(each.row[0].near() * xi[0] + each.row[1].near() * xi[1]);
        for (const auto& [source, factor] : each.direct) {
          bound += std::hypot(abs(factor.first).upper_double(), abs(factor.second).upper_double()) *
                   sizes.at(source);
        }
        about.emplace_back(bound + 1e-12);
      }
      return (input.is_remainder() ? input.at_bounds(about) : input.size(Ball(noise), zero)).upper_double();
    };
    for (const GainInput& input : network.inputs) {
      sizes.push_back(size_of(input));
    }
    for (std::size_t i = 0; i < 2; ++i) {
      double left = next[i] - network.matrix[i][0].near() * xi[0] - network.matrix[i][1].near() * xi[1];
      double spread = 0.0;
      for (std::size_t l = 0; l + 2 < network.inputs.size(); ++l) {  // without drifts
        const InputFactor& factor = network.inputs[l].column[i];
        spread += std::hypot(abs(factor.first).upper_double(), abs(factor.second).upper_double()) * sizes[l];
      }
      for (std::size_t j = 0; j < 2; ++j) {
        spread += network.matrix[i][j].radius().upper_double() * std::abs(xi[j]);
      }
      closest = std::max(closest, std::abs(left) / spread);
    }
  }
  CHECK(closest <= 1.0);
  CHECK(closest > 0.2);
}

}  // namespace
}  // namespace veritrack::checker

// The network of a loop, attacked: one sample from random errors, at random phases, frequencies, amplitudes
// and noise, is within its matrix, its columns and the sizes of its inputs at what the forms are there.
#include "analysis/model/gain/loop_network.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/analysis/model/gain_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

struct NetworkCase {
  test::ExampleTracker tracker;
  std::vector<SteadyValue> steady;
  Interval amplitude = Interval(1.0);
  double errors = 0.5, noise = 0.3;
  bool shares_noise = false;
};

double nearest_turn_off(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The state at these errors; vectors have a random length.
Eigen::VectorXd state_with(const NetworkCase& of, const Eigen::VectorXd& errors, double phase, double omega,
                           test::Random& random) {
  Eigen::VectorXd state = errors;
  for (std::size_t i = 0; i < of.steady.size(); ++i) {
    const SteadyValue& each = of.steady[i];
    state(static_cast<Eigen::Index>(i)) += each.turns * phase + each.constant + each.per_frequency * omega;
  }
  for (std::size_t i = 0; i < of.steady.size(); ++i) {
    if (of.steady[i].imaginary) {
      const std::complex<double> vector =
          std::polar(random.uniform(0.1, 3.0), state(static_cast<Eigen::Index>(i)));
      state(static_cast<Eigen::Index>(i)) = vector.real();
      state(static_cast<Eigen::Index>(*of.steady[i].imaginary)) = vector.imag();
    }
  }
  return state;
}

/// The errors of a state.
Eigen::VectorXd errors_of_state(const NetworkCase& of, Eigen::VectorXd state, double phase, double omega) {
  for (std::size_t i = 0; i < of.steady.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    if (of.steady[i].imaginary) {
      const auto other = static_cast<Eigen::Index>(*of.steady[i].imaginary);
      state(place) = std::atan2(state(other), state(place));
      state(other) = 0.0;
    }
  }
  for (std::size_t i = 0; i < of.steady.size(); ++i) {
    const SteadyValue& each = of.steady[i];
    double& error = state(static_cast<Eigen::Index>(i));
    error -= each.turns * phase + each.constant + each.per_frequency * omega;
    error = of.tracker.recursion.is_angle[i] || each.imaginary ? nearest_turn_off(error) : error;
  }
  return state;
}

/// The sum of a row with errors, and what the width of its entries adds.
std::pair<double, double> product_of(const linear::Row& row, const Eigen::VectorXd& errors) {
  double sum = 0.0;
  double more = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j) {
    const double error = errors(static_cast<Eigen::Index>(j));
    sum += rigor::midpoint(row[j]) * error;
    more += 0.5 * rigor::width(row[j]) * std::fabs(error);
  }
  return {sum, more};
}

/// The sizes of the inputs where forms are what they are at these errors; empty where a limit is not kept.
std::vector<double> network_sizes(const LoopNetwork& network, const Eigen::VectorXd& errors, double noise,
                                  double slew) {
  std::vector<double> sizes(network.inputs.size(), 0.0);
  std::vector<double> bounds;
  for (std::size_t round = 0; round <= sizes.size(); ++round) {
    bounds.clear();
    for (std::size_t f = 0; f < network.forms.size(); ++f) {
      const auto [sum, more] = product_of(network.forms[f], errors);
      double bound = std::fabs(sum) + more;
      for (const DirectTerm& each : network.direct[f]) {
        bound += each.weight * sizes[each.input];
      }
      bounds.push_back(bound);
    }
    for (std::size_t l = 0; l < sizes.size(); ++l) {
      sizes[l] = network.inputs[l].size(noise, slew, bounds);
    }
  }
  const bool keeps = std::all_of(network.limits.begin(), network.limits.end(),
                                 [&](const auto& limit) { return bounds[limit.first] < limit.second; });
  sizes.push_back(bounds.back());  // of the frequency error, at last
  return keeps ? sizes : std::vector<double>();
}

/// The largest share of the room that is reached.
double attack_network(const NetworkCase& of, std::uint64_t stream) {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(of.tracker);
  TrackerModel tracker = loop.model;
  tracker.amplitude = of.amplitude;
  const Interval band = Interval::from_bounds(0.2, 0.3);
  const LoopNetwork network = loop_network(tracker, of.steady, band, of.shares_noise);
  const auto n = static_cast<Eigen::Index>(of.steady.size());
  test::Random random(stream);
  double reached = 0.0;
  std::int64_t known = 0;
  const std::int64_t trials = test::effort(1500);
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const double size = std::pow(10.0, random.uniform(-2.0, 0.0));
    const double noise = random.below(3) == 0 ? 0.0 : of.noise * size;
    const double moved = random.below(2) == 0 ? 0.0 : 0.01 * random.uniform(-1.0, 1.0);
    const double phase = random.uniform(-3.0, 3.0);
    const double omega = random.uniform(0.2, 0.3);
    Eigen::VectorXd errors(n);
    for (std::size_t i = 0; i < of.steady.size(); ++i) {
      errors(static_cast<Eigen::Index>(i)) = of.errors * size * random.uniform(-1.0, 1.0);
    }
    for (const SteadyValue& each : of.steady) {
      if (each.imaginary) {
        errors(static_cast<Eigen::Index>(*each.imaginary)) = 0.0;
      }
    }
    const double amplitude = random.uniform(of.amplitude.lower(), of.amplitude.upper());
    const std::complex<double> sample =
        std::polar(amplitude, phase + omega) + std::polar(noise, random.uniform(0.0, 6.3));
    const Eigen::VectorXd state = state_with(of, errors, phase, omega, random);
    const std::vector<double> sizes = network_sizes(network, errors, noise, std::fabs(moved));
    if (sizes.empty()) {
      continue;
    }
    ++known;
    const double error = loop.tone.step.frequency(state) - omega;
    CHECK(std::fabs(error - product_of(network.forms.back(), errors).first) <=
          rigor::magnitude(network.bias) + sizes.back() + 1e-9);
    const Eigen::VectorXd next =
        errors_of_state(of, loop.tone.step.next(state, Eigen::Vector2d(sample.real(), sample.imag())),
                        phase + omega, omega + moved);
    for (std::size_t i = 0; i < of.steady.size(); ++i) {
      const auto [line, more] = product_of(network.a[i], errors);
      double room = more;
      for (std::size_t l = 0; l < network.inputs.size(); ++l) {
        double squares = 0.0;
        for (const linear::Row& component : network.columns[l].columns) {
          squares += std::pow(rigor::magnitude(component[i]), 2);
        }
        room += std::sqrt(squares) * (sizes[l] > 0.0 ? sizes[l] : 0.0);
      }
      const double off = next(static_cast<Eigen::Index>(i)) - line;
      const bool is_angle = of.tracker.recursion.is_angle[i] || of.steady[i].imaginary;
      const double far = std::fabs(is_angle ? nearest_turn_off(off) : off);
      REQUIRE(far <= room + 1e-9);
      reached = room > 1e-6 ? std::max(reached, far / room) : reached;
    }
  }
  CHECK(known > trials / 4);
  return reached;
}

}  // namespace

TEST_CASE("one sample of a loop is within the matrix and the inputs of its network") {
  const std::vector<SteadyValue> steady{{1, 0.0, 1.0}, {0, 0.0, 1.0}};
  const std::vector<SteadyValue> off{{1, 0.05, 1.0}, {0, 0.01, 1.02}};  // no steady state: residuals
  const Interval amplitudes = Interval::from_bounds(0.8, 1.2);
  std::uint64_t stream = 1001;
  for (const Detector detector :
       {Detector::arctangent2, Detector::arctangent, Detector::sine, Detector::normalised, Detector::knee}) {
    const test::ExampleTracker tracker = test::two_channel_loop(0.1, 0.02, detector);
    CAPTURE(stream);
    CHECK(attack_network({tracker, steady, Interval(1.0)}, ++stream) > 0.9);
    CHECK(attack_network({tracker, off, amplitudes}, ++stream) > 0.5);
    CHECK(attack_network({tracker, steady, Interval(1.0), 0.5, 0.3, true}, ++stream) > 0.8);
    CHECK(attack_network({tracker, off, amplitudes, 0.5, 0.3, true}, ++stream) > 0.5);
  }
  // Errors beyond the limits of the detectors: there nothing is said.
  for (const Detector detector : {Detector::arctangent2, Detector::arctangent}) {
    const test::ExampleTracker tracker = test::two_channel_loop(0.1, 0.02, detector);
    CHECK(attack_network({tracker, steady, Interval(1.0), 4.0, 0.95}, ++stream) > 0.9);
  }
  const std::vector<SteadyValue> vector{{1, 0.0, 0.0, 1}, {}, {0, 0.0, 1.0}};
  CHECK(attack_network({test::turn_between_samples(0.2), vector, amplitudes}, ++stream) > 0.9);
  CHECK(attack_network({test::turn_between_samples(0.2), vector, amplitudes, 0.5, 0.3, true}, ++stream) >
        0.8);
}

}  // namespace veritrack::model

// The step in the coordinates of a tube, and bounds on its length, against the recursion at random points.
#include "checker/model/tube_step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "checker/model/length_bound.hpp"
#include "checker/model/tube_check.hpp"
#include "tests/checker/model/proposed_certificate.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

/// A tracker of the folder designs/models, with a tube that the program proposes.
struct Tracked {
  ModelRecursion recursion;
  TrackedModel model;
  PhaseTube tube;

  Tracked(const std::string& name, double frequency, double half_width)
      : Tracked(test::ProposedModel(name), frequency, half_width) {}
  Tracked(const std::string& name, const PhaseTube& given)
      : recursion(read_json(test::ProposedModel(name).design_json().dump()).at("model")),
        model{&recursion, one},
        tube(given) {}
  Tracked(const Tracked&) = delete;
  Tracked& operator=(const Tracked&) = delete;
  Tracked(Tracked&&) = delete;
  Tracked& operator=(Tracked&&) = delete;
  ~Tracked() = default;

 private:
  Tracked(const test::ProposedModel& proposed, double frequency, double half_width)
      : recursion(read_json(proposed.design_json().dump()).at("model")) {
    model = {&recursion, one};
    const test::Json cell = test::ProposedModel::cell(
        proposed.tube(frequency, half_width, veritrack::model::ShapeObjective::largest_starts), {1e-3},
        {1.0});
    Objections objections;
    const test::Json set = test::ProposedModel::set("starts", 0.0, test::Json::array({cell}));
    tube = read_tube_set(read_json(set.dump()), recursion.states(), objections).tubes.front();
    REQUIRE(objections.empty());
  }
};

/// The series' sum, in balls.
Ball sum_at(const PhaseSeries& series, const Ball& phase, const Ball& z) {
  Ball sum;
  for (std::size_t h = 0; h < series.size(); ++h) {
    for (std::size_t d = 0; d < series[h].size(); ++d) {
      const Ball angle = Ball(static_cast<double>(h)) * phase;
      sum += whole_power(z, static_cast<int>(d)) *
             (Ball(series[h][d].real()) * cos(angle) - Ball(series[h][d].imag()) * sin(angle));
    }
  }
  return sum;
}

std::vector<Ball> curve_at(const PhaseTube& tube, const Ball& phase, const Ball& z) {
  std::vector<Ball> point;
  for (std::size_t i = 0; i < tube.curve.size(); ++i) {
    point.push_back(Ball(static_cast<double>(tube.turns[i])) * phase + sum_at(tube.curve[i], phase, z));
  }
  return point;
}

/// F in balls, at a point: by the definition.
std::vector<Ball> exact_step(const Tracked& tracked, const Ball& phase, const Ball& z,
                             const std::vector<Ball>& xi, const std::vector<Ball>& noise, const Ball& move,
                             const Ball& amplitude = one) {
  const PhaseTube& tube = tracked.tube;
  const Ball next_z = z + move / Ball(tube.half_width);
  const Ball next_phase = phase + Ball(tube.frequency) + Ball(tube.half_width) * z;
  std::vector<Ball> state = curve_at(tube, phase, z);
  for (std::size_t i = 0; i < state.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      state[i] += sum_at(tube.shape[i * (i + 1) / 2 + j], phase, z) * xi[j];
    }
  }
  std::vector<Ball> samples = tracked.recursion.signal(amplitude, next_phase);
  for (std::size_t c = 0; c < samples.size(); ++c) {
    samples[c] += noise[c];
  }
  std::vector<Ball> deviation = tracked.recursion.next(state, samples);
  const std::vector<Ball> curve = curve_at(tube, next_phase, next_z);
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    deviation[i] -= curve[i];
    for (std::size_t j = 0; j < i; ++j) {
      deviation[i] -= sum_at(tube.shape[i * (i + 1) / 2 + j], next_phase, next_z) * deviation[j];
    }
    deviation[i] = deviation[i] / sum_at(tube.shape[i * (i + 1) / 2 + i], next_phase, next_z);
  }
  return deviation;
}

/// A random vector of length 1, or a little less.
std::vector<double> random_direction(test::Random& random, std::size_t size) {
  std::vector<double> direction(size);
  double square_of_length = 1e-300;
  for (double& component : direction) {
    component = random.uniform(-1.0, 1.0);
    square_of_length += component * component;
  }
  for (double& component : direction) {
    component *= (1.0 - 1e-15) / std::sqrt(square_of_length);
  }
  return direction;
}

/// The polynomial at a point, from its coefficients: by Horner's scheme nowhere, so that nothing is shared.
Ball polynomial_at(const BallPolynomial& x, const VectorMonomials& monomials, double s, double z,
                   const std::vector<double>& vectors) {
  const auto block_value = [&](int degree, std::size_t number) {
    Ball sum;
    std::size_t at = 0;
    const auto block = x.block(degree, number);
    for (int d = 0; at < block.size(); ++d) {
      for (int m = 0; m <= d; ++m) {
        sum += Ball(block[at++]) * whole_power(Ball(s), d - m) * whole_power(Ball(z), m);
      }
    }
    return sum;
  };
  Ball value = block_value(0, 0);
  for (std::size_t a = 0; a < vectors.size(); ++a) {
    value += block_value(1, a) * Ball(vectors[a]);
    for (std::size_t b = a; b < vectors.size(); ++b) {
      value += block_value(2, monomials.pair(a, b)) * Ball(vectors[a]) * Ball(vectors[b]);
      for (std::size_t c = b; c < vectors.size(); ++c) {
        value += block_value(3, monomials.triple(a, monomials.pair(b, c))) * Ball(vectors[a]) *
                 Ball(vectors[b]) * Ball(vectors[c]);
      }
    }
  }
  return value;
}

void check_step(const Tracked& tracked, double radius, double noise, double slew, std::size_t parts,
                std::int64_t trials) {
  test::Random random(92);
  const ModelRecursion& recursion = tracked.recursion;
  const std::size_t n = recursion.states();
  const VectorMonomials monomials(n, noise > 0.0 ? recursion.samples() : 0, slew > 0.0 ? 1 : 0);
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const TubePart part = TubePart::of_grid(random.below(parts), parts, random.below(2), 2);
    const TubeStep step(tracked.model, tracked.tube, part, monomials, slew);
    REQUIRE(step.has_shape());
    const std::vector<BallPolynomial> map = step.map(radius, noise);
    const LengthBound bound(map);
    double worst = 0.0;
    for (int i = 0; i < 20; ++i) {
      const double s = random.below(3) == 0 ? 1.0 : random.uniform(-1.0, 1.0);
      const double z = random.below(3) == 0 ? -1.0 : random.uniform(-1.0, 1.0);
      const Ball phase = two * pi() * (Ball(part.turn) + Ball(part.half_turn) * Ball(s));
      const Ball place = Ball(part.z) + Ball(part.half_z) * Ball(z);
      const std::vector<double> x = random_direction(random, n);
      const std::vector<double> v = random_direction(random, recursion.samples());
      const double zeta = random.below(2) == 0 ? 1.0 : random.uniform(-1.0, 1.0);
      std::vector<Ball> xi;
      std::vector<Ball> error;
      xi.reserve(x.size());
      error.reserve(v.size());
      for (const double component : x) {
        xi.push_back(Ball(radius) * Ball(component));
      }
      for (const double component : v) {
        error.push_back(Ball(noise) * Ball(component));
      }
      const std::vector<Ball> exact = exact_step(tracked, phase, place, xi, error, Ball(slew) * Ball(zeta));
      Ball square_of_length;
      for (std::size_t k = 0; k < n; ++k) {
        REQUIRE(map[k].known());
        std::vector<double> both = x;
        if (noise > 0.0) {
          both.insert(both.end(), v.begin(), v.end());
        }
        if (slew > 0.0) {
          both.push_back(zeta);
        }
        const Ball value = polynomial_at(map[k], monomials, s, z, both);
        REQUIRE_FALSE(certainly_less(Ball(map[k].error()), abs(value - exact[k])));
        square_of_length += square(exact[k]);
      }
      worst = std::max(worst, sqrt(square_of_length).near());
    }
    // Nothing less than what was met is ever said to be a bound; some bound there is.
    REQUIRE_FALSE(bound.is_at_most(worst * (1.0 - 1e-9), 1.0));
    REQUIRE(bound.is_at_most(100.0 * worst, 1.0));
    REQUIRE(bound.is_at_most(100.0 * worst, 0.5));
  }
}

/// Steps at random amplitudes of a range, many of them its ends: none is longer than the bound.
void check_amplitudes(Tracked& tracked, double low, double high, double radius, double noise,
                      std::int64_t trials) {
  test::Random random(93);
  tracked.model.amplitude = Ball::hull(Ball(low), Ball(high));
  tracked.model.amplitude_varies = true;
  const std::size_t n = tracked.recursion.states();
  const VectorMonomials monomials(n, tracked.recursion.samples(), 0);
  constexpr std::size_t kParts = 64;
  double nearest = 0.0;
  for (std::int64_t trial = 0; trial < trials; ++trial) {
    const TubePart part = TubePart::of_grid(random.below(kParts), kParts, random.below(2), 2);
    const TubeStep step(tracked.model, tracked.tube, part, monomials, 0.0);
    const LengthBound bound(step.map(radius, noise));
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
      const Ball phase =
          two * pi() * (Ball(part.turn) + Ball(part.half_turn) * Ball(random.uniform(-1.0, 1.0)));
      const Ball place = Ball(part.z) + Ball(part.half_z) * Ball(random.uniform(-1.0, 1.0));
      const std::uint64_t kind = random.below(3);
      const Ball amplitude(kind == 0 ? low : kind == 1 ? high : random.uniform(low, high));
      std::vector<Ball> xi;
      std::vector<Ball> error;
      for (const double component : random_direction(random, n)) {
        xi.push_back(Ball(radius) * Ball(component));
      }
      for (const double component : random_direction(random, tracked.recursion.samples())) {
        error.push_back(Ball(noise) * Ball(component));
      }
      Ball square_of_length;
      for (const Ball& component : exact_step(tracked, phase, place, xi, error, zero, amplitude)) {
        square_of_length += square(component);
      }
      worst = std::max(worst, sqrt(square_of_length).near());
    }
    REQUIRE_FALSE(bound.is_at_most(worst * (1.0 - 1e-9), 1.0));
    REQUIRE(bound.is_at_most(3.0 * worst, 1.0));
    nearest = bound.is_at_most(worst * 1.25, 1.0) ? nearest + 1.0 : nearest;
  }
  CHECK(nearest > 0.2 * static_cast<double>(trials));
}

TEST_CASE("amplitudes that differ from sample to sample") {
  Tracked loop("type-2-pll.toml", 0.3, 0.02);
  check_amplitudes(loop, 0.97, 1.03, 0.004, 0.01, test::effort(20));
  check_amplitudes(loop, 0.9, 1.2, 0.004, 0.0, test::effort(20));
}

TEST_CASE("what amplitudes do to samples is taken for noise, and never lost") {
  Tracked loop("type-2-pll.toml", 0.3, 0.02);
  loop.model.amplitude_varies = true;
  const VectorMonomials monomials(2, 1, 0);
  const BallPolynomial sample = BallPolynomial::affine(0.5, 0.1, 0.0, 0.25);
  const BallPolynomial noisy = with_noise(loop.model, {sample}, 0.125, monomials).front();
  CHECK(noisy.error() < 1e-12);
  CHECK(noisy.block(1, monomials.first(1))[0] >= 0.375);
  CHECK(noisy.block(1, monomials.first(1))[0] < 0.375 * (1.0 + 1e-12));
  CHECK(noisy.block(0, 0)[0] == 0.5);
  // Of two samples, one unknown: neither is known, and not without its noise.
  for (const BallPolynomial& each :
       with_noise(loop.model, {sample, BallPolynomial::everything()}, 0.125, monomials)) {
    CHECK_FALSE(each.known());
  }
  loop.model.amplitude_varies = false;
  CHECK(with_noise(loop.model, {sample}, 0.0, monomials).front().error() == 0.25);
  CHECK(with_noise(loop.model, {sample}, 0.125, monomials).front().error() >= 0.25);
}

TEST_CASE("a phase-locked loop") {
  const Tracked loop("type-2-pll.toml", 0.3, 0.02);
  check_step(loop, 0.01, 0.0, 0.0, 64, test::effort(30));
  check_step(loop, 0.004, 0.04, 0.0, 64, test::effort(30));
  check_step(loop, 1e-6, 0.0, 0.0, 16, test::effort(10));
  check_step(loop, 0.003, 0.0, 3e-5, 64, test::effort(20));
  check_step(loop, 0.003, 0.01, 2e-5, 64, test::effort(20));
  check_step(loop, 0.003, 0.01, 0.01, 64, test::effort(20));
}

TEST_CASE("a second-order generalised integrator, with a division") {
  const Tracked loop("sogi-fll.toml", 50.0 * 2.0 * M_PI / 10000.0, 2e-4);
  check_step(loop, 0.001, 0.0, 0.0, 64, test::effort(20));
  check_step(loop, 0.0005, 0.01, 0.0, 64, test::effort(20));
  check_step(loop, 0.0005, 0.002, 1e-5, 64, test::effort(20));
}

TEST_CASE("two channels, with an arctangent") {
  // On a tone it follows exactly: the phase, the frequency and no phase error.
  PhaseTube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.01;
  tube.turns = {1, 0, 0};
  tube.curve = {{}, {{0.3, 0.01}}, {}};
  tube.shape = {{{1.0}, {0.1}}, {{0.01, 0.002}}, {{0.02}}, {{-0.3}}, {}, {{0.9}}};
  const Tracked loop("gnss-pll.toml", tube);
  check_step(loop, 0.001, 0.03, 1e-4, 32, test::effort(10));
}

TEST_CASE("a curve of many powers where the frequency moves") {
  test::Random random(94);
  const VectorMonomials monomials(1, 0, 1);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    PhaseTube tube;
    tube.frequency = 0.3;
    tube.half_width = 0.01;
    tube.turns = {0};
    tube.curve.resize(1);
    tube.shape = {{{1.0}}};
    for (std::size_t h = 0; h < 3; ++h) {
      tube.curve[0].emplace_back();
      for (std::size_t d = 0; d < kMostPowers; ++d) {
        tube.curve[0].back().emplace_back(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      }
    }
    const TubePart part = TubePart::of_grid(random.below(1024), 1024, random.below(256), 256);
    const double most = 1e-3;
    const FrequencyMove move{Ball(most), BallPolynomial::variable(monomials, monomials.first(2))};
    const BallPolynomial curve = TubeOver(tube, part, 0, &move).curve[0];
    REQUIRE(curve.known());
    for (int i = 0; i < 10; ++i) {
      const double s = random.uniform(-1.0, 1.0);
      const double z = random.uniform(-1.0, 1.0);
      const double zeta = random.below(2) == 0 ? 1.0 : random.uniform(-1.0, 1.0);
      const Ball phase = two * pi() * (Ball(part.turn) + Ball(part.half_turn) * Ball(s));
      const Ball place = Ball(part.z) + Ball(part.half_z) * Ball(z) + Ball(most) * Ball(zeta);
      const Ball value = polynomial_at(curve, monomials, s, z, {0.0, zeta});
      REQUIRE_FALSE(certainly_less(Ball(curve.error()), abs(value - sum_at(tube.curve[0], phase, place))));
    }
    tube.curve[0][0].resize(kMostPowers + 1);
    CHECK_THROWS_AS(TubeOver(tube, part, 0, &move), std::invalid_argument);
  }
}

TEST_CASE("a shape that may vanish is none") {
  Tracked loop("type-2-pll.toml", 0.3, 0.02);
  const TubePart part = TubePart::of_grid(3, 64, 0, 1);
  const VectorMonomials monomials(2);
  const auto has_shape = [&](const TubePart& over) {
    return TubeStep(loop.model, loop.tube, over, monomials).has_shape();
  };
  REQUIRE(has_shape(part));
  const PhaseSeries first = loop.tube.shape[0];
  loop.tube.shape[0][0][0] = 0.0;
  CHECK_FALSE(has_shape(TubePart()));
  loop.tube.shape[0] = {};
  CHECK_FALSE(has_shape(part));
  loop.tube.shape[0] = first;
  for (auto& harmonic : loop.tube.shape[0]) {
    for (auto& coefficient : harmonic) {
      coefficient = -coefficient;
    }
  }
  CHECK_FALSE(has_shape(part));
}

TEST_CASE("parts of a tube fit together exactly") {
  double turn = 0.0;
  for (std::size_t p = 0; p < 8; ++p) {
    const TubePart part = TubePart::of_grid(p, 8, 1, 2);
    CHECK(part.turn - part.half_turn == turn);
    turn = part.turn + part.half_turn;
    CHECK(part.z == 0.5);
    CHECK(part.half_z == 0.5);
  }
  CHECK(turn == 1.0);
  const TubePart part = TubePart::of_grid(5, 16, 0, 1);
  CHECK(part.half_of_phases(false).turn + part.half_of_phases(false).half_turn == part.turn);
  CHECK(part.half_of_phases(true).turn - part.half_of_phases(true).half_turn == part.turn);
  CHECK(part.half_of_frequencies(false).z == -0.5);
  CHECK(part.half_of_frequencies(true).z == 0.5);
  CHECK(part.half_of_frequencies(true).half_z == 0.5);
}

TEST_CASE("the length of a vector: linear in two vectors, and more") {
  const VectorMonomials monomials(2, 1);
  const auto x = [&](std::size_t i) { return BallPolynomial::variable(monomials, i); };
  const BallPolynomial s = BallPolynomial::phase();
  // |(3 x0, 2 x1) + v (0, 1)|: 3 at x = (1, 0), v = 0 would be 3; the sum of both in one direction is 3 at
  // most.
  const LengthBound two_vectors({3.0 * x(0), 2.0 * x(1) + x(2)});
  CHECK(two_vectors.is_at_most(3.37, 1.0));
  CHECK_FALSE(two_vectors.is_at_most(3.0, 1.0));
  CHECK(two_vectors.is_at_most(2.05, 0.5));
  CHECK_FALSE(two_vectors.is_at_most(2.01, 0.5));
  // A rotation has length 1, however far it turns.
  const BallPolynomial turned = 0.3 * s;
  const LengthBound rotation(
      {cos(turned) * x(0) - sin(turned) * x(1), sin(turned) * x(0) + cos(turned) * x(1)});
  CHECK(rotation.is_at_most(1.01, 1.0));
  CHECK_FALSE(rotation.is_at_most(0.999, 1.0));
  // Squares, constants and errors are added.
  BallPolynomial all = BallPolynomial(0.25) + x(0) + 0.5 * x(0) * x(0);
  all.widen(0.125);
  const LengthBound sum({all, BallPolynomial()});
  CHECK(sum.is_at_most(1.876, 1.0));
  CHECK_FALSE(sum.is_at_most(1.874, 1.0));
  CHECK(sum.is_at_most(0.25 + 0.5 + 0.125 + 0.125 + 0.001, 0.5));
  CHECK_FALSE(sum.is_at_most(0.25 + 0.5 + 0.125 + 0.125 - 0.001, 0.5));
  CHECK_FALSE(LengthBound({BallPolynomial::everything(), x(0)}).is_at_most(1e100, 1.0));
  CHECK_FALSE(LengthBound({BallPolynomial(1.0)}).is_at_most(2.0, 1.0));
  CHECK_FALSE(sum.is_at_most(std::nan(""), 1.0));
  CHECK_FALSE(sum.is_at_most(10.0, std::nan("")));
}

TEST_CASE("samples until a level is reached") {
  TubeSet set;
  set.tubes.resize(2);
  set.tubes[0].levels = {1.0, 0.25, 0.125};
  set.tubes[0].shrinking = {0.5, 0.75};
  set.tubes[1].levels = {0.5, 0.125, 0.0625};
  set.tubes[1].shrinking = {0.25, 0.5};
  const auto samples = [&](std::size_t tube, std::size_t level) {
    return samples_to_level(set, set.tubes[tube], level).near();
  };
  CHECK(samples(0, 0) == 0.0);
  CHECK(samples(0, 1) == 2.0);
  CHECK(samples(0, 2) == 5.0);
  CHECK(samples(1, 2) == 2.0);
  // A frequency that moves goes through both, and crosses.
  set.slew = 1e-6;
  set.crossing = {0.5, 0.9};
  CHECK(samples(0, 1) == 2.0);
  CHECK(samples(1, 2) == 9.0);
}

}  // namespace
}  // namespace veritrack::checker

#include "analysis/quadrature/leak/steady_verification.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "analysis/quadrature/leak/steady_proposal.hpp"
#include "analysis/rigor/decimal.hpp"
#include "tests/analysis/quadrature/polar_simulation.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;
using rigor::Verdict;
using test::Polar;
using test::Simulation;

namespace {

struct Example {
  trackers::ToneModel<Interval> design;
  sets::LockBranch branch;
  std::optional<SteadySet> proposal;
};

/// A proposal for a narrow band, which is quick to verify.
Example example_of(double q, double r, double epsilon, double low, double high, double noise, double slew,
                   double fraction) {
  const rigor::UpwardRounding upward;
  Example example;
  example.design = {Interval(q), Interval(q), Interval(r), Interval(epsilon)};
  example.branch =
      sets::verify_lock_branch(example.design, Interval::from_bounds(low, high), {.largest = 0.1});
  if (example.branch.verdict != Verdict::proved) {
    return example;
  }
  SteadyRequest request;
  request.design = {q, q, r, epsilon};
  for (const auto& cell : {example.branch.cells.front(), example.branch.cells.back()}) {
    const Polar& x = cell.center;
    request.steady.push_back({1.0 + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}});
    request.slopes.push_back(cell.slope);
  }
  request.noise = noise;
  request.slew = slew;
  request.evaluations = 25;
  const auto shape = propose_steady_shape(request, SteadyJudgement::cautious);
  if (shape) {
    example.proposal = propose_steady_set(request, *shape, fraction, SteadyJudgement::cautious);
  }
  return example;
}

/// The smallest s with -s below <= deviation <= s above.
double covariance_level(const SteadySet& set, const Eigen::Matrix3d& deviation) {
  const auto share = [](const Eigen::Matrix3d& bound, const Eigen::Matrix3d& x) {
    return oracle::relative_eigenvalues(x, bound)[2];
  };
  return std::max(share(set.above, deviation), share(set.below, -deviation));
}

double level_of(const SteadySet& set, const Polar& deviation) {
  Eigen::Matrix3d p;
  p << deviation[3], deviation[4], deviation[5], deviation[4], deviation[6], deviation[7], deviation[5],
      deviation[7], deviation[8];
  return std::max((set.metric * deviation.head<3>()).norm(), covariance_level(set, p));
}

/// On the rim of level s in a random direction, the covariance at a random corner of its bounds.
Polar rim(const SteadySet& set, double s, test::Random& random) {
  Eigen::Vector3d u(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  const Eigen::Vector3d error = set.metric.inverse() * u.normalized() * s;
  Eigen::Matrix3d y = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d axis =
      Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
          .normalized();
  y = random.uniform() < 0.5 ? Eigen::Matrix3d(axis * axis.transpose())
                             : Eigen::Matrix3d(Eigen::Matrix3d::Identity() - axis * axis.transpose());
  const Eigen::Matrix3d root = oracle::cholesky_factor(set.above + set.below);
  const Eigen::Matrix3d p = s * (root * y * root.transpose() - set.below);
  Polar result;
  result << error, p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2);
  return result;
}

/// The promise of a set, held against the textbook filter: rates, levels, noise and slew at their limits.
void try_to_break(const Example& example, const SteadySet& set, test::Random& random, int runs) {
  const rigor::NearestRounding nearest;
  const auto& cells = example.branch.cells;
  const double low = cells.front().parameter.lower();
  const double high = cells.back().parameter.upper();
  for (int run = 0; run < runs; ++run) {
    Simulation simulation(example.design, Polar::Zero(), random.uniform(low, high));
    const double start = run % 3 == 0 ? 1.0 : random.uniform(set.levels.back(), 1.0);
    simulation =
        Simulation(example.design,
                   Polar(test::steady_state(simulation, cells, example.design) + rim(set, start, random)),
                   simulation.frequency);
    double level = start;
    double slew = run % 2 == 0 ? set.slew : -set.slew;
    for (int k = 0; k < 40; ++k) {
      if (simulation.frequency + slew < low || simulation.frequency + slew > high) {
        slew = -slew;
      }
      const double used =
          simulation.frequency + slew < low || simulation.frequency + slew > high ? 0.0 : slew;
      const double angle = run % 4 == 0
                               ? simulation.phase + simulation.frequency + (k % 2 == 0 ? 1.57 : -1.57)
                               : random.uniform(0.0, 6.28);
      simulation.step(set.noise * Eigen::Vector2d(std::cos(angle), std::sin(angle)), used);
      const double next =
          level_of(set, simulation.state() - test::steady_state(simulation, cells, example.design));
      // The step from the last level that holds the state leads to the next one.
      double allowed = set.levels.back();
      for (std::size_t j = 0; j + 1 < set.levels.size(); ++j) {
        if (level <= set.levels[j] * (1.0 + 1e-9)) {
          allowed = set.levels[j + 1];
        }
      }
      CHECK(next <= allowed * (1.0 + 1e-6) + 1e-9);
      level = next;
    }
  }
}

}  // namespace

TEST_CASE("sets around the steady state: the textbook filter does not break a PROVED one") {
  test::Random random(40);
  int proved = 0;
  const auto count = test::effort(6);
  for (int i = 0; i < count; ++i) {
    const double q = std::exp(random.uniform(std::log(5e-4), std::log(6e-3)));
    const double r = std::exp(random.uniform(std::log(0.008), std::log(0.05)));
    const double epsilon = random.uniform(0.002, 0.02);
    const double low = random.uniform(0.0, 1.5);
    const Example example =
        example_of(q, r, epsilon, low, low + 0.08, random.uniform(0.0, 0.001),
                   i % 2 == 0 ? 0.0 : random.uniform(0.0, 2e-4), random.uniform(0.3, 0.6));
    CAPTURE(i);
    CAPTURE(q);
    CAPTURE(r);
    CAPTURE(epsilon);
    CAPTURE(low);
    if (!example.proposal) {
      continue;
    }
    const auto verification = verify_steady_set(example.design, example.branch.cells, *example.proposal);
    if (verification.verdict == Verdict::proved) {
      ++proved;
      try_to_break(example, verification.set, random, 12);
    }
  }
  CHECK(2 * proved >= count);
}

TEST_CASE("sets around the steady state: false proposals are not PROVED") {
  static const Example example = example_of(0.0013, 0.01, 0.01, 0.5, 0.55, 0.0005, 0.0, 0.4);
  REQUIRE(example.proposal.has_value());
  const auto verdict = [&](const SteadySet& set) {
    return verify_steady_set(example.design, example.branch.cells, set).verdict;
  };
  static const Verdict as_proposed = verdict(*example.proposal);
  REQUIRE(as_proposed == Verdict::proved);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SteadySet set = *example.proposal;
  SUBCASE("much more noise") {
    set.noise = 0.1;
  }
  SUBCASE("much more slew") {
    set.slew = 0.1;
  }
  SUBCASE("a step faster than the tracker") {
    set.levels = {1.0, 0.3};
  }
  SUBCASE("a set beyond the half plane") {
    set.metric *= 0.05;
  }
  SUBCASE("a covariance that must not move") {
    set.above *= 1e-3;
  }
  SUBCASE("a covariance that must not fall") {
    set.below *= 1e-3;
  }
  SUBCASE("a lower bound beyond the steady state") {
    set.below *= 100.0;
  }
  SUBCASE("an indefinite bound") {
    set.above(0, 0) = -1.0;
  }
  SUBCASE("an asymmetric bound") {
    set.below(0, 1) += 1e-3;
  }
  SUBCASE("a full metric") {
    set.metric(1, 0) = 1e-3;
  }
  SUBCASE("not a number") {
    set.metric(0, 0) = kNan;
  }
  SUBCASE("infinite noise") {
    set.noise = kInfinity;
  }
  SUBCASE("negative noise") {
    set.noise = -1e-3;
  }
  SUBCASE("levels that do not begin at 1") {
    set.levels.front() = 0.999;
  }
  SUBCASE("levels that do not fall") {
    set.levels[1] = 1.0;
  }
  SUBCASE("level zero") {
    set.levels.back() = 0.0;
  }
  SUBCASE("a level that is not a number") {
    set.levels.back() = kNan;
  }
  SUBCASE("no levels") {
    set.levels.clear();
  }
  CHECK(verdict(set) == Verdict::undecided);
}

TEST_CASE("sets around the steady state: levels that fail are dropped, the others stay PROVED") {
  const Example example = example_of(0.0013, 0.01, 0.01, 0.5, 0.55, 0.0005, 0.0, 0.4);
  REQUIRE(example.proposal.has_value());
  SteadySet set = *example.proposal;
  const std::size_t proposed = set.levels.size();
  set.levels.push_back(0.3 * set.levels.back());  // noise keeps the tracker from there
  const auto verification = verify_steady_set(example.design, example.branch.cells, set);
  CHECK(verification.verdict == Verdict::proved);
  CHECK(verification.set.levels.size() >= 2);
  CHECK(verification.set.levels.size() <= proposed);
}

TEST_CASE("a certificate with a leak covers the start, or says why not") {
  const rigor::UpwardRounding upward;
  LeakQuestion question;
  question.tracker.design = {rigor::parse_decimal("0.0013"), rigor::parse_decimal("0.0013"),
                             rigor::parse_decimal("0.01"), rigor::parse_decimal("0.01")};
  question.tracker.noise = rigor::parse_decimal("0.001");
  question.tracker.initial_frequency_error = rigor::parse_decimal("0.005");
  question.tracker.search_evaluations = 25;
  question.tracker.with_samples = false;
  question.band = Interval::from_bounds(0.4, 0.5);
  SUBCASE("a small start") {
    const auto certificate = certify_with_leak(question);
    CHECK(certificate.derivation.verdict == Verdict::proved);
    const Interval bound = theorems::find_quantity(certificate.derivation, "frequency_error_bound").value;
    const Interval bias = theorems::find_quantity(certificate.derivation, "bias_frequency").value;
    CHECK(magnitude(bias) < bound.upper());
    CHECK(bound.upper() < 0.2);
  }
  SUBCASE("a start outside the set is followed into it") {
    question.tracker.initial_frequency_error = rigor::parse_decimal("0.25");
    const auto certificate = certify_with_leak(question);
    CHECK(certificate.derivation.verdict == Verdict::proved);
    CHECK(theorems::find_quantity(certificate.derivation, "capture_samples").value.lower() >= 1.0);
    CHECK(theorems::find_quantity(certificate.derivation, "frequency_error_bound").value.upper() >= 0.25);
  }
  SUBCASE("but not while the frequency moves") {
    question.tracker.initial_frequency_error = rigor::parse_decimal("0.25");
    question.tracker.slew = rigor::parse_decimal("1e-6");
    CHECK(certify_with_leak(question).derivation.verdict == Verdict::undecided);
  }
  SUBCASE("a start far away") {
    question.tracker.initial_frequency_error = Interval(0.9);
    const auto certificate = certify_with_leak(question);
    CHECK(certificate.derivation.verdict == Verdict::undecided);
    CHECK(
        theorems::find_quantity(certificate.derivation, "frequency_error_bound").not_applicable.has_value());
  }
  SUBCASE("a branch that ends inside the band") {
    question.tracker.design.q1 = question.tracker.design.q2 = rigor::parse_decimal("0.0005");
    question.tracker.design.epsilon = rigor::parse_decimal("0.05");
    question.band = Interval::from_bounds(0.05, 3.0);
    const auto certificate = certify_with_leak(question);
    CHECK(certificate.derivation.verdict == Verdict::undecided);
    REQUIRE(certificate.branch_ends_at);
    CHECK(rigor::to_decimal(*certificate.branch_ends_at, 4, rigor::Direction::down).starts_with("2.38"));
  }
}

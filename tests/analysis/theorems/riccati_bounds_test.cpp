#include "analysis/theorems/riccati_bounds.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "tests/analysis/theorems/textbook_riccati.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;
using test::LinearWindow;
using test::SmallMatrix;

SmallMatrix matrix(std::initializer_list<std::initializer_list<double>> rows) {
  SmallMatrix result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index row = 0;
  for (const auto& entries : rows) {
    Eigen::Index column = 0;
    for (const double entry : entries) {
      result(row, column++) = Interval(entry);
    }
    ++row;
  }
  return result;
}

SmallMatrix scaled_identity(Eigen::Index size, double scale) {
  SmallMatrix result = SmallMatrix::Constant(size, size, Interval(0.0));
  for (Eigen::Index i = 0; i < size; ++i) {
    result(i, i) = Interval(scale);
  }
  return result;
}

LinearWindow time_invariant(std::size_t steps, const SmallMatrix& f, const SmallMatrix& q,
                            const SmallMatrix& h, const SmallMatrix& r) {
  LinearWindow window;
  window.transitions.assign(steps, f);
  window.process_noises.assign(steps, q);
  window.outputs.assign(steps + 1, h);
  window.measurement_noises.assign(steps + 1, r);
  return window;
}

SmallMatrix random_matrix(test::Random& random, Eigen::Index rows, Eigen::Index columns, double size) {
  SmallMatrix result(rows, columns);
  for (Eigen::Index column = 0; column < columns; ++column) {
    for (Eigen::Index row = 0; row < rows; ++row) {
      result(row, column) = Interval(random.uniform(-size, size));
    }
  }
  return result;
}

/// L L' of random rank, exactly zero now and then.
SmallMatrix random_semidefinite(test::Random& random, Eigen::Index size, double scale) {
  const auto rank = static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size) + 1));
  if (rank == 0) {
    return SmallMatrix::Constant(size, size, Interval(0.0));
  }
  const SmallMatrix factor = random_matrix(random, size, rank, 1.0);
  const SmallMatrix product = factor * factor.transpose();
  return rigor::intersection(product, product.transpose()) * Interval(scale);
}

struct RandomSystem {
  LinearWindow window;
  SmallMatrix prior;
};

RandomSystem random_system(test::Random& random) {
  const auto states = static_cast<Eigen::Index>(1 + random.below(4));
  const auto outputs = static_cast<Eigen::Index>(1 + random.below(static_cast<std::uint64_t>(states)));
  const auto steps = static_cast<std::size_t>(1 + random.below(8));
  RandomSystem system;
  for (std::size_t i = 0; i <= steps; ++i) {
    if (i < steps) {
      system.window.transitions.push_back(scaled_identity(states, 1.0) +
                                          random_matrix(random, states, states, 0.75));
      system.window.process_noises.push_back(
          random_semidefinite(random, states, std::exp2(random.uniform(-6.0, 6.0))));
    }
    system.window.outputs.push_back(random_matrix(random, outputs, states, 1.5));
    SmallMatrix noise = SmallMatrix::Constant(outputs, outputs, Interval(0.0));
    for (Eigen::Index channel = 0; channel < outputs; ++channel) {
      noise(channel, channel) = Interval(std::exp2(random.uniform(-6.0, 6.0)));
    }
    system.window.measurement_noises.push_back(noise);
  }
  switch (random.below(3)) {
    case 0:
      system.prior = scaled_identity(states, 0.0);
      break;
    case 1:
      system.prior = scaled_identity(states, 0x1p20);
      break;
    default:
      system.prior = random_semidefinite(random, states, std::exp2(random.uniform(-6.0, 6.0)));
  }
  return system;
}

struct Tally {
  std::int64_t held = 0, refuted = 0, undecided = 0;

  /// matrix <= bound, up to 1e-6 of the bound (equality occurs).
  void add(const SmallMatrix& matrix, const SmallMatrix& bound) {
    const Interval slack = bound.trace() * Interval(1e-6);
    SmallMatrix difference = bound - matrix;
    for (Eigen::Index i = 0; i < difference.rows(); ++i) {
      difference(i, i) += slack;
    }
    const Verdict verdict = rigor::is_positive_definite(difference);
    ++(verdict == Verdict::proved ? held : verdict == Verdict::refuted ? refuted : undecided);
  }
};

/// x' (bound - matrix) x < 0 for certain, x a vector of small integers.
bool certainly_violated(const SmallMatrix& matrix, const SmallMatrix& bound,
                        std::initializer_list<double> direction) {
  SmallMatrix x(static_cast<Eigen::Index>(direction.size()), 1);
  Eigen::Index row = 0;
  for (const double entry : direction) {
    x(row++, 0) = Interval(entry);
  }
  const SmallMatrix form = x.transpose() * (bound - matrix) * x;
  return certainly_negative(form(0, 0));
}

}  // namespace

TEST_CASE("the sound bounds hold for every random system, the naive ones fail for many") {
  test::Random random(41);
  const rigor::UpwardRounding upward;
  Tally covariance;
  Tally information;
  Tally naive_covariance;
  Tally naive_information;
  const std::int64_t systems = test::effort(10000);
  for (std::int64_t i = 0; i < systems; ++i) {
    const RandomSystem system = random_system(random);
    const SmallMatrix p = test::textbook_covariance(system.window, system.prior);
    const auto gramians = theorems::window_gramians(system.window);
    if (!gramians) {
      continue;
    }
    if (const auto bound = theorems::covariance_bound(*gramians)) {
      covariance.add(p, *bound);
      naive_covariance.add(p, *theorems::naive_covariance_bound(*gramians));
    }
    const auto bound = theorems::information_bound(*gramians);
    const auto inverse = rigor::inverse(p);
    if (bound && inverse) {
      information.add(*inverse, *bound);
      naive_information.add(*inverse, *theorems::naive_information_bound(*gramians));
    }
  }
  INFO("seed ", test::kSeed + 41, ", ", systems, " systems: covariance held ", covariance.held,
       ", undecided ", covariance.undecided, "; information held ", information.held, ", undecided ",
       information.undecided, "; naive refuted ", naive_covariance.refuted, " and ",
       naive_information.refuted);
  CHECK(covariance.refuted == 0);
  CHECK(information.refuted == 0);
  // Undecided are the systems whose Gramians are nearly singular, or singular: C often is.
  CHECK(100 * covariance.held > 65 * systems);
  CHECK(100 * information.held > 50 * systems);
  CHECK(100 * naive_covariance.refuted > 5 * systems);
  CHECK(100 * naive_information.refuted > 3 * systems);
}

TEST_CASE("O^-1 + C does not bound the covariance, nor does 1/b1 + a1: a double integrator") {
  const rigor::UpwardRounding upward;
  const LinearWindow window =
      time_invariant(1, matrix({{1, 1}, {0, 1}}), scaled_identity(2, 1.0), matrix({{1, 0}}), matrix({{1}}));
  const SmallMatrix p = test::textbook_covariance(window, scaled_identity(2, 0x1p20));
  const auto gramians = theorems::window_gramians(window);
  REQUIRE(gramians);
  const SmallMatrix naive = *theorems::naive_covariance_bound(*gramians);
  CHECK(rigor::contains(naive, Eigen::Matrix2d{{2.0, 1.0}, {1.0, 3.0}}));
  CHECK(certainly_violated(p, naive, {0, 1}));
  const Interval scalar = Interval(1.0) / theorems::smallest_eigenvalue(gramians->observability) +
                          theorems::largest_eigenvalue(gramians->controllability);
  CHECK(certainly_less(scalar, theorems::largest_eigenvalue(p)));
  // The sound bound is what remains of P for an infinite prior: [[r, r], [r, 2r + q1 + q2]].
  const SmallMatrix sound = *theorems::covariance_bound(*gramians);
  CHECK(rigor::contains(sound, Eigen::Matrix2d{{1.0, 1.0}, {1.0, 4.0}}));
  CHECK(rigor::magnitude(sound - p).maxCoeff() < 1e-4);
}

TEST_CASE("C^-1 + O does not bound the inverse covariance for N = 2, nor does 1/a2 + b2") {
  const rigor::UpwardRounding upward;
  SUBCASE("as matrices") {
    const LinearWindow window = time_invariant(2, matrix({{2, 1}, {0, -1}}), matrix({{0, 0}, {0, 4}}),
                                               matrix({{0, 2}}), matrix({{1}}));
    const auto gramians = theorems::window_gramians(window);
    const auto inverse = rigor::inverse(test::textbook_covariance(window, scaled_identity(2, 0.0)));
    REQUIRE((gramians && inverse));
    CHECK(certainly_violated(*inverse, *theorems::naive_information_bound(*gramians), {1, 0}));
    CHECK_FALSE(certainly_violated(*inverse, *theorems::information_bound(*gramians), {1, 0}));
  }
  SUBCASE("as numbers") {
    const LinearWindow window = time_invariant(2, matrix({{-1, -2}, {1, -2}}), matrix({{3, 0}, {0, 0}}),
                                               matrix({{2, 2}}), matrix({{1}}));
    const auto gramians = theorems::window_gramians(window);
    const auto inverse = rigor::inverse(test::textbook_covariance(window, scaled_identity(2, 0.0)));
    REQUIRE((gramians && inverse));
    const Interval scalar = Interval(1.0) / theorems::smallest_eigenvalue(gramians->controllability) +
                            theorems::largest_eigenvalue(gramians->observability);
    CHECK(certainly_less(scalar, theorems::largest_eigenvalue(*inverse)));
  }
}

TEST_CASE("the tracker itself: P33 = 2r + q1 + q2 after the window N = 1, where O^-1 + C has 2r + q2") {
  const rigor::UpwardRounding upward;
  const double q = 0x1p-9;
  const double r = 0x1p-6;
  const LinearWindow window =
      time_invariant(1, matrix({{1, 0, 0}, {0, 1, 1}, {0, 0, 1}}), scaled_identity(3, q),
                     matrix({{1, 0, 0}, {0, 1, 0}}), scaled_identity(2, r));
  const SmallMatrix p = test::textbook_covariance(window, scaled_identity(3, 0x1p30));
  const auto gramians = theorems::window_gramians(window);
  REQUIRE(gramians);
  const SmallMatrix naive = *theorems::naive_covariance_bound(*gramians);
  CHECK(rigor::contains(naive(2, 2), 2.0 * r + q));
  CHECK(certainly_violated(p, naive, {0, 0, 1}));
  const SmallMatrix sound = *theorems::covariance_bound(*gramians);
  CHECK(rigor::contains(sound(2, 2), 2.0 * r + 2.0 * q));
  CHECK(certainly_less(Interval(1.0) / theorems::smallest_eigenvalue(gramians->observability) +
                           theorems::largest_eigenvalue(gramians->controllability),
                       theorems::largest_eigenvalue(p)));
}

TEST_CASE("for N = 1 the naive lower bound is the sound one") {
  test::Random random(42);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(100); ++i) {
    INFO("seed ", test::kSeed + 42, ", system ", i);
    const auto size = static_cast<Eigen::Index>(1 + random.below(4));
    const SmallMatrix q = random_matrix(random, size, size, 1.0);
    const auto gramians = theorems::window_gramians(time_invariant(
        1, random_matrix(random, size, size, 1.0), q * q.transpose() + scaled_identity(size, 0.1),
        random_matrix(random, 1, size, 1.0), matrix({{0.5}})));
    REQUIRE(gramians);
    const SmallMatrix sound = *theorems::information_bound(*gramians);
    SmallMatrix naive = *theorems::naive_information_bound(*gramians);
    naive -= gramians->information[0];  // the oldest measurement says nothing beyond the prior
    for (Eigen::Index entry = 0; entry < sound.size(); ++entry) {
      CHECK_FALSE(is_empty(intersection(sound(entry), naive(entry))));
    }
  }
}

TEST_CASE("what is singular or not finite gives nothing; wrong shapes throw") {
  const rigor::UpwardRounding upward;
  const SmallMatrix identity = scaled_identity(2, 1.0);
  const auto unobservable = theorems::window_gramians(
      time_invariant(1, identity, scaled_identity(2, 0.0), matrix({{1, 0}}), matrix({{1}})));
  REQUIRE(unobservable);
  CHECK_FALSE(theorems::covariance_bound(*unobservable));
  CHECK_FALSE(theorems::naive_covariance_bound(*unobservable));
  CHECK_FALSE(theorems::information_bound(*unobservable));
  CHECK_FALSE(theorems::naive_information_bound(*unobservable));
  CHECK_FALSE(theorems::window_gramians(
      time_invariant(1, matrix({{1, 1}, {1, 1}}), identity, matrix({{1, 0}}), matrix({{1}}))));
  CHECK_FALSE(
      theorems::window_gramians(time_invariant(1, identity, identity, matrix({{1, 0}}), matrix({{0}}))));
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    CHECK_FALSE(theorems::window_gramians(
        time_invariant(1, matrix({{bad, 0}, {0, 1}}), identity, matrix({{1, 0}}), matrix({{1}}))));
    const auto unbounded = theorems::window_gramians(
        time_invariant(1, identity, matrix({{bad, 0}, {0, 1}}), identity, identity));
    CHECK_FALSE((unbounded && theorems::covariance_bound(*unbounded) &&
                 rigor::is_finite(*theorems::covariance_bound(*unbounded))));
  }
  LinearWindow window = time_invariant(1, identity, identity, matrix({{1, 0}}), matrix({{1}}));
  window.outputs.pop_back();
  CHECK_THROWS_AS((void)theorems::window_gramians(window), std::invalid_argument);
}

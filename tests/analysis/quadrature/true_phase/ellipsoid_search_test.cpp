#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/true_phase/textbook_filter.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

double level(const ErrorEllipsoid& set, const Eigen::Vector3d& e) {
  return e.dot(set.shape * e);
}

/// The noise of that size after which e' M e is largest, of 24 directions.
Eigen::Vector2d worst_noise(const test::TextbookFilter& filter, const ErrorEllipsoid& set, double size,
                            double next_phase, double next_frequency) {
  constexpr int kDirections = 24;
  Eigen::Vector2d worst = Eigen::Vector2d::Zero();
  double largest = -1.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * i / kDirections;
    const Eigen::Vector2d noise = size * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    test::TextbookFilter next = filter;
    next.step(test::measured(next_phase, noise));
    if (const double reached = level(set, next.errors(next_phase, next_frequency)); reached > largest) {
      largest = reached;
      worst = noise;
    }
  }
  return worst;
}

Eigen::Vector3d on_the_boundary(const ErrorEllipsoid& set, test::Random& random) {
  const Eigen::Vector3d e(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return e / std::sqrt(level(set, e));
}

/// Runs the textbook filter from boundary points of set and range; the largest e' M e that is met after a
/// step, and that at the end.
std::array<double, 2> stay_inside(const EllipsoidQuestion& question, const ErrorEllipsoid& set, int runs) {
  constexpr int kSteps = 60;
  constexpr double kRounding = 1e-9;
  test::Random random(41);
  double largest = 0.0;
  double last = 0.0;
  for (int k = 0; k < runs; ++k) {
    double phase = random.uniform(0.0, 6.28);
    double frequency = random.uniform(0.05, 3.0);
    const double share = random.uniform();
    const Eigen::Matrix3d p = share * set.lowest + (1.0 - share) * set.highest;
    auto filter =
        test::TextbookFilter::with(question.design, on_the_boundary(set, random), p, phase, frequency);
    for (int step = 0; step < kSteps; ++step) {
      phase += frequency;
      frequency += (random.below(2) == 0 ? -1.0 : 1.0) * question.slew;
      filter.step(test::measured(phase, worst_noise(filter, set, question.noise, phase, frequency)));
      last = level(set, filter.errors(phase, frequency));
      largest = std::max(largest, last);
      CHECK(last <= 1.0 + kRounding);
      CHECK(test::is_below(set.lowest, filter.covariance(phase)));
      CHECK(test::is_below(filter.covariance(phase), set.highest));
    }
  }
  return {largest, last};
}

TEST_CASE("the textbook filter with the worst noise never leaves the set that is found for figure 3.5") {
  const rigor::UpwardRounding upward;
  const EllipsoidQuestion question = test::figure_3_5();
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  CHECK(std::sqrt(found->set.inverse(2, 2)) < 0.006);
  const auto [largest, last] = stay_inside(question, found->set, static_cast<int>(test::effort(40)));
  CHECK(largest > 0.8);  // the set is not much too large
  CHECK(last <= ultimate_level(question, found->set));
}

TEST_CASE("with a slew, too") {
  const rigor::UpwardRounding upward;
  EllipsoidQuestion question = test::figure_3_5();
  question.slew = 0.0005;
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  stay_inside(question, found->set, static_cast<int>(test::effort(20)));
}

TEST_CASE("noise of 0.012 from starts that are near: the set is as large as the noise asks") {
  const rigor::UpwardRounding upward;
  EllipsoidQuestion question = test::figure_3_5();
  question.noise = 0.012;
  question.amplitude_error = question.phase_error = question.frequency_error = 0.001;
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  stay_inside(question, found->set, static_cast<int>(test::effort(20)));
}

TEST_CASE("the starts lie inside, and nothing is found for a noise at which the filter loses its tone") {
  const rigor::UpwardRounding upward;
  EllipsoidQuestion question = test::figure_3_5();
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  for (const double a : {-0.005, 0.005}) {
    for (const double psi : {-0.005, 0.005}) {
      for (const double nu : {-0.005, 0.005}) {
        const Eigen::Vector3d e((1.0 + a) * std::cos(psi) - 1.0, (1.0 + a) * std::sin(psi), nu);
        CHECK(level(found->set, e) <= 1.0);
        const Eigen::Matrix3d turn = test::TextbookFilter::turn(psi);
        CHECK(test::is_below(turn * question.start_highest * turn.transpose(), found->set.highest));
        CHECK(test::is_below(found->set.lowest, turn * question.start_lowest * turn.transpose()));
      }
    }
  }
  question.noise = 0.5;
  CHECK_FALSE(search_ellipsoid(question, EllipsoidAim::for_ever).has_value());
}

TEST_CASE("a stored number has 40 bits") {
  CHECK(stored(0.5) == 0.5);
  CHECK(stored(1.0 / 3.0) != 1.0 / 3.0);
  CHECK(std::ldexp(stored(1.0 / 3.0), 41) == std::rint(std::ldexp(stored(1.0 / 3.0), 41)));
  CHECK(stored(1.0 / 3.0) == doctest::Approx(1.0 / 3.0).epsilon(1e-11));
  CHECK(stored(1e-30) == 0.0);
}

TEST_CASE("covariance and gain of a step are those of the textbook filter") {
  test::Random random(43);
  const trackers::ToneModel<double> design{0.0023, 0.0023, 0.05, 0.0};
  for (std::int64_t k = 0; k < test::effort(100); ++k) {
    Eigen::Matrix3d root;
    for (Eigen::Index i = 0; i < 9; ++i) {
      root(i) = random.uniform(-0.2, 0.2);
    }
    const Eigen::Matrix3d p = root * root.transpose();
    const Eigen::Vector3d e(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3));
    auto filter = test::TextbookFilter::with(design, e, p, 0.7, 1.1);
    filter.step(test::measured(1.8, Eigen::Vector2d::Zero()));
    // In the frame of the prediction, which is turned by nu from that of the true phase.
    const Eigen::Matrix3d seen = filter.covariance(1.8 + e(2));
    CHECK((covariance_after(design, p, e(0), e(1)) - seen).norm() < 1e-12);
    CHECK((gain_at(design, p, e(0), e(1)) - seen.leftCols<2>() / design.r).norm() < 1e-10);
  }
}

}  // namespace
}  // namespace veritrack::quadrature

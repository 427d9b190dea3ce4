#include "analysis/model/filter/filter_numbers.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

Eigen::Vector2d random_estimate(test::Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

double difference_of(const SmallMatrix& a, const MatrixXd& b) {
  REQUIRE(a.rows() == b.rows());
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

TEST_CASE("a filter's matrices in doubles are those of its formulas") {
  for (const int channels : {1, 2}) {
    CAPTURE(channels);
    test::BentFilter bent;
    bent.channels = channels;
    const test::ExampleFilter filter = bent.filter();
    const TrackedTone tone = test::tone_of(filter);
    const FilterNumbers numbers(tone);
    CHECK(numbers.states() == 2);
    CHECK_FALSE(numbers.has_given_jacobian());
    CHECK(difference_of(numbers.measured(), bent.measured()) == 0.0);
    CHECK(difference_of(numbers.process(), bent.process()) == 0.0);
    CHECK(difference_of(rigor::product(bent.noise(), numbers.weighted()), bent.measured()) < 1e-14);
  }
}

TEST_CASE("a filter's prediction, its Jacobian and the changes of that are those of its formulas") {
  test::Random random(901);
  for (const bool is_given : {false, true}) {
    CAPTURE(is_given);
    test::BentFilter bent;
    bent.gives_jacobian = is_given;
    const test::ExampleFilter filter = bent.filter();
    const TrackedTone tone = test::tone_of(filter);
    FilterNumbers numbers(tone);
    CHECK(numbers.has_given_jacobian() == is_given);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d x = random_estimate(random);
      const Eigen::Vector2d direction = random_estimate(random);
      CHECK(difference_of(numbers.slope(x), bent.slope(x)) < 1e-9);
      CHECK(difference_of(numbers.jacobian(x), bent.jacobian(x)) < 1e-15);
      CHECK(difference_of(numbers.predicted(), bent.next(x)) < 1e-15);
      // Both are affine in the estimate.
      CHECK(difference_of(numbers.change(x, direction), bent.jacobian(x + direction) - bent.jacobian(x)) <
            1e-11);
      CHECK(difference_of(numbers.change_of_slope(x, direction), bent.slope(x + direction) - bent.slope(x)) <
            1e-6);
    }
  }
}

TEST_CASE("a covariance after a sample has the information of both") {
  test::Random random(902);
  for (const int channels : {1, 2}) {
    test::BentFilter bent;
    bent.channels = channels;
    const test::ExampleFilter filter = bent.filter();
    const TrackedTone tone = test::tone_of(filter);
    const FilterNumbers numbers(tone);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Matrix2d root{{random.uniform(0.1, 1.0), 0.0},
                                 {random.uniform(-1.0, 1.0), random.uniform(0.1, 1.0)}};
      const Eigen::Matrix2d predicted = root * root.transpose();
      const SmallMatrix updated = numbers.updated(predicted);
      CHECK(difference_of(updated, bent.updated(predicted)) < 1e-12);
      CHECK(updated(0, 1) == updated(1, 0));
    }
  }
  const test::ScalarFilter scalar{.h = 1.5};
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  CHECK(FilterNumbers(tone).updated(SmallMatrix::Constant(1, 1, 0.3))(0, 0) ==
        doctest::Approx(scalar.updated(0.3)).epsilon(1e-14));
}

}  // namespace
}  // namespace veritrack::model::detail

#include "analysis/quadrature/true_phase/cell_forms.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/true_phase/textbook_filter.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

/// A box beside the middle of the set for figure 3.5, with its numbers.
struct Example {
  EllipsoidQuestion question = test::figure_3_5();
  ErrorEllipsoid set;
  ErrorBox box;
  CellNumbers cell;

  Example() {
    const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
    REQUIRE(found.has_value());
    set = found->set;
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = std::sqrt(set.inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
      box.sides.at(i) = rigor::Interval::from_bounds(0.25 * side, 0.3 * side);
    }
    const auto numbers = numbers_for(question.design, set, box);
    REQUIRE(numbers.has_value());
    cell = *numbers;
  }
};

double within(const rigor::Interval& side, test::Random& random) {
  return random.uniform(side.lower(), side.upper());
}

TEST_CASE("what the forms say of a box is true of the textbook filter") {
  const rigor::UpwardRounding upward;
  const Example example;
  const auto& [question, set, box, cell] = example;
  CHECK(upper_form_is_positive(question.design, set, cell, box));
  CHECK(lower_form_is_positive(question.design, set, cell, box));
  CHECK(error_form_is_positive(question.design, set, cell, box));
  test::Random random(51);
  for (std::int64_t k = 0; k < test::effort(2000); ++k) {
    const Eigen::Vector3d e(within(box.sides[0], random), within(box.sides[1], random),
                            within(box.sides[2], random));
    const double share = random.below(3) == 0 ? random.uniform() : static_cast<double>(random.below(2));
    const Eigen::Matrix3d p = share * set.lowest + (1.0 - share) * set.highest;
    const Eigen::Vector2d noise(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01));
    const double slew = random.uniform(-0.001, 0.001);
    auto filter = test::TextbookFilter::with(question.design, e, p, 0.4, 1.3);
    filter.step(test::measured(1.7, noise));
    const Eigen::Vector3d after = filter.errors(1.7, 1.3 + slew);
    CHECK(after.dot(set.shape * after) <= set.kappa2 * e.dot(set.shape * e) +
                                              set.noise_gain * noise.squaredNorm() +
                                              set.slew_gain * slew * slew);
    const Eigen::Matrix3d before_turn = filter.covariance(1.7 + e(2));
    CHECK(test::is_below(cell.lowest, before_turn));
    CHECK(test::is_below(before_turn, cell.highest));
  }
}

TEST_CASE("claims that say more are not positive") {
  const rigor::UpwardRounding upward;
  const Example example;
  const auto& design = example.question.design;
  CellNumbers cell = example.cell;
  cell.highest = 0.9 * covariance_after(design, example.set.highest, 0.0, 0.0);
  CHECK_FALSE(upper_form_is_positive(design, example.set, cell, example.box));
  cell = example.cell;
  cell.lowest = 1.1 * covariance_after(design, example.set.lowest, 0.0, 0.0);
  CHECK_FALSE(lower_form_is_positive(design, example.set, cell, example.box));
  ErrorEllipsoid set = example.set;
  set.kappa2 *= 0.5;
  CHECK_FALSE(error_form_is_positive(design, set, example.cell, example.box));
  set = example.set;
  set.noise_gain *= 0.001;
  CHECK_FALSE(error_form_is_positive(design, set, example.cell, example.box));
  set = example.set;
  set.slew_gain = 0.0;
  CHECK_FALSE(error_form_is_positive(design, set, example.cell, example.box));
  ErrorBox wide = example.box;
  for (rigor::Interval& side : wide.sides) {
    side = rigor::symmetric(0.9);
  }
  CHECK_FALSE(error_form_is_positive(design, example.set, example.cell, wide));
}

TEST_CASE("a matrix that is turned") {
  const rigor::UpwardRounding upward;
  const Eigen::Matrix3d m = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  CHECK(is_inside_when_turned(m, 1.2 * m, rigor::symmetric(0.05), false));
  CHECK(is_inside_when_turned(m, 0.8 * m, rigor::symmetric(0.05), true));
  CHECK_FALSE(is_inside_when_turned(m, 1.001 * m, rigor::symmetric(0.5), false));
  CHECK_FALSE(is_inside_when_turned(m, 0.999 * m, rigor::symmetric(0.5), true));
  CHECK_FALSE(is_inside_when_turned(m, 0.8 * m, rigor::symmetric(0.0), false));
}

TEST_CASE("a box is outside only when none of its points is inside") {
  const rigor::UpwardRounding upward;
  const Example example;
  test::Random random(52);
  int outside = 0;
  for (std::int64_t k = 0; k < test::effort(300); ++k) {
    ErrorBox box;
    for (rigor::Interval& side : box.sides) {
      const double middle = random.uniform(-0.03, 0.03);
      side = rigor::Interval::from_bounds(middle - 0.002, middle + 0.002);
    }
    if (!is_outside(example.set, box)) {
      continue;
    }
    ++outside;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d e(within(box.sides[0], random), within(box.sides[1], random),
                              within(box.sides[2], random));
      CHECK(e.dot(example.set.shape * e) > 1.0);
    }
  }
  CHECK(outside > 0);
}

}  // namespace
}  // namespace veritrack::quadrature

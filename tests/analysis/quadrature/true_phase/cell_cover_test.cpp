#include "analysis/quadrature/true_phase/cell_cover.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/true_phase/textbook_filter.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

/// The leaf in which a point lies, and its box.
const CellTree& leaf_of(const CellTree& tree, const Eigen::Vector3d& e, ErrorBox& box) {
  if (tree.kind != CellTree::Kind::cut) {
    return tree;
  }
  rigor::Interval& side = box.sides.at(static_cast<std::size_t>(tree.axis));
  if (e(tree.axis) <= tree.at) {
    side = rigor::Interval::from_bounds(side.lower(), tree.at);
    return leaf_of(*tree.below, e, box);
  }
  side = rigor::Interval::from_bounds(tree.at, side.upper());
  return leaf_of(*tree.above, e, box);
}

TEST_CASE("every error of the ellipsoid lies in a box that is checked") {
  const rigor::UpwardRounding upward;
  const EllipsoidQuestion question = test::figure_3_5();
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  const ErrorEllipsoid& set = found->set;
  test::Random random(61);
  for (std::int64_t k = 0; k < test::effort(2000); ++k) {
    Eigen::Vector3d e(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    e *= (random.below(2) == 0 ? 1.0 : random.uniform()) / std::sqrt(e.dot(set.shape * e));
    ErrorBox box = box_around(set);
    const CellTree& leaf = leaf_of(*found->cells, e, box);
    REQUIRE(leaf.kind == CellTree::Kind::checked);
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = e(static_cast<Eigen::Index>(i));
      CHECK((box.sides.at(i).lower() <= at && at <= box.sides.at(i).upper()));
    }
    if (k % 20 == 0) {
      CHECK(upper_form_is_positive(question.design, set, leaf.numbers, box));
      CHECK(lower_form_is_positive(question.design, set, leaf.numbers, box));
      CHECK(error_form_is_positive(question.design, set, leaf.numbers, box));
      CHECK(is_inside_when_turned(leaf.numbers.highest, set.highest, box.sides[2], false));
      CHECK(is_inside_when_turned(leaf.numbers.lowest, set.lowest, box.sides[2], true));
      CHECK(leaf.numbers.lambda * leaf.numbers.mu * question.design.r * question.design.r >= 1.0);
    }
  }
}

TEST_CASE("no cover with too few boxes, nor of a set that the filter leaves") {
  const rigor::UpwardRounding upward;
  const EllipsoidQuestion question = test::figure_3_5();
  const auto found = search_ellipsoid(question, EllipsoidAim::for_ever);
  REQUIRE(found.has_value());
  CHECK(cover(question.design, found->set, 100) != nullptr);
  CHECK(cover(question.design, found->set, 2) == nullptr);
  ErrorEllipsoid set = found->set;
  set.kappa2 *= 0.5;
  CHECK(cover(question.design, set, 100) == nullptr);
  set = found->set;
  set.highest = 0.5 * (set.highest + set.lowest);
  CHECK(cover(question.design, set, 100) == nullptr);
}

}  // namespace
}  // namespace veritrack::quadrature

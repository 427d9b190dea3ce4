#include "analysis/quadrature/true_phase/steady_bounds.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/true_phase/textbook_filter.hpp"

namespace veritrack::quadrature {
namespace {

TEST_CASE("bounds around the steady state are found, and none around another matrix") {
  const rigor::UpwardRounding upward;
  const EllipsoidQuestion question = test::figure_3_5();
  const trackers::ToneModel<double>& design = question.design;
  const Eigen::Matrix3d& lowest = question.start_lowest;
  const Eigen::Matrix3d& highest = question.start_highest;
  const auto bounds = steady_bounds(design, lowest, highest);
  REQUIRE(bounds.has_value());
  CHECK(bounds->least_share > 0.0);
  CHECK(bounds->least_size > 0.0);
  CHECK(steady_bounds(design, 0.2 * lowest, 5.0 * highest).has_value());
  // The steady state is not between these: one step of the textbook filter leads past them.
  CHECK_FALSE(steady_bounds(design, 0.5 * lowest, 0.9 * lowest).has_value());
  CHECK_FALSE(steady_bounds(design, 1.1 * highest, 2.0 * highest).has_value());
}

TEST_CASE("none for a filter without process noise, whose covariance goes to 0") {
  const rigor::UpwardRounding upward;
  const EllipsoidQuestion question = test::figure_3_5();
  trackers::ToneModel<double> design = question.design;
  design.q1 = design.q2 = 0.0;
  CHECK_FALSE(steady_bounds(design, question.start_lowest, question.start_highest).has_value());
}

}  // namespace
}  // namespace veritrack::quadrature

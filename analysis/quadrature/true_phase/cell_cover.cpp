#include "analysis/quadrature/true_phase/cell_cover.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::quadrature {

namespace {

using Eigen::Matrix3d;
using rigor::Interval;

/// |E| in the metric of the covariance, with some of its largest eigenvalue in every direction, because the
/// entries of an interval matrix are independent.
Matrix3d absolute(const Matrix3d& difference, const Matrix3d& covariance) {
  constexpr double kEverywhere = 0.4;
  const Matrix3d root = covariance.llt().matrixL();
  const Matrix3d inverse = root.inverse();
  const Matrix3d seen = inverse * difference * inverse.transpose();
  const rigor::Eigensystem system = rigor::symmetric_eigensystem(seen);
  const Eigen::Vector3d sizes = system.values.cwiseAbs();
  const Eigen::Vector3d widened = sizes.array() + kEverywhere * sizes.maxCoeff();
  const Matrix3d basis = root * system.vectors;
  return basis * widened.asDiagonal() * basis.transpose();
}

/// How far the covariance after the step is from that at the middle of the box, roughly.
Matrix3d spread(const trackers::ToneModel<double>& design, const Matrix3d& covariance, const ErrorBox& box,
                const Matrix3d& at_middle) {
  constexpr double kLeast = 1e-6;
  const double m1 = rigor::midpoint(box.sides[0]);
  const double m2 = rigor::midpoint(box.sides[1]);
  const double h1 = rigor::radius(box.sides[0]);
  const double h2 = rigor::radius(box.sides[1]);
  const auto after = [&](double e1, double e2) { return covariance_after(design, covariance, e1, e2); };
  return absolute((after(m1 + h1, m2) - after(m1 - h1, m2)) / 2.0, at_middle) +
         absolute((after(m1, m2 + h2) - after(m1, m2 - h2)) / 2.0, at_middle) + kLeast * at_middle;
}

/// A box, and where in the tree it is noted.
struct NotedBox {
  ErrorBox box;
  CellTree* node;
};

/// Cuts the longest side in the middle, and notes where.
std::array<NotedBox, 2> cut(const NotedBox& whole) {
  CellTree& tree = *whole.node;
  const auto& sides = whole.box.sides;
  tree.kind = CellTree::Kind::cut;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (rigor::width(sides.at(axis)) > rigor::width(sides.at(static_cast<std::size_t>(tree.axis)))) {
      tree.axis = static_cast<int>(axis);
    }
  }
  const auto axis = static_cast<std::size_t>(tree.axis);
  tree.at = rigor::midpoint(sides.at(axis));
  tree.below = std::make_unique<CellTree>();
  tree.above = std::make_unique<CellTree>();
  NotedBox below{whole.box, tree.below.get()};
  NotedBox above{whole.box, tree.above.get()};
  below.box.sides.at(axis) = Interval::from_bounds(sides.at(axis).lower(), tree.at);
  above.box.sides.at(axis) = Interval::from_bounds(tree.at, sides.at(axis).upper());
  return {below, above};
}

}  // namespace

ErrorBox box_around(const ErrorEllipsoid& set) {
  constexpr double kWider = 1.0002;
  ErrorBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double half = stored(kWider * std::sqrt(set.inverse(k, k)));
    box.sides.at(i) = Interval::from_bounds(-half, half);
  }
  return box;
}

std::optional<CellNumbers> numbers_for(const trackers::ToneModel<double>& design, const ErrorEllipsoid& set,
                                       const ErrorBox& box) {
  constexpr std::array kMargins{1.05, 1.2, 1.5, 2.0, 3.0, 5.0};
  constexpr std::array kShares{0.1, 0.05, 0.2, 0.025, 0.4, 0.012, 0.006, 0.003};
  constexpr double kAboveOne = 1.000001;
  const double e1 = rigor::midpoint(box.sides[0]);
  const double e2 = rigor::midpoint(box.sides[1]);
  CellNumbers cell;
  cell.gain = stored(gain_at(design, set.highest, e1, e2));
  const auto first_margin = [&](const Matrix3d& from, double sign, Matrix3d& bound, auto is_positive) {
    const Matrix3d middle = covariance_after(design, from, e1, e2);
    const Matrix3d around = spread(design, from, box, middle);
    for (const double margin : kMargins) {
      bound = stored(Matrix3d(middle + sign * margin * around));
      if (is_positive(design, set, cell, box)) {
        return true;
      }
    }
    return false;
  };
  if (!first_margin(set.highest, 1.0, cell.highest, upper_form_is_positive) ||
      !first_margin(set.lowest, -1.0, cell.lowest, lower_form_is_positive) ||
      !is_inside_when_turned(cell.highest, set.highest, box.sides[2], false) ||
      !is_inside_when_turned(cell.lowest, set.lowest, box.sides[2], true)) {
    return std::nullopt;
  }
  const Matrix3d half = (cell.highest - cell.lowest) / 2.0;
  const double ratio = rigor::pencil_eigensystem(half, set.inverse).values(2);
  for (const double share : kShares) {
    cell.lambda = stored(share / ratio);
    cell.mu = stored(kAboveOne / (cell.lambda * design.r * design.r));
    if (error_form_is_positive(design, set, cell, box)) {
      return cell;
    }
  }
  return std::nullopt;
}

std::unique_ptr<CellTree> cover(const trackers::ToneModel<double>& design, const ErrorEllipsoid& set,
                                int most_boxes) {
  auto tree = std::make_unique<CellTree>();
  const auto look = [&](const NotedBox& here) -> search::CellDecision<NotedBox> {
    if (is_outside(set, here.box)) {
      return {true};
    }
    if (const auto numbers = numbers_for(design, set, here.box)) {
      here.node->kind = CellTree::Kind::checked;
      here.node->numbers = *numbers;
      return {true};
    }
    if (--most_boxes <= 0) {
      return {};
    }
    return {false, cut(here)};
  };
  constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();  // most_boxes limits the cuts
  const bool is_covered =
      search::cover_by_bisection(NotedBox{box_around(set), tree.get()}, kUnlimited, look).is_proved;
  return is_covered ? std::move(tree) : nullptr;
}

}  // namespace veritrack::quadrature

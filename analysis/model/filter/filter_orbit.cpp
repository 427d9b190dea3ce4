#include "analysis/model/filter/filter_orbit.hpp"

#include <cmath>
#include <utility>

namespace veritrack::model::detail {

using rigor::cholesky;
using rigor::combination;
using rigor::congruence;
using rigor::product;

void FilterOrbit::begin(double phase) {
  number_ = 0;
  point_ = points_ != nullptr ? points_->find(0) : nullptr;
  if (point_ == nullptr) {
    own_ = walk_.first(phase);
    point_ = &own_;
  }
  updated_low_ = updated_high_ = point_->covariance;
  here_.shape = parameters_.process.asDiagonal();
  here_.low = here_.high = point_->covariance;
}

bool FilterOrbit::step() {
  constexpr double kFar = 1e12;
  auto root = cholesky(here_.shape);
  if (!root || !(here_.shape.maxCoeff() < kFar)) {
    return false;
  }
  last_.before = *std::move(root);
  last_.slope = point_->slope;
  FilterOnOrbit next;
  if (!step_bounds(is_inside_ ? SmallMatrix(point_->wide) : last_.before, next) || !cholesky(next.low) ||
      !(next.high.maxCoeff() < kFar)) {
    return false;
  }
  updated_high_ = walk_.numbers().updated(next.high);
  updated_low_ = walk_.numbers().updated(next.low);
  step_gain();
  next.shape = next_shape();
  advance();
  if (moves_) {
    last_.move = point_->move;
    next.shape += parameters_.moving * rigor::product_with_transpose(last_.move, last_.move);
  }
  last_.after = next.shape;
  here_ = std::move(next);
  last_.innovation = point_->innovation;
  last_.offset = combination(1.0, product(last_.gain, last_.innovation), -1.0, point_->correction);
  return true;
}

/// The predicted bounds, for estimates in `wide` L'; false where they are invalid.
bool FilterOrbit::step_bounds(const SmallMatrix& wide, FilterOnOrbit& next) {
  const OrbitPoint& now = *point_;
  const Index n = walk_.numbers().states();
  const bool is_same = now.changes_of_slope.empty();
  SmallMatrix of_high = SmallMatrix::Zero(n, n);
  SmallMatrix of_low = SmallMatrix::Zero(n, n);
  last_.changes.clear();
  for (Index i = 0; i < n; ++i) {
    const SmallMatrix change = change_along(now.changes, wide.col(i));
    last_.changes.push_back(
        is_same && !is_inside_
            ? change
            : change_along(is_same ? now.changes : now.changes_of_slope, last_.before.col(i)));
    of_high += congruence(change, updated_high_);
    of_low += congruence(change, updated_low_);
  }
  const double slack = is_inside_ || moves_ ? kWideSlack : kSlack;
  constexpr double kHigherOrders = 1.1;
  const double eta = parameters_.eta;
  const double theta = parameters_.theta;
  const SmallMatrix& process = walk_.numbers().process();
  const auto bound = [&](double factor, double of_jacobian, const SmallMatrix& updated, double of_changes,
                         const SmallMatrix& changes) {
    const SmallMatrix first = combination(1.0, process, of_jacobian, congruence(now.jacobian, updated));
    return combination(factor, first, factor * of_changes, changes);
  };
  next.high = bound(1.0 + slack, 1.0 + eta, updated_high_, (1.0 + 1.0 / eta) * kHigherOrders, of_high);
  next.low = bound(1.0 - slack, 1.0 - theta, updated_low_, -(1.0 / theta - 1.0) * kHigherOrders, of_low);
  return next.low.allFinite();
}

/// From the updated bounds.
void FilterOrbit::step_gain() {
  const FilterNumbers& numbers = walk_.numbers();
  const SmallMatrix middle = combination(0.5, updated_high_, 0.5, updated_low_);
  last_.delta = combination(0.5, updated_high_, -0.5, updated_low_);
  last_.gain = rigor::product_with_transpose(middle, numbers.weighted());
  last_.contraction =
      combination(1.0, rigor::identity(numbers.states()), -1.0, product(last_.gain, numbers.measured()));
}

/// A Lyapunov recursion, with the range of gains as one of its sources.
SmallMatrix FilterOrbit::next_shape() const {
  const SmallMatrix carried = congruence(product(last_.contraction, last_.slope), here_.shape);
  const SmallMatrix sources =
      combination(parameters_.source, rigor::product_with_transpose(last_.gain, last_.gain),
                  parameters_.spread, last_.delta);
  SmallMatrix shape = combination(1.0 / parameters_.lambda, carried, 1.0, sources);
  shape.diagonal() += parameters_.process;
  return shape;
}

double FilterOrbit::reach() const {
  return std::sqrt(congruence(point_->gradient, here_.shape)(0, 0));
}

void FilterOrbit::advance() {
  ++number_;
  const OrbitPoint* next = points_ != nullptr ? points_->find(number_) : nullptr;
  if (next == nullptr) {
    own_ = walk_.after(*point_);
    next = &own_;
  }
  point_ = next;
}

}  // namespace veritrack::model::detail

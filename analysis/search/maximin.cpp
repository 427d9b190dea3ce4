#include "analysis/search/maximin.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace veritrack::search {

namespace {

constexpr double kLowestLeast = -1e9;

/// The variables are x and, last, t.
struct LeastSearch {
  const Functions& functions;
  const SearchSpace& space;
  BestPoint best;
  int evaluations_left;
  std::exception_ptr thrown;

  Eigen::VectorXd values(const Eigen::VectorXd& point) {
    if (evaluations_left-- <= 0) {
      throw nlopt::forced_stop();
    }
    Eigen::VectorXd found;
    try {
      found = functions(point);
    } catch (...) {
      thrown = std::current_exception();
      throw nlopt::forced_stop();
    }
    for (Eigen::Index k = 0; k < found.size(); ++k) {
      found[k] = std::isfinite(found[k]) ? std::max(found[k], kLowestLeast) : kLowestLeast;
    }
    if (const double least = found.minCoeff(); least > best.value) {
      best = {point, least};
    }
    return found;
  }
};

double largest_least(const std::vector<double>& x, std::vector<double>& gradient, void* /*data*/) {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  if (!gradient.empty()) {
    gradient.back() = 1.0;
  }
  return x.back();
}

/// t - f_k(x) <= 0, row by row.
void constraints(unsigned int rows, double* result, unsigned int columns, const double* x, double* gradient,
                 void* data) {
  constexpr double kPart = 1e-4;
  LeastSearch& search = *static_cast<LeastSearch*>(data);
  const auto size = static_cast<Eigen::Index>(columns) - 1;
  const Eigen::VectorXd point = Eigen::Map<const Eigen::VectorXd>(x, size);
  const Eigen::VectorXd values = search.values(point);
  for (unsigned int k = 0; k < rows; ++k) {
    result[k] = x[size] - values[k];
  }
  if (gradient == nullptr) {
    return;
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const double away = kPart * search.space.step[i];
    Eigen::VectorXd moved = point;
    moved[i] += away;
    const Eigen::VectorXd after = search.values(moved);
    for (unsigned int k = 0; k < rows; ++k) {
      gradient[k * columns + static_cast<unsigned int>(i)] = -(after[k] - values[k]) / away;
    }
  }
  for (unsigned int k = 0; k < rows; ++k) {
    gradient[(k + 1) * columns - 1] = 1.0;
  }
}

std::vector<double> with_last(const Eigen::VectorXd& x, double last) {
  std::vector<double> result(x.data(), x.data() + x.size());
  result.push_back(last);
  return result;
}

}  // namespace

BestPoint climb_least(const Functions& functions, const SearchSpace& space) {
  const Eigen::Index size = space.start.size();
  if (size == 0 || space.step.size() != size || space.lower.size() != size || space.upper.size() != size) {
    throw std::invalid_argument("start, step, lower and upper must have the same size, not zero");
  }
  LeastSearch search{
      functions, space, {space.start, -std::numeric_limits<double>::max()}, space.evaluations, nullptr};
  try {
    const Eigen::VectorXd start = space.start.cwiseMax(space.lower).cwiseMin(space.upper);
    const Eigen::VectorXd first = search.values(start);
    nlopt::opt optimizer(nlopt::LD_SLSQP, static_cast<unsigned int>(size) + 1);
    optimizer.set_max_objective(largest_least, nullptr);
    optimizer.add_inequality_mconstraint(constraints, &search,
                                         std::vector<double>(static_cast<std::size_t>(first.size()), 1e-8));
    optimizer.set_lower_bounds(with_last(space.lower, kLowestLeast));
    optimizer.set_upper_bounds(with_last(space.upper, -kLowestLeast));
    optimizer.set_xtol_rel(space.tolerance);
    optimizer.set_maxeval(space.evaluations);
    std::vector<double> x = with_last(start, first.minCoeff());
    double value = 0.0;
    optimizer.optimize(x, value);
  } catch (const std::exception&) {
    // Stopped, out of range, or limited by rounding: the best point so far is the result.
  }
  if (search.thrown) {
    std::rethrow_exception(search.thrown);
  }
  return search.best;
}

}  // namespace veritrack::search

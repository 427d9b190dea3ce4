#include "analysis/search/maximize.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace veritrack::search {

namespace {

constexpr double kLowest = -std::numeric_limits<double>::max();

struct Search {
  const std::function<double(const Eigen::VectorXd&)>& objective;
  BestPoint best;
  int evaluations_left;
  std::exception_ptr thrown;
};

/// What NLopt calls: minus infinity and NaN become the lowest double, and nothing is thrown through C code.
double evaluate(const std::vector<double>& x, std::vector<double>& /*gradient*/, void* data) {
  Search& search = *static_cast<Search*>(data);
  if (search.evaluations_left-- <= 0) {
    throw nlopt::forced_stop();
  }
  const Eigen::VectorXd point =
      Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  double value = kLowest;
  try {
    value = search.objective(point);
  } catch (...) {
    search.thrown = std::current_exception();
    throw nlopt::forced_stop();
  }
  if (!(value > kLowest)) {
    return kLowest;
  }
  if (value > search.best.value) {
    search.best = {point, value};
  }
  return value;
}

std::vector<double> to_std(const Eigen::VectorXd& x) {
  return {x.data(), x.data() + x.size()};
}

}  // namespace

BestPoint maximize(const std::function<double(const Eigen::VectorXd&)>& objective, const SearchSpace& space) {
  const Eigen::Index size = space.start.size();
  if (size == 0 || space.step.size() != size || space.lower.size() != size || space.upper.size() != size) {
    throw std::invalid_argument("maximize: start, step, lower and upper must have the same size, not zero");
  }
  Search search{objective, {space.start, kLowest}, space.evaluations, nullptr};
  try {
    const auto algorithm = space.method == SearchMethod::direct ? nlopt::GN_DIRECT_L : nlopt::LN_SBPLX;
    nlopt::opt optimizer(algorithm, static_cast<unsigned int>(size));
    optimizer.set_max_objective(evaluate, &search);
    optimizer.set_lower_bounds(to_std(space.lower));
    optimizer.set_upper_bounds(to_std(space.upper));
    optimizer.set_initial_step(to_std(space.step));
    optimizer.set_xtol_rel(space.tolerance);
    optimizer.set_maxeval(space.evaluations);
    std::vector<double> x = to_std(space.start.cwiseMax(space.lower).cwiseMin(space.upper));
    double value = 0.0;
    optimizer.optimize(x, value);
  } catch (const std::exception&) {
    // Stopped, out of range, rounded off: the best point so far stands.
  }
  if (search.thrown) {
    std::rethrow_exception(search.thrown);
  }
  return search.best;
}

}  // namespace veritrack::search

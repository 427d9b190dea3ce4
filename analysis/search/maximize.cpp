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
  const Eigen::VectorXd& step;
  double enough;
  BestPoint best;
  int evaluations_left;
  std::exception_ptr thrown;

  /// Minus infinity and NaN become the lowest double, and no exception passes through C code.
  double value(const Eigen::VectorXd& point) {
    if (evaluations_left-- <= 0) {
      throw nlopt::forced_stop();
    }
    double found = kLowest;
    try {
      found = objective(point);
    } catch (...) {
      thrown = std::current_exception();
      throw nlopt::forced_stop();
    }
    if (!(found > kLowest)) {
      return kLowest;
    }
    if (found > best.value) {
      best = {point, found};
    }
    if (found >= enough) {
      throw nlopt::forced_stop();
    }
    return found;
  }
};

/// The function that NLopt calls.
double evaluate(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  constexpr double kPart = 1e-4;
  Search& search = *static_cast<Search*>(data);
  const Eigen::VectorXd point =
      Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double away = kPart * search.step[index];
    Eigen::VectorXd above = point;
    Eigen::VectorXd below = point;
    above[index] += away;
    below[index] -= away;
    gradient[i] = (search.value(above) - search.value(below)) / (2.0 * away);
  }
  return search.value(point);
}

std::vector<double> to_std(const Eigen::VectorXd& x) {
  return {x.data(), x.data() + x.size()};
}

BestPoint run(nlopt::algorithm algorithm, const std::function<double(const Eigen::VectorXd&)>& objective,
              const SearchSpace& space) {
  const Eigen::Index size = space.start.size();
  if (size == 0 || space.step.size() != size || space.lower.size() != size || space.upper.size() != size) {
    throw std::invalid_argument("start, step, lower and upper must have the same size, not zero");
  }
  Search search{objective, space.step, space.enough, {space.start, kLowest}, space.evaluations, nullptr};
  try {
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
    // Stopped, out of range, or limited by rounding: the best point so far is the result.
  }
  if (search.thrown) {
    std::rethrow_exception(search.thrown);
  }
  return search.best;
}

}  // namespace

BestPoint maximize(const std::function<double(const Eigen::VectorXd&)>& objective, const SearchSpace& space) {
  return run(space.method == SearchMethod::direct ? nlopt::GN_DIRECT_L : nlopt::LN_SBPLX, objective, space);
}

BestPoint climb(const std::function<double(const Eigen::VectorXd&)>& objective, const SearchSpace& space) {
  return run(nlopt::LD_MMA, objective, space);
}

}  // namespace veritrack::search

// Proposals: a search for a maximum, by NLopt. Nothing it returns is evidence of anything.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>

namespace veritrack::search {

/// The method: locally with Sbplx (T. H. Rowan's variant of the Nelder-Mead method, which tolerates kinks and
/// plateaus), or over the whole box with DIRECT (D. R. Jones and others, in its locally biased form), which
/// ignores start and step.
enum class SearchMethod { subplex, direct };

/// The search region and its settings.
struct SearchSpace {
  Eigen::VectorXd start;
  Eigen::VectorXd step;  ///< first change of each variable, > 0
  Eigen::VectorXd lower, upper;
  int evaluations = 200;  ///< at most
  SearchMethod method = SearchMethod::subplex;
  double tolerance = 1e-4;  ///< of the point, relative
  /// The search ends at the first point of at least this value.
  double enough = std::numeric_limits<double>::infinity();
};

/// The best point that was evaluated, the start at worst.
struct BestPoint {
  Eigen::VectorXd point;
  double value;
};

/// Searches for a large value of `objective` in the box, without derivatives. Deterministic: the same calls
/// give the same result. An objective may return anything, NaN included, which counts as -infinity;
/// exceptions it throws pass through. Throws std::invalid_argument when sizes differ. NLopt's own status and
/// messages are ignored: the point is the best among those evaluated here.
[[nodiscard]] BestPoint maximize(const std::function<double(const Eigen::VectorXd&)>& objective,
                                 const SearchSpace& space);

/// The same for a smooth objective, uphill along its gradient (NLopt's method of moving asymptotes, K.
/// Svanberg); the gradient is that of central differences of a ten thousandth of `step`. All evaluations
/// count.
[[nodiscard]] BestPoint climb(const std::function<double(const Eigen::VectorXd&)>& objective,
                              const SearchSpace& space);

}  // namespace veritrack::search

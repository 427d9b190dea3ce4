// Proposals: a local search for a maximum, by NLopt. Nothing it returns is evidence of anything.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace veritrack::search {

/// Where to look.
struct SearchSpace {
  Eigen::VectorXd start;
  Eigen::VectorXd step;  ///< first change of each variable, > 0
  Eigen::VectorXd lower, upper;
  int evaluations = 200;  ///< at most
};

/// The best point that was evaluated, the start at worst.
struct BestPoint {
  Eigen::VectorXd point;
  double value;
};

/// Looks for a large value of `objective` in the box, without derivatives (Sbplx, T. H. Rowan's variant of
/// the Nelder-Mead method, which bears kinks and plateaus). Deterministic: the same calls give the same
/// result. An objective may return anything, NaN included, which counts as -infinity; exceptions it throws
/// pass through. Throws std::invalid_argument when sizes differ. NLopt's own status and complaints are
/// ignored: the point is the best among those evaluated here.
[[nodiscard]] BestPoint maximize(const std::function<double(const Eigen::VectorXd&)>& objective,
                                 const SearchSpace& space);

}  // namespace veritrack::search

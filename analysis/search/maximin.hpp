// Proposals: a search for a point at which the least of many functions is large, by NLopt. Nothing it returns
// is evidence of anything.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "analysis/search/maximize.hpp"

namespace veritrack::search {

/// All functions at a point.
using Functions = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Searches for a large least value of smooth functions in the box: the largest t with t <= f_k(x) for all k,
/// by sequential quadratic programming (D. Kraft's SLSQP in NLopt). The Jacobian is that of differences of a
/// ten thousandth of `step`, all its evaluations counting. Deterministic. Values that are not finite count as
/// the lowest double. Exceptions that the functions throw pass through. Throws std::invalid_argument when
/// sizes differ.
[[nodiscard]] BestPoint climb_least(const Functions& functions, const SearchSpace& space);

}  // namespace veritrack::search

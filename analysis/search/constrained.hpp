// Proposals: a local minimum under constraints, by Ipopt. Nothing it returns is evidence of anything.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace veritrack::search {

/// Values and first derivatives at a point: outputs, and outputs x variables.
struct Differentiated {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;
};

/// Minimize objective(x) subject to lower <= x <= upper and constraints_lower <= constraints(x) <=
/// constraints_upper. Equal bounds are an equation.
struct ConstrainedProblem {
  Eigen::VectorXd start, lower, upper;
  std::function<Differentiated(const Eigen::VectorXd&)> objective;  ///< one output
  std::function<Differentiated(const Eigen::VectorXd&)> constraints;
  Eigen::VectorXd constraints_lower, constraints_upper;
  double tolerance = 1e-12;
  int iterations = 500;  ///< at most
};

/// The point at which Ipopt ended, whatever its status.
struct ConstrainedPoint {
  Eigen::VectorXd point;
  double objective = 0.0;
  bool claims_success = false;  ///< Ipopt's own status; information only, never evidence
};

/// Runs Ipopt (interior points with a filter line search, quasi-Newton second derivatives) from the start.
/// Silent; reads no option file; holds round-to-nearest. Deterministic. Exceptions of the functions pass
/// through. Throws std::invalid_argument when sizes differ.
[[nodiscard]] ConstrainedPoint minimize_constrained(const ConstrainedProblem& problem);

}  // namespace veritrack::search

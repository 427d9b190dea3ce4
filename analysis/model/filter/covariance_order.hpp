// Are bounds of a filter's covariance again bounds at the next sample, whatever the error of the estimate?
#pragma once

#include "analysis/model/filter/filter_models.hpp"

namespace veritrack::model {

/// F over the ball, taken apart: F = F_0 + T_1 + T_2 + T_3 + errors, where T_a has the degree a in xi, as
/// matrices of models in s and z alone.
struct JacobianParts {
  BallMatrix constant;                          ///< F_0
  std::vector<std::vector<BallMatrix>> powers;  ///< of each degree a = 1, 2, 3: the coefficients of xi^alpha
  std::vector<std::vector<double>> weights;     ///< of each: alpha!/a!
  double error = 0.0;                           ///< bounds the Frobenius norm of the remainder; NaN: unknown
};

/// Takes apart a Jacobian over models in xi, s and z. Needs a scope without a ball, and the upward rounding
/// mode.
[[nodiscard]] JacobianParts parts_of_jacobian(const std::vector<rigor::BallModel>& jacobian,
                                              std::size_t states);

/// sum_a sum_alpha w_alpha A_alpha P A_alpha' / t_a + error^2 |P| I / t_4, sum t = 1: above (F - F_0) P (F -
/// F_0)' for every xi of the ball, if P is positive semidefinite.
[[nodiscard]] BallMatrix spread_of(const JacobianParts& jacobian, const BallMatrix& covariance);

/// Whether F P F' + Q < high for every xi of the ball. With any eta > 0, F P F' <= (1 + eta) F_0 P F_0' + (1
/// + 1/eta) spread. P is positive semidefinite.
[[nodiscard]] bool stays_below(const JacobianParts& jacobian, const BallMatrix& covariance,
                               const BallMatrix& process, const BallMatrix& high);
/// Whether F P F' + Q > low for every xi: F P F' >= (1 - eta) F_0 P F_0' - (1/eta - 1) spread, 0 < eta < 1.
[[nodiscard]] bool stays_above(const JacobianParts& jacobian, const BallMatrix& covariance,
                               const BallMatrix& process, const BallMatrix& low);

}  // namespace veritrack::model

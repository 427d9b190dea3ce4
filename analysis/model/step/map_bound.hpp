// Bounds on the length of a vector of ball models.
#pragma once

#include <vector>

#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

/// Upper bounds of the length of the vector for x in the ball of radius `scale` (in (0, 1]), for each of the
/// scales, v in the unit ball and s, z in [-1, 1]; not finite when nothing is known. With `last_alone` the
/// last component of v and the vector of the others are each at most 1/sqrt 2 long. Needs the upward rounding
/// mode.
///
/// The part of degree 1 in x and in v is bounded together: with N(s, z) and b(s, z) its matrices, |N x + b
/// v|^2 is at most the largest eigenvalue of scale^2 N N'/t + b b'/(1 - t) for every t in (0, 1)
/// (S-procedure); a last component c zeta alone is another term of that kind, scale^2 N N'/t_1 + b b'/(2 t_2)
/// + c c'/(2 t_3), t_1 + t_2 + t_3 = 1. That matrix is expanded in s and z: a verified bound of the
/// eigenvalue of its constant part, and the norms of the others. The other degrees are bounded by the norms
/// of their matrices of coefficients, each row a component, weighted as in Bombieri's norm; by |M|^2 = |M M'|
/// <= |(M M')^4|_F^(1/4).
[[nodiscard]] std::vector<double> length_bounds(const std::vector<rigor::BallModel>& vector,
                                                const std::vector<double>& scales, bool last_alone = false);

/// The parts of a vector that change with s, and with z: sums of norms. Not evidence.
struct WidthShares {
  double by_phase = 0.0;
  double by_frequency = 0.0;
};
[[nodiscard]] WidthShares width_shares(const std::vector<rigor::BallModel>& vector);

}  // namespace veritrack::model
